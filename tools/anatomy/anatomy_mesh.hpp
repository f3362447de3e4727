#pragma once

#include <Eigen/Core>
#include <numbers>

#include "fem/base/types.hpp"

namespace articular::anatomy {

using Vec2 = Eigen::Vector2d;
inline constexpr double kDeg = std::numbers::pi / 180;  // [rad]

/// A mesh in mm: triangles (surface) or tetrahedra (tissue), whose fibres may be known.
struct Mesh {
  Positions X_mm;
  Tetrahedra tets;
  Triangles triangles;
  FibreDirections fibres{};  // one a tetrahedron, or none
};

}  // namespace articular::anatomy
