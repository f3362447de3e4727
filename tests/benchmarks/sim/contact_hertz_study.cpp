// Contact of round bodies against the closed form [Hertz 1882], with a correction for the finite
// depth of the block [Dimitriadis 2002].
//
// [Hertz 1882] Hertz. Ueber die Berührung fester elastischer Körper. J. reine angew. Math. 92:156.
// [Dimitriadis 2002] Dimitriadis, Horkay, Maresca, Kachar, Chadwick. Determination of elastic
// moduli of thin layers of soft material using the atomic force microscope. Biophys. J. 82:2798.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/sim/contact_study.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim {
namespace {

using std::numbers::pi;

constexpr double kHertzYoung = 1e6, kHertzPoisson = 0.3;
constexpr double kHertzRadius = 0.04;                   // R of the sphere or the cylinders [m]
constexpr double kContactRadius = 0.05 * kHertzRadius;  // a of Hertz; strains are about a/R
constexpr double kApproach = kContactRadius * kContactRadius / kHertzRadius;  // δ = a²/R
constexpr double kHertzDepth = 20 * kContactRadius;      // of a block, tied at its bottom
constexpr double kHertzHalfWidth = 15 * kContactRadius;  // of a block
constexpr double kHertzFine = 1.5 * kContactRadius;      // half width of the finest cells
constexpr double kHertzGrowth = 1.6;                     // of the cells beyond
constexpr int kHertzSteps = 2;

struct Hertz {
  double force = 0, radius = 0, peak = 0;  // [N], [m], [Pa]
};

/// Force over that on a half space, for a layer of a depth h tied to its base and χ = a/h: a series
/// in χ. Two like bodies that touch have the same χ: each has half of the approach, and half of the
/// compliance is its own.
double depth_factor(double chi) {
  const double nu = kHertzPoisson;
  const double alpha = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu);
  const double beta = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu);
  const double q = 2 * chi / pi, cube = alpha * alpha * alpha;
  return 1 - alpha * q + alpha * alpha * q * q - (cube + 4 * pi * pi / 15 * beta) * q * q * q +
         alpha * (cube + 3 * pi * pi / 5 * beta) * q * q * q * q;
}

/// @param E_star  [Pa] 1/E* = Σ (1 − ν²)/E over what is not rigid
Hertz hertz(double E_star) {
  Hertz h;
  h.force = 4.0 / 3 * E_star * std::sqrt(kHertzRadius) * std::pow(kApproach, 1.5) *
            depth_factor(kContactRadius / kHertzDepth);
  h.radius = std::cbrt(0.75 * h.force * kHertzRadius / E_star);
  h.peak = 1.5 * h.force / (pi * h.radius * h.radius);
  return h;
}

/// The radius of a Hertzian pressure p₀ √(1 − r²/a²) with this second moment: ∫ p r² dA = 2/5 a² F.
double radius_by_moment(const std::vector<NodalContact>& nodes) {
  double force = 0, moment = 0;
  for (const NodalContact& node : nodes) {
    force += node.force;
    moment += node.force * node.X.head<2>().squaredNorm();
  }
  return std::sqrt(2.5 * moment / force);
}

void print_header(const char* title) {
  const Hertz one = hertz(kHertzYoung / (1 - kHertzPoisson * kHertzPoisson));
  std::printf(
      "\n## %s (depth of a block %.0f a; its correction of the force %+.1f %%; a/R = %.2f)\n\n"
      "| elements over a | force [N] | error [%%] | a by the second moment, error [%%] | "
      "a by the area, error [%%] | peak pressure, error [%%] | penetration/δ [%%] | %s\n"
      "|---|---|---|---|---|---|---|%s\n",
      title, kHertzDepth / kContactRadius, 100 * (depth_factor(kContactRadius / kHertzDepth) - 1),
      one.radius / kHertzRadius, kCostHeader, kCostRule);
}

