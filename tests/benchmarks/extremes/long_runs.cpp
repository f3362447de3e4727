// What comes of very many steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/benchmarks/extremes/spin.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kStep = 1e-3;  // [s]

/// A free body that turns by 0.1 rad a step about an axis between those of its inertia.
Finding tumbling(const Bench& bench, const std::string& scheme) {
  constexpr int kSteps = 100000;
  const SpinDrift drift =
      spin_drift(bench, "spin", kStep, kSteps * kStep, "scheme = \"" + scheme + "\"\n");
  if (const auto end = ended_early(drift.run)) return *end;
  Finding finding = judged(drift.run, std::max(std::abs(drift.energy), drift.momentum),
                           {.right = 0.01, .stable = 2}, "drift of energy or angular momentum");
  finding.measured +=
      fmt::format("; energy {:+.2g}, angular momentum {:.2g}", drift.energy, drift.momentum);
  return finding;
}

/// A block on a floor without friction: nothing but round-off can move it.
Finding resting(const Bench& bench, bool rigid, double steps) {
  constexpr double kSide = 0.01, kCalm = 5;  // [m], [s] until it has come to rest
  const std::string body =
      rigid ? density(1000) : solid(1000, "neo-hookean", 1e5, 0.3, ", mass_damping = \"20 1/s\"");
  const std::string scene =
      general(kCalm + steps * kStep, kStep) +
      box("block", rigid ? "rigid" : "tissue", {.cells = {1, 1, 1}}, body) +
      box("floor", "fixed",
          {.size = {0.03, 0.03, 0.01}, .cells = {1, 1, 1}, .center = {0, 0, -0.01}}) +
      gravity(9.81) + point_probe("corner", "block", {0.005, 0.005, 0.005}) + energy_probe();
  const ProgramRun run = bench.run("rest", scene, 1200);
  if (const auto end = ended_early(run)) return *end;
  const ScenarioResults results(run.results);
  const auto moved = [&](const std::string& axis) {
    const std::string column = "corner.position." + axis + " [m]";
    return std::abs(results.last(column) - results.at(column, kCalm)) / kSide;
  };
  // Sideways nothing holds it; what Newton's iteration leaves of the forces pushes it about.
  Finding finding =
      judged(run, moved("z"), {.right = 1e-6, .stable = 0.1}, "creep downwards by the side");
  const double aside = std::max(moved("x"), moved("y"));
  finding.measured += fmt::format("; sideways {:.1g}", aside);
  if (aside > 1e-2) finding.outcome = Outcome::Failed;
  const double heat = results.last("energy.kinetic [J]") / (1000 * std::pow(kSide, 4) * 9.81);
  finding.measured += fmt::format("; kinetic energy by m g L: {:.1g}", heat);
  if (heat > 1e-9) finding.outcome = Outcome::Failed;
  return finding;
}

}  // namespace

std::vector<Extreme> long_runs() {
  std::vector<Extreme> rows;
  for (const std::string scheme : {"implicit-euler", "tr-bdf2", "dirk-3"})
    rows.push_back({.name = "10⁵ steps of a free spinning body",
                    .range = "0.1 rad a step, " + scheme,
                    .expected = Outcome::Degraded,
                    .study = [=](const Bench& bench) { return tumbling(bench, scheme); }});
  const auto rest = [&](double steps, const std::string& words, bool rigid) {
    rows.push_back({.name = fmt::format("{:g} steps at rest", steps),
                    .range = words,
                    .quick = steps < 1e5,
                    .study = [=](const Bench& bench) { return resting(bench, rigid, steps); }});
  };
  for (const double steps : {1e4, 1e6}) {
    rest(steps, "tissue", false);
    rest(steps, "rigid body", true);
  }
  return rows;
}

}  // namespace articular::benchmarks
