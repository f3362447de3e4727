#pragma once

#include <Eigen/Core>

#include "fem/types.hpp"

namespace articular::anatomy {

/// A mesh in mm: triangles (surface) or tetrahedra (tissue), whose fibres may be known.
struct Mesh {
  Positions X_mm;
  Tetrahedra tets;
  Triangles triangles;
  FibreDirections fibres{};  // one a tetrahedron, or none
};

}  // namespace articular::anatomy
