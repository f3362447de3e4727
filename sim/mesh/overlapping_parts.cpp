#include "sim/mesh/overlapping_parts.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "collision/mesh/surface.hpp"

namespace articular::sim {
namespace {

/// A node of each node's part, the same for all of the part.
std::vector<int> parts_of_nodes(Eigen::Index num_nodes, const Tetrahedra& tets) {
  std::vector<int> up(static_cast<std::size_t>(num_nodes));
  std::iota(up.begin(), up.end(), 0);
  const auto top = [&](int node) {
    int& to = up[static_cast<std::size_t>(node)];
    while (up[static_cast<std::size_t>(to)] != to) to = up[static_cast<std::size_t>(to)];
    return to;
  };
  for (const auto& tet : tets.colwise())
    for (int k = 1; k < 4; ++k) up[static_cast<std::size_t>(top(tet[k]))] = top(tet[0]);
  for (int& part : up) part = top(part);
  return up;
}

/// The surfaces of the parts, each with its own nodes.
std::vector<Solid> solids_of_parts(const Positions& X, const Tetrahedra& tets,
                                   const std::vector<int>& parts) {
  struct Part {
    std::vector<Vec3> nodes;
    std::vector<int> corners;  // three a face
  };
  std::map<int, Part> of_part;
  std::map<int, int> of_node;
  const Eigen::Matrix3Xi faces = collision::build_surface(tets, static_cast<int>(X.cols())).faces;
  for (const int node : faces.reshaped()) {
    Part& part = of_part[parts[static_cast<std::size_t>(node)]];
    const auto [at, is_new] = of_node.emplace(node, static_cast<int>(part.nodes.size()));
    if (is_new) part.nodes.emplace_back(X.col(node));
    part.corners.push_back(at->second);
  }
  std::vector<Solid> solids;
  solids.reserve(of_part.size());
  for (const auto& [first, part] : of_part)
    solids.emplace_back(
        Positions(Eigen::Map<const Positions>(part.nodes.data()->data(), 3,
                                              static_cast<Eigen::Index>(part.nodes.size()))),
        Triangles(Eigen::Map<const Triangles>(part.corners.data(), 3,
                                              static_cast<Eigen::Index>(part.corners.size() / 3))));
  return solids;
}

}  // namespace

std::optional<DeepestPoint> deepest_in_another_part(const Positions& X, const Tetrahedra& tets,
                                                    double least) {
  const std::vector<int> parts = parts_of_nodes(X.cols(), tets);
  if (std::adjacent_find(parts.begin(), parts.end(), std::not_equal_to<>()) == parts.end())
    return std::nullopt;
  const std::vector<Solid> solids = solids_of_parts(X, tets, parts);
  std::optional<DeepestPoint> deepest;
  for (const Solid& inner : solids)
    for (const Solid& outer : solids) {
      if (&inner == &outer || !inner.box.intersects(outer.box)) continue;
      const double beyond = deepest ? deepest->depth : least;
      if (const auto found = deepest_inside(inner.X, outer, beyond)) deepest = found;
    }
  return deepest;
}

}  // namespace articular::sim
