#pragma once

#include <array>
#include <optional>
#include <set>
#include <vector>

#include "sim/build/body_geometry.hpp"
#include "sim/mesh/triangle_tree.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// Which nodes and faces of a body a region of the scenario contains, in the geometry at the start.
class RegionTest {
 public:
  /// @param body      index of the one that the region is a part of
  /// @param geometry  of each of the model's bodies
  /// @throws InputError if the region names a set that the body's mesh does not have
  RegionTest(const Region& region, int body, const Model& model,
             const std::vector<BodyGeometry>& geometry);

  /// @param node        of the body's mesh
  /// @param on_surface  whether it is a surface node of its tissue
  bool contains_node(int node, const Vec3& x, bool on_surface) const;

  /// A face of the surface, which counts by its middle, and in a set by its nodes.
  /// @param nodes  of the body's mesh
  bool contains_face(const Eigen::Vector3i& nodes, const Vec3& middle) const;

  /// An element, which counts by its middle, and in a set by its nodes. None is on the surface.
  /// @param nodes  of the body's mesh
  bool contains_element(const Eigen::Vector4i& nodes, const Vec3& middle) const;

 private:
  bool contains(const Vec3& x, bool on_surface) const;

  const Region& region_;
  TriangleTree near_;                          // of the body that the region lies near, if any
  std::vector<char> in_set_;                   // by node, where the region names a set
  std::set<std::array<int, 3>> faces_of_set_;  // nodes in ascending order; none: all by their nodes
};

/// Columns of the faces of a tissue's surface that a region contains.
std::vector<int> faces_in(const Region& region, int body, const Model& model,
                          const std::vector<BodyGeometry>& geometry, const Tissue& tissue,
                          const Triangles& faces);

}  // namespace articular::sim
