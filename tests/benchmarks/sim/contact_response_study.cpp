// Ways in which depths may count, side by side: what they do to a uniform pressure, to the force of
// a sphere that is dragged, and under a sphere on a thin layer as the penalty rises.

#include <cstdio>
#include <functional>

#include "tests/benchmarks/sim/contact_study.hpp"

namespace articular::sim {
namespace {

constexpr double kResponseJitter = 0.2;
constexpr double kResponsePoisson = 0.3;

/// The table's next cells, of which there are `count`; dashes where there is no solution.
void print_cells(int count, const std::function<void()>& print) {
  try {
    print();
  } catch (const std::exception&) {
    for (int i = 0; i < count; ++i) std::printf(" – |");
  }
  std::fflush(stdout);
}

void print_row(DepthRule rule, double stiffness, StudyOptions options) {
  constexpr double kStatic = 1000;  // the factor that `stiffness` multiplies
  options.rule = rule;
  options.stiffness = stiffness / kStatic;
  std::printf("| %s | %g |", kDepthRules[static_cast<int>(rule)], stiffness);
  print_cells(2, [&] {
    const PatchResult patch = press_blocks(7, 8, kResponseJitter, options);
    std::printf(" %+.3f | %.4f |", patch.mean, patch.deviation);
  });
  for (const int cells : {8, 16}) {
    if (cells > options.finest) continue;
    print_cells(3, [&] {
      const Ripple ripple = drag_sphere(cells, 0, options);
      std::printf(" %.3f | %.2f | %.1f |", ripple.mean, ripple.detrended, ripple.costs.iterations);
    });
  }
  print_cells(2, [&] {
    const LayerResult layer = press_layer(2, kResponsePoisson, options);
    std::printf(" %.3f | %.0f |", layer.force, 1e-3 * layer.peak);
  });
  std::printf("\n");
}

}  // namespace

void study_responses(const StudyOptions& options) {
  std::printf(
      "\n## Responses: patch test (7 cells under 8, jittered), drag over 8 and 16 cells, layer of "
      "two elements\n\n"
      "| depths count | c | mean pressure, error [%%] | σ_zz, largest deviation [%%] |");
  for (const int cells : {8, 16})
    if (cells <= options.finest)
      std::printf(" drag, %d cells: force [N] | ripple [%%] | iterations a step |", cells);
  std::printf(" layer: force [N] | peak pressure [kPa] |\n|---|---|---|---|%s%s---|---|\n",
              options.finest >= 8 ? "---|---|---|" : "",
              options.finest >= 16 ? "---|---|---|" : "");
  for (const DepthRule rule : {DepthRule::Averaged, DepthRule::Pointwise})
    for (const double stiffness : {10.0, 100.0, 1000.0}) print_row(rule, stiffness, options);
}

}  // namespace articular::sim
