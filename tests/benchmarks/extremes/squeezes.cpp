// Compression to a few percent of the height, and through zero.
#include <fmt/format.h>

#include <cmath>

#include "tests/benchmarks/extremes/energy_error.hpp"
#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kSqueezedSide = 0.01, kSqueezedYoung = 1e4;  // [m], [Pa]

std::string analysis(bool is_static) { return is_static ? statics(1, 0.02) : general(1.5, 5e-3); }

/// In time a squeezed block may leave the straight way, as a column does that buckles: there it
/// counts that it stays calm.
Finding judged_force(const ProgramRun& run, double expected, bool is_static) {
  if (const auto end = ended_early(run)) return *end;
  const ScenarioResults results(run.results);
  const double force = std::abs(results.last("floor.force.z [N]"));
  const double error = std::abs(force / expected - 1);
  if (is_static)
    return judged(run, error, {.right = 0.02, .stable = 0.5}, "force against the law's");
  Finding finding = judged(run, energy_created(results), {.right = 0.01, .stable = 0.5},
                           "energy made of nothing, by the largest there was");
  finding.measured += fmt::format("; force against the law's: {:.2g}", error);
  return finding;
}

/// Both ends tied, without lateral strain: corotated elements with ν = 0 have P = E (s − 1).
Finding tied(const Bench& bench, double stretch, bool is_static) {
  const std::string scene =
      analysis(is_static) + carrier("floor") + carrier("press") +
      box("block", "tissue", {.cells = {3, 3, 3}},
          solid(1000, "corotated", kSqueezedYoung, 0, ", mass_damping = \"20 1/s\"")) +
      attach("block", "floor", {-1, -1, -1}, {1, 1, -0.00499}) +
      attach("block", "press", {-1, -1, 0.00499}, {1, 1, 1}) +
      motion("press", 1, {0, 0, -(1 - stretch) * kSqueezedSide}) + energy_probe() +
      reaction_probe("floor", "floor");
  return judged_force(bench.run("press", scene, 120),
                      kSqueezedYoung * kSqueezedSide * kSqueezedSide * (1 - stretch), is_static);
}

/// Nominal stress of stable neo-Hookean tissue whose sides are free: from P₁₁ = 0 the lateral
/// stretch is a² = α/s − μ/(λ s²), and P₃₃ = μ s + λ (a² s − α) a².
double free_stress(double s, double nu) {
  const double mu = kSqueezedYoung / (2 * (1 + nu)),
               lambda = kSqueezedYoung * nu / ((1 + nu) * (1 - 2 * nu)) + mu,
               alpha = 1 + mu / lambda;
  const double a2 = alpha / s - mu / (lambda * s * s);
  return mu * s + lambda * (a2 * s - alpha) * a2;
}

/// Between plates without friction.
Finding between_plates(const Bench& bench, double stretch, bool is_static) {
  constexpr double kNu = 0.49;
  const auto plate = [](const std::string& name, double z) {
    return box(name, "fixed", {.size = {0.1, 0.1, 0.01}, .cells = {4, 4, 1}, .center = {0, 0, z}});
  };
  const std::string scene =
      analysis(is_static) + plate("floor", -0.01) + plate("press", 0.01) +
      box("block", "tissue", {.cells = {3, 3, 3}},
          solid(1000, "neo-hookean", kSqueezedYoung, kNu, ", mass_damping = \"20 1/s\"")) +
      motion("press", 1, {0, 0, -(1 - stretch) * kSqueezedSide}) + energy_probe() +
      reaction_probe("floor", "floor");
  return judged_force(bench.run("press", scene, 120),
                      -free_stress(stretch, kNu) * kSqueezedSide * kSqueezedSide, is_static);
}

}  // namespace

std::vector<Extreme> squeezes() {
  std::vector<Extreme> rows;
  const auto add = [&](const std::string& name, double stretch, bool is_static, Outcome expected,
                       const auto& study) {
    rows.push_back({.name = name,
                    .range = fmt::format("to {:g} % of its height, {}", 100 * stretch,
                                         is_static ? "static" : "dynamic"),
                    .expected = expected,
                    .quick = stretch == 0.05,
                    .study = [=](const Bench& bench) { return study(bench, stretch, is_static); }});
  };
  for (const bool is_static : {true, false}) {
    for (const double stretch : {0.5, 0.2, 0.1, 0.05, 0.01, 0.0, -0.2, -1.0})
      add("compression, ends tied", stretch, is_static,
          // A bar that is turned through itself has more than one equilibrium.
          is_static && stretch < -0.5 ? Outcome::Degraded : Outcome::Right, tied);
    for (const double stretch : {0.5, 0.2, 0.1, 0.05})
      add("compression between plates", stretch, is_static,
          // Its free sides fold onto the plates.
          is_static && stretch < 0.09 ? Outcome::Degraded : Outcome::Right, between_plates);
  }
  return rows;
}

}  // namespace articular::benchmarks
