// Blocks that are pressed by 1 %. Corotated elements have σ = E ε in any uniform state whose sides
// are free, so that forces are known to round-off for every E and ν.
#include <fmt/format.h>

#include <cmath>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kBarSide = 0.01, kBarStrain = 0.01, kBarArea = kBarSide * kBarSide,
                 kBarDensity = 1000;  // SI

/// Slow beside waves: 400 of their ways through the block.
double slow(double young) { return 400 * kBarSide / std::sqrt(young / kBarDensity); }

std::string start(bool is_static, double duration) {
  return is_static ? statics(1, 0.5) : general(1.5 * duration, duration / 100);
}

Finding judged_force(const ProgramRun& run, const std::string& body, double expected,
                     double bound) {
  if (const auto end = ended_early(run)) return *end;
  const double force = ScenarioResults(run.results).last(body + ".force.z [N]");
  return judged(run, std::abs(std::abs(force) / expected - 1), {.right = bound, .stable = 0.3},
                "force against E A ε");
}

Finding young(const Bench& bench, double E, bool is_static) {
  const double duration = is_static ? 1 : slow(E);
  const std::string scene =
      start(is_static, duration) + carrier("floor") + carrier("press") +
      box("block", "tissue", {.cells = {3, 3, 3}}, solid(kBarDensity, "corotated", E, 0)) +
      attach("block", "floor", {-1, -1, -1}, {1, 1, -0.00499}) +
      attach("block", "press", {-1, -1, 0.00499}, {1, 1, 1}) +
      motion("press", duration, {0, 0, -kBarStrain * kBarSide}) + reaction_probe("floor", "floor");
  return judged_force(bench.run("press", scene, 60), "floor", E * kBarArea * kBarStrain, 0.01);
}

/// Upper block soft, lower one hard; they meet across a contact with other meshes on both sides.
Finding both(const Bench& bench, bool is_static) {
  constexpr double kSoft = 10, kHard = 10e9;  // [Pa]
  const double duration = is_static ? 1 : slow(kSoft);
  const std::string scene =
      start(is_static, duration) + carrier("floor") + carrier("press") +
      box("hard", "tissue",
          {.size = {0.016, 0.016, kBarSide}, .cells = {4, 4, 3}, .center = {0, 0, -kBarSide / 2}},
          solid(kBarDensity, "corotated", kHard, 0)) +
      box("soft", "tissue", {.cells = {3, 3, 3}, .center = {0, 0, kBarSide / 2}},
          solid(kBarDensity, "corotated", kSoft, 0)) +
      attach("hard", "floor", {-1, -1, -1}, {1, 1, 1e-5 - kBarSide}) +
      attach("soft", "press", {-1, -1, kBarSide - 1e-5}, {1, 1, 1}) +
      motion("press", duration, {0, 0, -kBarStrain * kBarSide}) + reaction_probe("floor", "floor");
  // In time contact is soft: it gives by a tenth of what elements do.
  return judged_force(bench.run("press", scene, 120), "floor", kSoft * kBarArea * kBarStrain,
                      is_static ? 0.01 : 0.05);
}

/// Between two plates without friction: sides are free.
Finding poisson(const Bench& bench, double nu, const std::string& element) {
  constexpr double kYoung = 1e4;  // [Pa]
  const std::string scene =
      statics(1, 0.5) +
      box("floor", "fixed",
          {.size = {0.03, 0.03, 0.004}, .cells = {3, 3, 1}, .center = {0, 0, -0.007}}) +
      box("press", "fixed",
          {.size = {0.03, 0.03, 0.004}, .cells = {3, 3, 1}, .center = {0, 0, 0.007}}) +
      box("block", "tissue", {.cells = {3, 3, 3}},
          solid(kBarDensity, "corotated", kYoung, nu, ", element = \"" + element + "\"")) +
      motion("press", 1, {0, 0, -kBarStrain * kBarSide}) + reaction_probe("floor", "floor");
  return judged_force(bench.run("press", scene, 60), "floor", kYoung * kBarArea * kBarStrain, 0.01);
}

}  // namespace

std::vector<Extreme> materials() {
  std::vector<Extreme> rows;
  for (const bool is_static : {true, false}) {
    const std::string analysis = is_static ? "static" : "dynamic";
    for (const double E : {10.0, 1e4, 1e7, 1e10})
      rows.push_back({.name = "Young's modulus, " + analysis,
                      .range = fmt::format("{:g} Pa", E),
                      .quick = true,
                      .study = [=](const Bench& bench) { return young(bench, E, is_static); }});
    rows.push_back({.name = "10 Pa on 10 GPa in contact",
                    .range = analysis,
                    .quick = is_static,
                    .study = [=](const Bench& bench) { return both(bench, is_static); }});
  }
  for (const std::string element : {"plain", "smoothed"})
    for (const double nu : {-0.9, -0.5, 0.0, 0.45, 0.49, 0.499, 0.4999})
      rows.push_back({.name = "Poisson's ratio, " + element,
                      .range = fmt::format("{:g}", nu),
                      .quick = nu == -0.9 || nu == 0.4999,
                      .study = [=](const Bench& bench) { return poisson(bench, nu, element); }});
  return rows;
}

}  // namespace articular::benchmarks
