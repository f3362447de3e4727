#include "sim/build/weighted_points.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/place_text.hpp"
#include "sim/build/region.hpp"
#include "sim/build/usual.hpp"
#include "sim/mesh/triangle_tree.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

void set_equal_weights(WeightedPoint& point) {
  point.weights.assign(point.nodes.size(), 1.0 / static_cast<double>(point.nodes.size()));
}

/// Relative; what is nearer to a face of a tetrahedron lies on it.
constexpr double kOnFace = 1e-9;

/// A point farther than this part of a rigid body's size from its surface is not meant: points of
/// recorded muscles lie beside scanned bones by less.
constexpr double kBesideBone = 0.1;

/// @param most  [m] that the point may lie from the surface  @param what  that is
void refuse_far(const Anchor& anchor, const std::string& body, double distance, double most,
                const char* what) {
  if (!(distance > most)) return;
  throw InputError(anchor.where,
                   fmt::format("the point {} lies {:.3g} mm from `{}`: "
                               "expected one in it, or within {} ({:.3g} mm) of its surface",
                               place_text(anchor.point), 1e3 * distance, body, what, 1e3 * most));
}

/// Moves with the body wherever it lies.
WeightedPoint point_of_rigid_body(const Anchor& anchor, const BodyModel& body,
                                  const RigidBody& rigid) {
  if (!anchor.beyond_mesh && body.triangles.cols() > 0 && body.X.cols() > 0) {
    const Vec3 x = anchor.point - rigid.rest.p;
    const double size = (body.X.rowwise().maxCoeff() - body.X.rowwise().minCoeff()).norm();
    const double to_node = std::sqrt((body.X.colwise() - x).colwise().squaredNorm().minCoeff());
    if (to_node > kBesideBone * size && winding_number(body.X, body.triangles, x) < 0.5)
      refuse_far(anchor, body.name, TriangleTree(body.X, body.triangles).distance(x),
                 kBesideBone * size, "a tenth of its size");
  }
  return {{{rigid.block, body.rigid, anchor.point - rigid.rest.p}}, {1}};
}

/// The corners' parts in x, which add up to 1: none is negative where x lies in the tetrahedron.
Eigen::Vector4d barycentric(const Positions& X, const Eigen::Vector4i& tet, const Vec3& x) {
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = X.col(tet[a + 1]) - X.col(tet[0]);
  const Vec3 parts = edges.inverse() * (x - X.col(tet[0]));
  return {1 - parts.sum(), parts[0], parts[1], parts[2]};
}

/// In the tetrahedron that holds x; empty where none does.
WeightedPoint inner_point(const Tissue& tissue, const Vec3& x) {
  WeightedPoint point;
  for (const auto& tet : tissue.elements.tets().colwise()) {
    const Eigen::Vector4d parts = barycentric(tissue.X, tet, x);
    if (!(parts.minCoeff() > -kOnFace)) continue;
    for (int a = 0; a < 4; ++a) {
      if (parts[a] <= kOnFace) continue;
      point.nodes.push_back(tissue.nodes[static_cast<std::size_t>(tet[a])]);
      point.weights.push_back(parts[a]);
    }
    if (point.nodes.size() == 1) point.weights[0] = 1;
    break;
  }
  return point;
}

/// The nodes of the surface within the anchor's radius, in equal parts; may be none.
WeightedPoint nodes_within(const Anchor& anchor, const Tissue& tissue,
                           const std::vector<char>& on_surface) {
  WeightedPoint point;
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
    if (on_surface[i] != 0 &&
        (tissue.X.col(static_cast<Eigen::Index>(i)) - anchor.point).norm() <= anchor.radius)
      point.nodes.push_back(tissue.nodes[i]);
  if (!point.nodes.empty()) set_equal_weights(point);
  return point;
}

/// In the tissue the place itself; beside it the nearest node of its surface.
WeightedPoint point_of_tissue(const Anchor& anchor, const BodyModel& body, const Tissue& tissue,
                              const collision::Surface& surface) {
  WeightedPoint point = inner_point(tissue, anchor.point);
  if (!point.nodes.empty()) return point;
  const double distance = TriangleTree(tissue.X, surface.faces).distance(anchor.point);
  const double element = element_size(tissue);
  refuse_far(anchor, body.name, distance, element, "an element");
  const std::vector<char> on_surface = surface_nodes(tissue, surface);
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const double to_node =
        (tissue.X.col(static_cast<Eigen::Index>(i)) - anchor.point).squaredNorm();
    if (on_surface[i] == 0 || to_node >= least) continue;
    least = to_node;
    nearest = i;
  }
  return {{tissue.nodes[nearest]}, {1}};
}

}  // namespace

std::vector<char> surface_nodes(const Tissue& tissue, const collision::Surface& surface) {
  std::vector<char> on_surface(tissue.nodes.size(), 0);
  for (const int node : surface.faces.reshaped()) on_surface[static_cast<std::size_t>(node)] = 1;
  return on_surface;
}

WeightedPoint anchored_point(const Anchor& anchor, int body, const Model& model,
                             const std::vector<collision::Surface>& surfaces,
                             std::vector<std::string>& warnings) {
  const BodyModel& of = model.bodies[static_cast<std::size_t>(body)];
  if (of.rigid >= 0)
    return point_of_rigid_body(anchor, of, model.rigid_bodies[static_cast<std::size_t>(of.rigid)]);
  const auto t = static_cast<std::size_t>(of.tissue);
  if (anchor.radius > 0) {
    const std::vector<char> on_surface = surface_nodes(model.tissues[t], surfaces[t]);
    WeightedPoint patch = nodes_within(anchor, model.tissues[t], on_surface);
    if (patch.nodes.size() < 2)
      warnings.push_back(
          prefix(anchor.where) +
          fmt::format("{} of the surface of `{}` lies within the radius of {:g} mm: the force is "
                      "not spread",
                      patch.nodes.empty() ? "no node" : "one node", of.name, 1e3 * anchor.radius));
    if (static_cast<std::ptrdiff_t>(patch.nodes.size()) ==
        std::count(on_surface.begin(), on_surface.end(), char{1}))
      warnings.push_back(unit_doubt(
          anchor.where, fmt::format("the whole surface of `{}` lies within the radius of {:g} mm",
                                    of.name, 1e3 * anchor.radius)));
    if (!patch.nodes.empty()) return patch;
  }
  return point_of_tissue(anchor, of, model.tissues[t], surfaces[t]);
}

WeightedPoint region_point(const Region& region, int tissue, const Model& model,
                           const std::vector<BodyGeometry>& geometry,
                           const collision::Surface& surface) {
  const Tissue& of = model.tissues[static_cast<std::size_t>(tissue)];
  const RegionTest test(region, of.body, model, geometry);
  const std::vector<char> on_surface = surface_nodes(of, surface);
  WeightedPoint point;
  for (std::size_t i = 0; i < of.nodes.size(); ++i)
    if (test.contains_node(static_cast<int>(i), of.X.col(static_cast<Eigen::Index>(i)),
                           on_surface[i] != 0))
      point.nodes.push_back(of.nodes[i]);
  if (!point.nodes.empty()) set_equal_weights(point);
  return point;
}

}  // namespace articular::sim
