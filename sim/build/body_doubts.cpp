#include "sim/build/body_doubts.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "fem/mesh/tetrahedron.hpp"
#include "sim/base/error.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Of a ball's volume; elements up to 0.6 of the radius leave more.
constexpr double kLeastVolume = 0.9;

/// Of a layer's stiffness per area by E/h: that of ν = 0.495. Articular cartilage at once has 0.49
/// in the literature, and 17.
constexpr double kMostStiffening = 34;

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

}  // namespace

std::vector<std::string> body_doubts(const Scenario& scenario,
                                     const std::vector<BodyGeometry>& geometry) {
  std::vector<std::string> doubts;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const Body& body = scenario.bodies[b];
    for (const std::string& what : {doubt_of_ball(body, geometry[b].mesh), doubt_of_layer(body)})
      if (!what.empty()) doubts.push_back(prefix(body.where) + what);
  }
  return doubts;
}

}  // namespace articular::sim
