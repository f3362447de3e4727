// fast, balanced and accurate are ordered in error, on scenes that set nothing of what they set
// but, where errors in time are compared, how contact counts depths.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::preset_test {

// A beam of tissue lets go of its support and swings: nothing but the time step matters.
const std::string kSwing = R"(
duration = "60 ms"
contact = false
[[body]]
name = "wall"
kind = "fixed"
[[body]]
name = "beam"
kind = "tissue"
geometry = { box = { size = "30 5 5 mm", cells = [6, 1, 1], center = "15 0 0 mm" } }
density = "1000 kg/m^3"
material = { law = "neo-hookean", young_modulus = "100 kPa", poisson_ratio = 0.3, element = "plain" }
[[attach]]
body = "beam"
to = "wall"
region = { box = ["-0.1 -3 -3 mm", "0.1 3 3 mm"] }
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "end"
kind = "point"
body = "beam"
point = "30 2.5 2.5 mm"
[output]
interval = "10 ms"
)";

// A ball is driven into a layer within 30 ms and held: contact and the layer's inertia.
const std::string kPress = R"(
duration = "40 ms"
[[body]]
name = "plate"
kind = "fixed"
[[body]]
name = "ball"
kind = "fixed"
geometry = { sphere = { radius = "10 mm", element_size = "2 mm", center = "0 0 20 mm" } }
[[body]]
name = "layer"
kind = "tissue"
geometry = { box = { size = "20 20 10 mm", cells = [8, 8, 4], center = "0 0 5 mm" } }
density = "1060 kg/m^3"
material = { law = "neo-hookean", young_modulus = "15 kPa", poisson_ratio = 0.3, stiffness_damping = "2 ms", element = "plain" }
[[attach]]
body = "layer"
to = "plate"
region = { box = ["-11 -11 -0.1 mm", "11 11 0.1 mm"] }
[[load]]
kind = "motion"
body = "ball"
time = ["0 s", "30 ms"]
translation = ["0 0 0 mm", "0 0 -2 mm"]
[[probe]]
name = "ball"
kind = "contact"
bodies = ["layer", "ball"]
[output]
interval = "10 ms"
)";

const std::string kPointwise = "contact_response = \"pointwise\"\n";

std::vector<double> curve(const std::string& scenario, const std::string& column,
                          const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  const ScenarioResults results =
      run_scenario(folder.file("scene.toml", scenario).string(), overrides);
  std::vector<double> values;  // at times that all steps meet
  const double duration = results.column("time [s]").back();
  for (int i = 1; i * 2e-3 < duration * (1 + 1e-9); ++i)
    values.push_back(results.at(column, i * 2e-3));
  return values;
}

ScenarioResults press(std::vector<std::string> overrides) {
  const TemporaryFolder folder;
  overrides.push_back("duration=16 ms");
  return run_scenario(folder.file("scene.toml", kPress).string(), overrides);
}

/// Root mean square of the difference to a run with a tenth of the finest preset's step.
std::array<double, 3> errors(const std::string& scenario, const std::string& column) {
  const std::vector<double> right =
      curve(scenario, column,
            {"accuracy=accurate", "integrator.scheme=tr-bdf2", "integrator.step=0.1 ms"});
  std::array<double, 3> result{};
  const char* const presets[] = {"fast", "balanced", "accurate"};
  for (std::size_t p = 0; p < 3; ++p) {
    const std::vector<double> values =
        curve(scenario, column, {std::string("accuracy=") + presets[p]});
    double sum = 0;
    for (std::size_t i = 0; i < right.size(); ++i) sum += std::pow(values[i] - right[i], 2);
    result[p] = std::sqrt(sum / static_cast<double>(right.size()));
  }
  return result;
}

TEST(Presets, AreOrderedInErrorWhereTissueSwings) {
  const auto [fast, balanced, accurate] = errors(kSwing, "end.position.z [mm]");
  EXPECT_GT(fast, 1.3 * balanced);
  EXPECT_GT(balanced, 1.3 * accurate);
  EXPECT_GT(accurate, 0);
}

TEST(Presets, AreOrderedInErrorWhereTissueIsPressed) {
  const auto [fast, balanced, accurate] = errors(kPointwise + kPress, "ball.force.z [N]");
  EXPECT_GT(fast, 1.3 * balanced);
  EXPECT_GT(balanced, 1.3 * accurate);
  EXPECT_GT(accurate, 0);
}

/// What `accuracy` stands for, as of `--set`, by the record of a run with it.
std::vector<std::string> plain_keys(const nlohmann::json& settings) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : settings.at("accuracy_stands_for").items())
    keys.push_back(key + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  return keys;
}

TEST(Presets, AreNoMoreThanTheKeysThatTheyStandFor) {
  for (const char* const preset : {"fast", "balanced", "accurate"}) {
    const ScenarioResults named = press({std::string("accuracy=") + preset});
    const ScenarioResults written = press(plain_keys(named.summary().at("settings")));
    EXPECT_EQ(named.column("ball.force.z [N]"), written.column("ball.force.z [N]")) << preset;
    EXPECT_EQ(named.count("newton_iterations"), written.count("newton_iterations")) << preset;
  }
}

}  // namespace articular::preset_test