void print_row(int elements, const Scene& scene, const StudyOptions& options,
               const Hertz& expected) {
  try {
    ContactRun run(scene, options);
    run.steps(1, kHertzSteps);
    const ContactValues contact = run.contact();
    const double force = std::abs(contact.force.z());
    const auto nodes = run.nodal_contacts("lower", Vec3::UnitZ());
    const auto error = [](double value, double exact) { return 100 * (value / exact - 1); };
    std::printf("| %d | %.6f | %+.2f | %+.1f | %+.1f | %+.1f | %.1f | %s\n", elements, force,
                error(force, expected.force), error(radius_by_moment(nodes), expected.radius),
                error(std::sqrt(contact.area / pi), expected.radius),
                error(peak_pressure(nodes), expected.peak), 100 * contact.penetration / kApproach,
                cost_columns(run.costs()).c_str());
    std::fflush(stdout);
  } catch (const std::exception& error) {
    print_failure(std::to_string(elements), error);
  }
}

/// A block with its top at z = 0, fine in the middle.
MeshData fine_block(double h) {
  const std::vector<double> side = graded_lines(kHertzHalfWidth, kHertzFine, h, kHertzGrowth);
  return block_mesh({side, side, graded_depth(-kHertzDepth, kContactRadius, h, kHertzGrowth)});
}

/// A block whose top is rounded to half of a cylinder that touches z = 0 from below.
/// @param across  the axis that the cylinder bends along
MeshData half_cylinder(double h, int across) {
  MeshData mesh = fine_block(h);
  for (auto node : mesh.X.colwise()) {
    const double sagitta =
        kHertzRadius - std::sqrt(kHertzRadius * kHertzRadius - node[across] * node[across]);
    node.z() -= sagitta * (1 + node.z() / kHertzDepth);
  }
  return mesh;
}

void add_lower(Scene& scene, const MeshData& mesh) {
  scene.tissue("lower", mesh, fem::NeoHookean(kHertzYoung, kHertzPoisson));
  scene.add(stand("floor"));
  scene.tie("lower", "floor", -1.001 * kHertzDepth, -0.999 * kHertzDepth);
}

}  // namespace

void study_hertz(const StudyOptions& options) {
  print_header("Hertz: a rigid sphere on a block");
  for (const int elements : {2, 4, 8}) {
    if (elements > options.finest) continue;
    Scene scene(options);
    add_lower(scene, fine_block(kContactRadius / elements));
    // Facets of a/16: their sagitta is 0.05 % of δ.
    scene.add_rigid("sphere",
                    sphere_cap(kHertzRadius, 3 * kContactRadius, kHertzFine, kContactRadius / 16));
    scene.touch("sphere", "lower");
    scene.drive("sphere", {Vec3::Zero(), Vec3(0, 0, -kApproach)});
    print_row(elements, scene, options, hertz(kHertzYoung / (1 - kHertzPoisson * kHertzPoisson)));
  }
}

void study_cylinders(const StudyOptions& options) {
  print_header("Crossed cylinders, both of tissue");
  for (const int elements : {2, 4, 8}) {
    if (elements > options.finest) continue;
    constexpr double kOther = 1.13;  // cells of the upper one: the meshes do not match
    Scene scene(options);
    add_lower(scene, half_cylinder(kContactRadius / elements, 0));
    MeshData upper = half_cylinder(kOther * kContactRadius / elements, 1);
    Placement turned;
    turned.rotation = {pi, 0, 0};
    place(turned, upper.X);
    scene.tissue("upper", upper, fem::NeoHookean(kHertzYoung, kHertzPoisson));
    scene.add(stand("press"));
    scene.tie("upper", "press", 0.999 * kHertzDepth, 1.001 * kHertzDepth);
    scene.touch("upper", "lower");
    scene.drive("press", {Vec3::Zero(), Vec3(0, 0, -kApproach)});
    print_row(elements, scene, options,
              hertz(0.5 * kHertzYoung / (1 - kHertzPoisson * kHertzPoisson)));
  }
}

}  // namespace articular::sim
