// A thin layer of tissue on bone under a large rigid sphere: how few elements through the thickness
// will do.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <optional>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/sim/contact_study.hpp"

namespace articular::sim {
namespace {

constexpr double kLayerThickness = 2e-3;               // t [m]
constexpr double kLayerRadius = 10 * kLayerThickness;  // of the sphere
constexpr double kLayerIndentation = 0.1 * kLayerThickness;
constexpr double kLayerHalfWidth = 5 * kLayerThickness;
/// Half width of the finest cells; the contact radius is near √(2 R δ) = 1.4 t.
constexpr double kLayerFine = 2 * kLayerThickness;
constexpr double kLayerGrowth = 1.3;  // of the cells beyond
constexpr double kLayerYoung = 1e6;   // [Pa]
constexpr int kLayerSteps = 4;
constexpr int kLayerReference = 8;  // elements through the thickness

}  // namespace

LayerResult press_layer(int elements, double nu, const StudyOptions& options) {
  const double h = kLayerThickness / elements;
  const std::vector<double> side = graded_lines(kLayerHalfWidth, kLayerFine, h, kLayerGrowth);
  Scene scene(options);
  scene.tissue("layer", block_mesh({side, side, uniform_lines(-kLayerThickness, 0, elements)}),
               fem::NeoHookean(kLayerYoung, nu));
  Body rigid;
  rigid.name = "bone";
  rigid.kind = Body::Kind::Fixed;
  scene.add(rigid);
  scene.tie("layer", "bone", -1.001 * kLayerThickness, -0.999 * kLayerThickness);
  // Facets of t/12: their sagitta is 0.09 % of the indentation.
  scene.add_rigid("sphere",
                  sphere_cap(kLayerRadius, 1.4 * kLayerFine, kLayerFine, kLayerThickness / 12));
  scene.touch("sphere", "layer");
  scene.drive("sphere", {Vec3::Zero(), Vec3(0, 0, -kLayerIndentation)});
  ContactRun run(scene, options);
  run.steps(1, kLayerSteps);
  return {run.contact().force.z(), peak_pressure(run.nodal_contacts("layer", Vec3::UnitZ())),
          run.contact().penetration, run.costs()};
}

namespace {

void print_row(int elements, double nu, const LayerResult& result,
               const std::optional<LayerResult>& fine) {
  const auto error = [&](double value, double reference) {
    return fine ? fmt::format("{:+.1f}", 100 * (value / reference - 1)) : std::string("–");
  };
  const LayerResult& reference = fine ? *fine : result;
  std::printf("| %d | %.2f | %.5f | %s | %.0f | %s | %.2f | %s\n", elements, nu, result.force,
              error(result.force, reference.force).c_str(), result.peak,
              error(result.peak, reference.peak).c_str(),
              100 * result.penetration / kLayerIndentation, cost_columns(result.costs).c_str());
  std::fflush(stdout);
}

}  // namespace

void study_layer(const StudyOptions& options) {
  std::printf(
      "\n## Layer on bone, indented by a tenth of its thickness t; R = 10 t; against %d elements "
      "through t\n\n"
      "| elements through t | ν | force [N] | [%%] | peak pressure [Pa] | [%%] | "
      "penetration/indentation [%%] | %s\n|---|---|---|---|---|---|---|%s\n",
      kLayerReference, kCostHeader, kCostRule);
  for (const double nu : {0.3, 0.49}) {
    std::optional<LayerResult> fine;
    for (const int elements : {kLayerReference, 1, 2, 3, 4}) {
      if (elements > options.finest) continue;
      try {
        const LayerResult result = press_layer(elements, nu, options);
        print_row(elements, nu, result, fine);
        if (elements == kLayerReference) fine = result;
      } catch (const std::exception& error) {
        print_failure(fmt::format("{} | {}", elements, nu), error);
      }
    }
  }
}

}  // namespace articular::sim
