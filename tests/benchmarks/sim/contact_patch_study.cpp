// The patch test of contact: a uniform pressure stays uniform on meshes that do not match.

#include <cmath>
#include <cstdio>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/sim/contact_study.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim {
namespace {

constexpr double kPatchSide = 0.02;  // of a block [m]
constexpr double kPatchYoung = 1e6;  // [Pa]
constexpr double kPatchPress = 0.02;
constexpr double kPatchJitter = 0.2;

/// A cube on z = 0 or below it.
MeshData cube(int cells, double z_low, double part, unsigned seed) {
  const std::vector<double> side = uniform_lines(-kPatchSide / 2, kPatchSide / 2, cells);
  MeshData mesh = block_mesh({side, side, uniform_lines(z_low, z_low + kPatchSide, cells)});
  jitter(mesh, kPatchSide / cells, part, seed);
  return mesh;
}

/// Corotated elasticity with ν = 0 has F = diag(1, 1, s) without any lateral stress, at every s, so
/// that the sides may be free and the ends tied: σ_zz = E (s − 1) is the exact solution.
/// (A neo-Hookean solid of ν = 0 presses sideways with (1 − s)/2 of that.)
fem::AnyMaterial without_lateral_stress() { return fem::Corotated(kPatchYoung, 0); }

void add_lower(Scene& scene, int cells, double part) {
  scene.tissue("lower", cube(cells, -kPatchSide, part, 1), without_lateral_stress());
  scene.add(stand("floor"));
  scene.tie("lower", "floor", -1.001 * kPatchSide, -0.999 * kPatchSide);
}

void press_tissue(Scene& scene, int cells, double part) {
  scene.tissue("upper", cube(cells, 0, part, 2), without_lateral_stress());
  scene.add(stand("press"));
  scene.tie("upper", "press", 0.999 * kPatchSide, 1.001 * kPatchSide);
  scene.drive("press", {Vec3::Zero(), Vec3(0, 0, -2 * kPatchSide * kPatchPress)});
}

void press_plate(Scene& scene, int cells) {
  Body plate = stand("upper");
  plate.geometry = BoxGeometry{{1.3 * kPatchSide, 1.3 * kPatchSide, kPatchSide / 4},
                               {cells, cells, 1},
                               {0, 0, kPatchSide / 8}};
  scene.add(plate);
  scene.drive("upper", {Vec3::Zero(), Vec3(0, 0, -kPatchSide * kPatchPress)});
}

/// Largest deviation of −σ_zz from the mean contact pressure [% of the exact one].
double largest_deviation(const ContactRun& run, double mean) {
  double largest = 0;
  for (std::size_t t = 0; t < run.model().tissues.size(); ++t)
    largest = std::max(largest, (run.axial_stress(t).array() + mean).abs().maxCoeff());
  return 100 * largest / (kPatchYoung * kPatchPress);
}

/// Half the range of the pressure at nodes [% of the exact one].
double spread(const std::vector<NodalContact>& nodes) {
  double low = INFINITY, high = -INFINITY;
  for (const NodalContact& node : nodes) {
    low = std::min(low, node.pressure);
    high = std::max(high, node.pressure);
  }
  return 50 * (high - low) / (kPatchYoung * kPatchPress);
}

PatchResult result_of(const Scene& scene, const StudyOptions& options) {
  ContactRun run(scene, options);
  run.steps(1, 2);
  const double mean = std::abs(run.contact().force.z()) / (kPatchSide * kPatchSide);
  double nodal = spread(run.nodal_contacts("lower", Vec3::UnitZ()));
  if (run.model().tissues.size() > 1)
    nodal = std::max(nodal, spread(run.nodal_contacts("upper", -Vec3::UnitZ())));
  return {100 * (mean / (kPatchYoung * kPatchPress) - 1), largest_deviation(run, mean), nodal,
          run.costs()};
}

PatchResult press_under_plate(int lower, int plate, double part, const StudyOptions& options) {
  Scene scene(options);
  add_lower(scene, lower, part);
  press_plate(scene, plate);
  scene.touch("upper", "lower");
  return result_of(scene, options);
}

using Press = PatchResult (*)(int, int, double, const StudyOptions&);

void row(const char* name, Press press, int lower, int upper, double part,
         const StudyOptions& options) {
  try {
    const PatchResult result = press(lower, upper, part, options);
    std::printf("| %s | %+.4f | %.4f | %.4f | %s\n", name, result.mean, result.deviation,
                result.nodal, cost_columns(result.costs).c_str());
    std::fflush(stdout);
  } catch (const std::exception& error) {
    print_failure(name, error);
  }
}

}  // namespace

PatchResult press_blocks(int lower, int upper, double part, const StudyOptions& options) {
  Scene scene(options);
  add_lower(scene, lower, part);
  press_tissue(scene, upper, part);
  scene.touch("upper", "lower");
  return result_of(scene, options);
}

void study_patch(const StudyOptions& options) {
  std::printf(
      "\n## Patch: pressed by 2 %% [%% of the exact pressure E (1 − s)]\n\n"
      "| cells of a block's side | mean | σ_zz from the mean, largest | nodal pressure, half range "
      "| "
      "%s\n|---|---|---|---|%s\n",
      kCostHeader, kCostRule);
  row("3 under 4, regular", press_blocks, 3, 4, 0, options);
  row("3 under 4, jittered", press_blocks, 3, 4, kPatchJitter, options);
  row("4 under 3, jittered", press_blocks, 4, 3, kPatchJitter, options);
  row("7 under 8, jittered", press_blocks, 7, 8, kPatchJitter, options);
  row("4 under rigid plate, regular", press_under_plate, 4, 3, 0, options);
  row("4 under rigid plate, jittered", press_under_plate, 4, 3, kPatchJitter, options);
}

}  // namespace articular::sim
