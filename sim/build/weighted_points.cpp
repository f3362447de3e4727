#include "sim/build/weighted_points.hpp"

#include <limits>

#include "sim/build/region.hpp"

namespace articular::sim {
namespace {

void set_equal_weights(WeightedPoint& point) {
  point.weights.assign(point.nodes.size(), 1.0 / static_cast<double>(point.nodes.size()));
}

}  // namespace

std::vector<char> surface_nodes(const Tissue& tissue, const collision::Surface& surface) {
  std::vector<char> on_surface(tissue.nodes.size(), 0);
  for (const int node : surface.faces.reshaped()) on_surface[static_cast<std::size_t>(node)] = 1;
  return on_surface;
}

WeightedPoint anchored_point(const Anchor& anchor, int body, const Model& model,
                             const std::vector<collision::Surface>& surfaces) {
  const BodyModel& of = model.bodies[static_cast<std::size_t>(body)];
  WeightedPoint point;
  if (of.rigid >= 0) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(of.rigid)];
    point.nodes.push_back({rigid.block, of.rigid, anchor.point - rigid.rest.p});
    point.weights.push_back(1);
    return point;
  }
  const auto t = static_cast<std::size_t>(of.tissue);
  const Tissue& tissue = model.tissues[t];
  const std::vector<char> on_surface = surface_nodes(tissue, surfaces[t]);
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    if (on_surface[i] == 0) continue;
    const double distance = (tissue.X.col(static_cast<Eigen::Index>(i)) - anchor.point).norm();
    if (distance < least) {
      least = distance;
      nearest = i;
    }
    if (distance <= anchor.radius) point.nodes.push_back(tissue.nodes[i]);
  }
  if (point.nodes.empty()) point.nodes.push_back(tissue.nodes[nearest]);
  set_equal_weights(point);
  return point;
}

WeightedPoint region_point(const Region& region, int tissue, const Model& model,
                           const std::vector<BodyGeometry>& geometry,
                           const collision::Surface& surface) {
  const Tissue& of = model.tissues[static_cast<std::size_t>(tissue)];
  const RegionTest test(region, model, geometry);
  const std::vector<char> on_surface = surface_nodes(of, surface);
  WeightedPoint point;
  for (std::size_t i = 0; i < of.nodes.size(); ++i)
    if (test.contains(of.X.col(static_cast<Eigen::Index>(i)), on_surface[i] != 0))
      point.nodes.push_back(of.nodes[i]);
  if (!point.nodes.empty()) set_equal_weights(point);
  return point;
}

}  // namespace articular::sim
