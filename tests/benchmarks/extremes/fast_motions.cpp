// Bodies that come far too fast.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/benchmarks/extremes/energy_error.hpp"
#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kBlockSide = 0.02;  // [m] of the block

std::string block(double young, double damping) {
  return box("block", "tissue", {.size = {kBlockSide, kBlockSide, kBlockSide}, .cells = {4, 4, 4}},
             solid(1000, "neo-hookean", young, 0.3,
                   fmt::format(", mass_damping = \"{} 1/s\"", damping))) +
         carrier("floor") + attach("block", "floor", {-1, -1, -1}, {1, 1, 1e-6 - kBlockSide / 2});
}

/// A plate is driven 6 mm into a block at this speed and stays there. @return the run
ProgramRun drive(const Bench& bench, const std::string& name, double speed) {
  constexpr double kWay = 0.008, kRest = 0.5;  // [m], [s]
  const std::string scene = general(kWay / speed + kRest, 1e-3) + block(15e3, 50) +
                            box("plate", "fixed",
                                {.size = {0.04, 0.04, 0.004},
                                 .cells = {8, 8, 1},
                                 .center = {0, 0, kBlockSide / 2 + 0.004}}) +
                            motion("plate", kWay / speed, {0, 0, -kWay}, "linear") +
                            reaction_probe("plate", "plate");
  return bench.run(name, scene, 120);
}

/// Where it stays the force must be that of a slow press.
Finding driven(const Bench& bench, double speed) {
  const ProgramRun slow = drive(bench, "slow", 0.02), run = drive(bench, "fast", speed);
  if (const auto end = ended_early(slow)) return {Outcome::Failed, "slow press: " + end->measured};
  if (const auto end = ended_early(run)) return *end;
  const auto force = [](const ProgramRun& of) {
    return ScenarioResults(of.results).last("plate.force.z [N]");
  };
  return judged(run, std::abs(force(run) / force(slow) - 1), {.right = 0.02, .stable = 0.5},
                "force at rest against that of a slow press");
}

/// A rigid ball, or the block itself, comes at 100 m/s. Waves run at 370 m/s where E = 100 MPa;
/// where E = 1 MPa, at 37 m/s, the impact has five times the energy density that its law can take.
Finding impact(const Bench& bench, bool rigid, double young, double step,
               const std::string& scheme) {
  constexpr double kSpeed = 100;
  const std::string velocity = fmt::format("velocity = \"0 0 {} m/s\"\n", -kSpeed);
  std::string scene = general(2e-3, step, "", "scheme = \"" + scheme + "\"") + energy_probe();
  if (rigid)
    scene +=
        block(young, 0) +
        ball("ball", "rigid", 0.004, 0.002, {0.001, 0.0005, 0.0145}, density(1000) + velocity) +
        point_probe("ball", "ball", {0.001, 0.0005, 0.0145});
  else
    scene +=
        box("block", "tissue", {.size = {kBlockSide, kBlockSide, kBlockSide}, .cells = {4, 4, 4}},
            solid(1000, "neo-hookean", young, 0.3) + velocity) +
        box("wall", "fixed",
            {.size = {0.06, 0.06, 0.02}, .cells = {6, 6, 2}, .center = {0, 0, -0.021}}) +
        point_probe("ball", "block", {0, 0, kBlockSide / 2});
  const ProgramRun run = bench.run("impact", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  const ScenarioResults results(run.results);
  if (results.smallest("ball.position.z [m]") < -kBlockSide / 2)
    return {Outcome::Failed, "it went through"};
  // In between, what was made may come and go; as motion it would have ended the run.
  return judged(run, energy_created(results), {.right = 1e-3, .stable = 1},
                "energy made of nothing, by that of the impact");
}

/// The soft block is pressed inside out: what then comes of it depends on the scheme.
Outcome expected(double young, bool rigid, const std::string& scheme, double step) {
  if (young > 1e7) return Outcome::Right;
  if (!rigid) return Outcome::Refused;
  if (scheme == "dirk-3" && step > 1e-4) return Outcome::Degraded;
  return Outcome::Right;
}

}  // namespace

std::vector<Extreme> fast_motions() {
  std::vector<Extreme> rows;
  for (const double speed : {0.1, 1.0, 10.0, 100.0, 1e4})
    rows.push_back({.name = "driven plate",
                    .range = fmt::format("{:g} m/s", speed),
                    .quick = speed == 10,
                    .study = [=](const Bench& bench) { return driven(bench, speed); }});
  for (const double young : {1e8, 1e6})
    for (const std::string scheme : {"implicit-euler", "tr-bdf2", "dirk-3"})
      for (const double step : {1e-3, 1e-5})
        for (const bool rigid : {true, false})
          rows.push_back({.name = "impact at 100 m/s",
                          .range = fmt::format("{}, E = {:g} Pa, {}, step {:g} s",
                                               rigid ? "rigid ball on tissue" : "tissue on a wall",
                                               young, scheme, step),
                          .expected = expected(young, rigid, scheme, step),
                          .quick = scheme == "implicit-euler" && step == 1e-3,
                          .study = [=](const Bench& bench) {
                            return impact(bench, rigid, young, step, scheme);
                          }});
  return rows;
}

}  // namespace articular::benchmarks
