// Two blocks on each other, one 10⁶ times as dense: what the lower surface of each carries is
// known.
#include <fmt/format.h>

#include <cmath>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kSide = 0.01, kVolume = kSide * kSide * kSide, kGravity = 9.81, kYoung = 1e7;

Finding study(const Bench& bench, double below, double above, double tolerance) {
  const std::string damped = ", mass_damping = \"200 1/s\"";
  const std::string scene =
      general(0.3, 1e-3, "", fmt::format("position_tolerance = \"{} m\"", tolerance)) +
      carrier("floor") +
      box("below", "tissue", {.cells = {3, 3, 3}, .center = {0, 0, -kSide / 2}},
          solid(below, "corotated", kYoung, 0, damped)) +
      box("above", "tissue", {.size = {0.008, 0.008, kSide}, .center = {0, 0, kSide / 2}},
          solid(above, "corotated", kYoung, 0, damped)) +
      attach("below", "floor", {-1, -1, -1}, {1, 1, 1e-5 - kSide}) + gravity(kGravity) +
      contact_probe("contact", "above", "below") + reaction_probe("floor", "floor");
  const ProgramRun run = bench.run("blocks", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  const ScenarioResults results(run.results);
  const double weight_above = above * 0.64 * kVolume * kGravity;
  const double carried = std::abs(results.last("contact.force.z [N]"));
  return judged(run, std::abs(carried / weight_above - 1), {.right = 0.01, .stable = 0.3},
                "contact force against the weight above");
}

}  // namespace

std::vector<Extreme> densities() {
  std::vector<Extreme> rows;
  const auto add = [&](const std::string& range, double below, double above, double tolerance) {
    rows.push_back(
        {.name = "density ratio 10⁶",
         .range = fmt::format("{}, position_tolerance {:g} m", range, tolerance),
         .study = [=](const Bench& bench) { return study(bench, below, above, tolerance); }});
  };
  // A correction of 1 µm changes the contact force by 0.3 mN, fifty times what the light block
  // weighs: Newton's iteration must go on until what touches is in balance.
  add("heavy on light", 1, 1e6, 1e-6);
  add("light on heavy", 1e6, 1, 1e-6);
  add("light on heavy", 1e6, 1, 1e-11);
  return rows;
}

}  // namespace articular::benchmarks
