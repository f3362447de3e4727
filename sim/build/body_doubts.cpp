#include "sim/build/body_doubts.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/mesh/tetrahedron.hpp"
#include "sim/base/error.hpp"
#include "sim/mesh/extent.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Of a ball's volume; elements up to 0.6 of the radius leave more.
constexpr double kLeastVolume = 0.9;

/// Of a layer's stiffness per area by E/h: that of ν = 0.495. Articular cartilage at once has 0.49
/// in the literature, and 17.
constexpr double kMostStiffening = 34;

/// By the longest side of what is drawn: how far contact meshes may reach beyond it, how long they
/// are at the least, how far a centre of mass may lie from its middle, and by how much a radius of
/// gyration may differ.
constexpr double kFarthestBeyond = 0.5, kLeastPart = 0.005, kFarthestCentre = 2,
                 kFarthestGyration = 20;

/// Of a mass by the volume of the mesh [kg/m³]: a bone stands for a limb, and a ball for a weight.
constexpr double kLeastDensity = 1, kMostDensity = 1e6;

double volume_of(const MeshData& mesh) {
  double six_volumes = 0;
  for (const auto& tet : mesh.tets.colwise())
    six_volumes += fem::edge_matrix(mesh.X(Eigen::all, tet)).determinant();
  return six_volumes / 6;
}

std::string doubt_of_ball(const Body& body, const MeshData& mesh) {
  const auto* const ball = std::get_if<SphereGeometry>(&body.geometry);
  if (ball == nullptr || body.kind == Body::Kind::Fixed) return "";
  const double true_volume =
      4 * std::numbers::pi / 3 * std::pow(ball->radius * body.placement.scale, 3);
  const double volume = volume_of(mesh);
  if (volume >= kLeastVolume * true_volume) return "";
  const std::string masses =
      body.density ? fmt::format(", and a mass of {:.4g} g for {:.4g} g",
                                 1e3 * *body.density * volume, 1e3 * *body.density * true_volume)
                   : "";
  return fmt::format(
      "the ball `{}` has a volume of {:.4g} mm^3 for {:.4g} mm^3 of a true one{}: "
      "expected a smaller `element_size`",
      body.name, 1e9 * volume, 1e9 * true_volume, masses);
}

std::string doubt_of_layer(const Body& body) {
  if (!body.layer) return "";
  const double nu = body.layer->poisson_ratio;
  const double stiffening = constrained_modulus(1, nu);
  if (!(stiffening > kMostStiffening)) return "";
  return fmt::format(
      "the layer of `{}` is {:.0f} times as stiff as its Young's modulus by its "
      "thickness, as its Poisson's ratio is {:g} and it can't bulge: is it meant "
      "to be as good as rigid?",
      body.name, stiffening, nu);
}

/// Faces that touch lie on what is drawn, or extend it a little: else one of both files has another
/// unit.
std::string doubt_of_contact_surface(const Body& body, const BodyGeometry& geometry) {
  const double drawn = extent(geometry.mesh.X), touching = extent(geometry.contact.X);
  if (!(drawn > 0) || !(touching > 0)) return "";
  const double beyond = std::max(
      (geometry.contact.X.rowwise().maxCoeff() - geometry.mesh.X.rowwise().maxCoeff()).maxCoeff(),
      (geometry.mesh.X.rowwise().minCoeff() - geometry.contact.X.rowwise().minCoeff()).maxCoeff());
  if (beyond <= kFarthestBeyond * drawn && touching >= kLeastPart * drawn) return "";
  return fmt::format(
      "the contact meshes of `{}` are {:.3g} mm long and reach {:.3g} mm beyond its mesh, which is "
      "{:.3g} mm long: is the `unit` of each the one that was meant?",
      body.name, 1e3 * touching, 1e3 * std::max(beyond, 0.0), 1e3 * drawn);
}

/// Of a body that is one with its mesh.
std::string doubt_of_mass(const Body& body, const MeshData& mesh) {
  const double size = extent(mesh.X);
  if (body.kind != Body::Kind::Rigid || !(size > 0)) return "";
  const Vec3 middle = (mesh.X.rowwise().maxCoeff() + mesh.X.rowwise().minCoeff()) / 2;
  if (body.center_of_mass && (*body.center_of_mass - middle).norm() > kFarthestCentre * size)
    return fmt::format(
        "the centre of mass of `{}` lies {:.3g} mm from the middle of its mesh, "
        "which is {:.3g} mm long",
        body.name, 1e3 * (*body.center_of_mass - middle).norm(), 1e3 * size);
  const double volume =  // an open surface has none
      is_closed(mesh.triangles) ? solid_mass_properties(mesh.X, mesh.triangles, 1).mass : 0;
  if (body.mass && volume > 0 &&
      (*body.mass < kLeastDensity * volume || *body.mass > kMostDensity * volume))
    return fmt::format(
        "`{}` has a mass of {:.3g} kg, {:.2g} times that of as much water as its mesh holds",
        body.name, *body.mass, *body.mass / (1000 * volume));
  if (!body.inertia || !(body.mass || body.density)) return "";
  const double mass = body.mass ? *body.mass : *body.density * volume;
  const double radius = std::sqrt(body.inertia->trace() / (2 * mass));  // of gyration
  if (radius >= size / kFarthestGyration && radius <= kFarthestGyration * size) return "";
  return fmt::format(
      "with its mass and inertia `{}` has a radius of gyration of {:.3g} mm, and its "
      "mesh is {:.3g} mm long",
      body.name, 1e3 * radius, 1e3 * size);
}

}  // namespace

std::vector<std::string> body_doubts(const Scenario& scenario,
                                     const std::vector<BodyGeometry>& geometry) {
  std::vector<std::string> doubts;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const Body& body = scenario.bodies[b];
    for (const std::string& what :
         {doubt_of_ball(body, geometry[b].mesh), doubt_of_layer(body),
          doubt_of_contact_surface(body, geometry[b]), doubt_of_mass(body, geometry[b].mesh)})
      if (!what.empty()) doubts.push_back(prefix(body.where) + what);
  }
  return doubts;
}

}  // namespace articular::sim
