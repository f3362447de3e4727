#pragma once

#include <vector>

#include "sim/build/body_geometry.hpp"
#include "sim/mesh/triangle_tree.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// Which points a region of the scenario contains, in the geometry at the start.
class RegionTest {
 public:
  /// @param geometry  of each of the model's bodies
  RegionTest(const Region& region, const Model& model, const std::vector<BodyGeometry>& geometry);

  /// @param on_surface  whether the point is a surface node of its tissue
  bool contains(const Vec3& x, bool on_surface) const;

 private:
  const Region& region_;
  TriangleTree near_;  // surface of the body that the region lies near, if any
};

}  // namespace articular::sim
