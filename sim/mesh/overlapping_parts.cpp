#include "sim/mesh/overlapping_parts.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "fem/mesh/mesh_parts.hpp"
#include "sim/mesh/own_nodes.hpp"

namespace articular::sim {
namespace {

/// The surfaces of the parts, each with its own nodes.
std::vector<Solid> solids_of_parts(const Positions& X, const Tetrahedra& tets,
                                   const std::vector<int>& parts) {
  std::map<int, std::vector<Eigen::Vector3i>> of_part;
  const Eigen::Matrix3Xi faces = collision::build_surface(tets, static_cast<int>(X.cols())).faces;
  for (const Eigen::Vector3i face : faces.colwise())
    of_part[parts[static_cast<std::size_t>(face[0])]].push_back(face);
  std::vector<Solid> solids;
  solids.reserve(of_part.size());
  for (const auto& [lowest, corners] : of_part) {
    Triangles triangles(3, static_cast<Eigen::Index>(corners.size()));
    for (std::size_t f = 0; f < corners.size(); ++f)
      triangles.col(static_cast<Eigen::Index>(f)) = corners[f];
    const std::vector<int> nodes = keep_own_nodes(triangles);
    solids.emplace_back(X(Eigen::all, nodes), triangles);
  }
  return solids;
}

}  // namespace

std::optional<DeepestPoint> deepest_in_another_part(const Positions& X, const Tetrahedra& tets,
                                                    double least) {
  const std::vector<int> parts = fem::parts_of_nodes(static_cast<int>(X.cols()), tets);
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
