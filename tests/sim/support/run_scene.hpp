#pragma once

// What the tests of run() share: a scene with everything at once, run in a folder of its own.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim {

namespace fs = std::filesystem;

/// A block falls on a table while a rigid plate, held by a muscle and a ligament, comes down on it.
inline const std::string kScenario = R"(
title = "Everything at once"
duration = "60 ms"
[integrator]
step = "1 ms"
[[body]]
name = "table"
kind = "fixed"
geometry = { box = { size = "20 20 4 mm", cells = [2, 2, 1], center = "0 0 -2.1 mm" } }
[[body]]
name = "frame"
kind = "fixed"
[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "10 10 10 mm", cells = [2, 2, 2], center = "0 0 5 mm" } }
density = "1000 kg/m^3"
material = { law = "neo-hookean", young_modulus = "20 kPa", poisson_ratio = 0.4, element = "plain" }
[[body]]
name = "plate"
kind = "rigid"
geometry = { box = { size = "14 12 2 mm", cells = [2, 2, 1], center = "0.5 0 11.1 mm" } }
density = "2000 kg/m^3"
velocity = "0 0 -50 mm/s"
angular_velocity = "0 1 2 rad/s"
[[muscle]]
name = "puller"
path = [{ body = "table", point = "0 0 -3 mm" }, { body = "plate", point = "3 1 12 mm" }]
max_force = "0.05 N"
excitation = { time = ["0 s", "15.3 ms", "40 ms"], value = [0, 1, 0] }
[[ligament]]
name = "band"
path = [{ body = "frame", point = "0 9 20 mm" }, { body = "plate", point = "0 5 12 mm" }]
stiffness = "5 N/m"
damping = "0.01 N s/m"
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "plate"
kind = "point"
body = "plate"
point = "0 0 12 mm"
[[probe]]
name = "way"
kind = "way"
body = "plate"
point = "0 0 12 mm"
[[probe]]
name = "table_block"
kind = "contact"
bodies = ["table", "block"]
[[probe]]
name = "puller"
kind = "line"
line = "puller"
[[probe]]
name = "band"
kind = "line"
line = "band"
[[probe]]
name = "table"
kind = "reaction"
body = "table"
[[probe]]
name = "tilt"
kind = "angle"
body = "plate"
axis = [0, 1, 0]
[[probe]]
name = "energy"
kind = "energy"
[output]
interval = "6 ms"
checkpoint_interval = "20 ms"
)";

class RunTest : public ::testing::Test {
 protected:
  Scenario scenario(const std::vector<std::string>& overrides = {}) const {
    return read_scenario(folder_.file("scene.toml", kScenario), overrides);
  }
  fs::path out(const std::string& name) const { return folder_ / name; }

  RunOutcome run_with(const RunOptions& options,
                      const std::vector<std::string>& overrides = {}) const {
    const Scenario given = scenario(overrides);
    return run(given, build_model(given), options);
  }
  /// Runs until `until`, then as if interrupted.
  RunOutcome run_until(double until, const std::string& name, bool resume,
                       const std::vector<std::string>& overrides = {}) const {
    RunOptions options;
    options.directory = out(name);
    options.resume = resume;
    options.after_step = [until](const State& state, double) { return state.t >= until; };
    return run_with(options, overrides);
  }
  RunOutcome run_all(const std::string& name, bool resume = false,
                     const std::vector<std::string>& overrides = {}) const {
    return run_until(1e300, name, resume, overrides);
  }
  std::string refusal(const std::string& name,
                      const std::vector<std::string>& overrides = {}) const {
    try {
      run_all(name, true, overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

inline std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

}  // namespace articular::sim
