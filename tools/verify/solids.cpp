#include "tools/verify/solids.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tools/verify/meshes.hpp"
#include "tools/verify/scene.hpp"

namespace articular::tools {
namespace {

// --- patch test

constexpr const char* kPatch = R"(
title = "Patch test of elements"
duration = "1 s"
analysis = "static"
contact = false
[integrator]
step = "1 s"
[[body]]
name = "floor"
kind = "fixed"
[[body]]
name = "clamp"
kind = "fixed"
[[body]]
name = "block"
kind = "tissue"
mesh = { file = "block.vtu", unit = "m" }
density = "1000 kg/m^3"
material = { law = "corotated", young_modulus = "20 kPa", poisson_ratio = 0, element = "plain" }
[[attach]]
body = "block"
to = "floor"
region = { box = ["-1 -1 -0.1 mm", "9 9 0.1 mm"] }
[[attach]]
body = "block"
to = "clamp"
region = { box = ["-1 -1 7.9 mm", "9 9 8.1 mm"] }
[[load]]
kind = "motion"
body = "clamp"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 0.8 mm"]
[[probe]]
name = "middle"
kind = "point"
body = "block"
point = "4 4 4 mm"
[[probe]]
name = "clamp"
kind = "reaction"
body = "clamp"
)";

/// A cube of 8 mm, irregular inside, is drawn out by 10 %. At ν = 0 the exact field is linear,
/// u_z = z/10, and the corotated law's nominal stress is E/10: force E A/10 = 0.128 N. Linear
/// elements hold that field on any mesh [Irons 1972], so what is left is Newton's iteration,
/// which stops at 1e-6 of the largest force.
std::vector<Finding> element_patch(const Laboratory& laboratory, const std::string& element) {
  constexpr double kIteration = 1e-6;
  sim::write_mesh(laboratory.folder / "block.vtu", irregular_box(Vec3::Constant(0.008), {4, 4, 4}),
                  1);
  const Curves curves =
      run_scene(laboratory, {"patch", kPatch, {"body.block.material.element=" + element}});
  const double z = curves("middle.position.z [mm]").front();  // the node nearest to the middle
  return {relative("force of the clamp", "N", -0.1 * 20e3 * 64e-6, curves.last("clamp.force.z [N]"),
                   kIteration),
          relative("rise of the node in the middle", "mm", 0.1 * z,
                   curves.last("middle.position.z [mm]") - z, kIteration)};
}

// --- cantilever

/// scenarios/verification/bending_beam.toml in equilibrium; the way of its end down [mm].
double deflection(const Laboratory& laboratory, const std::string& element,
                  const std::string& cells, double poisson_ratio) {
  const Curves curves =
      run_scene(laboratory,
                shipped_scene("bending_beam",
                              {"analysis=static", "duration=1 s", "integrator.step=1 s",
                               "output.interval=1 s", "body.beam.geometry.box.cells=" + cells,
                               "body.beam.material.element=" + element,
                               fmt::format("body.beam.material.poisson_ratio={}", poisson_ratio)}));
  return -curves.last("end.position.z [mm]");
}

struct BeamCase {
  double poisson_ratio;
  /// The same tetrahedra in CalculiX 2.20 (C3D4, linear statics), to seven digits [mm].
  double same_mesh;
  /// Converged [mm].
  double exact, uncertainty;
};

/// ν = 0: Timoshenko's beam, see the scenario. Else CalculiX 2.20 with quadratic hexahedra
/// (C3D20R): 24 x 2 x 4 to 72 x 6 x 12 cells, extrapolated with the order that they show. That is
/// 1.5 and 1.2, for stress has no bound at the edges of the clamp.
constexpr BeamCase kBeams[] = {
    {0, 1.647696, 1.9495, 0}, {0.3, 1.659795, 1.9434, 0.0003}, {0.499, 1.534521, 1.9127, 0.001}};

/// Plain tetrahedra are too stiff, and lock as ν comes near 0.5 (−20 %). But how much too stiff is
/// known: another program with the same tetrahedra says it, to the digits that it prints.
Finding plain_cantilever(const Laboratory& laboratory, const BeamCase& beam) {
  constexpr double kDigits = 1e-6;
  return relative(fmt::format("deflection, nu = {}, as by CalculiX", beam.poisson_ratio), "mm",
                  beam.same_mesh, deflection(laboratory, "plain", "[24, 2, 4]", beam.poisson_ratio),
                  kDigits);
}

/// Smoothed tetrahedra are right but for what 8 cells across the depth leave: 1.2 % at ν = 0
/// (scenarios/verification/RESULTS.md).
Finding smoothed_cantilever(const Laboratory& laboratory, const BeamCase& beam) {
  constexpr double kDiscretisation = 0.015;
  return relative(fmt::format("deflection, nu = {}, converged", beam.poisson_ratio), "mm",
                  beam.exact, deflection(laboratory, "smoothed", "[48, 4, 8]", beam.poisson_ratio),
                  kDiscretisation + beam.uncertainty / beam.exact);
}

std::vector<Finding> cantilevers(const Laboratory& laboratory,
                                 Finding (*one)(const Laboratory&, const BeamCase&)) {
  std::vector<Finding> findings;
  for (const BeamCase& beam : kBeams) findings.push_back(one(laboratory, beam));
  return findings;
}

// --- torsion

constexpr const char* kTwist = R"(
title = "Torsion of a cylinder"
duration = "1 s"
analysis = "static"
contact = false
[integrator]
step = "0.25 s"
[[body]]
name = "low"
kind = "fixed"
[[body]]
name = "high"
kind = "fixed"
[[body]]
name = "bar"
kind = "tissue"
mesh = { file = "bar.vtu", unit = "m" }
density = "1000 kg/m^3"
[body.material]
law = "isochoric-neo-hookean"
young_modulus = "30 kPa"
poisson_ratio = 0.499
element = "smoothed"
[[attach]]
body = "bar"
to = "low"
region = { box = ["-9 -9 -0.1 mm", "9 9 0.1 mm"] }
[[attach]]
body = "bar"
to = "high"
region = { box = ["-9 -9 19.9 mm", "9 9 20.1 mm"] }
[[load]]
kind = "motion"
body = "high"
time = ["0 s", "1 s"]
rotation = ["0 0 0 deg", "0 0 150 deg"]
interpolation = "linear"
[[probe]]
name = "high"
kind = "attachment"
bodies = ["bar", "high"]
)";

/// A cylinder of R = 5 mm and L = 20 mm, glued to plates of which one turns by 150 degrees, τ =
/// 131 rad/m: a shear of 0.65 at its surface. With μ/2 (I1 − 3) and no change of volume each
/// section turns as it is, and the plate feels
///
///   M = π μ τ R⁴/2,   N = π μ τ² R⁴/4 (outwards: a twisted bar gets longer, Poynting's effect)
///
/// [Rivlin 1948, Large elastic deformations of isotropic materials IV, Phil Trans A 241:379]. What
/// remains is the mesh: with 6 x 9, 8 x 12 and 8 x 24 cells (across x along) the moment is 8.8, 4.6
/// and 1.4 % too large.
std::vector<Finding> torsion(const Laboratory& laboratory) {
  constexpr double kDiscretisation = 0.02;
  constexpr double pi = std::numbers::pi, R = 0.005, L = 0.02, tau = 150 * pi / 180 / L;
  constexpr double mu = 30e3 / (2 * 1.499);
  sim::write_mesh(laboratory.folder / "bar.vtu", cylinder(R, L, 8, 24), 1);
  const Curves curves = run_scene(laboratory, {"twist", kTwist});
  const double moment = pi * mu * tau * std::pow(R, 4) / 2;
  const double thrust = pi * mu * tau * tau * std::pow(R, 4) / 4;
  return {relative("moment", "N m", -moment, curves.last("high.moment.z [N m]"), kDiscretisation),
          relative("thrust", "N", thrust, curves.last("high.force.z [N]"), kDiscretisation),
          vanishing("sideways force", "N", curves.last("high.force.x [N]"), thrust, 1e-2)};
}

}  // namespace

std::vector<Problem> solid_problems() {
  const auto patch = [](const char* element) {
    return [element](const Laboratory& laboratory) { return element_patch(laboratory, element); };
  };
  return {{"patch/plain", true, patch("plain")},
          {"patch/smoothed", true, patch("smoothed")},
          {"cantilever/plain", true,
           [](const Laboratory& l) { return cantilevers(l, plain_cantilever); }},
          {"cantilever/smoothed", false,
           [](const Laboratory& l) { return cantilevers(l, smoothed_cantilever); }},
          {"twist/cylinder", false, torsion}};
}

}  // namespace articular::tools
