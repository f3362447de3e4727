#pragma once

#include <vector>

namespace articular::collision {

/// A surface triangle of one mesh meets a tetrahedron of another (or of the same) mesh.
struct Penetration {
  int face;         // index into the first mesh's Surface::faces
  int tetrahedron;  // index into the second mesh's tetrahedra
  friend auto operator<=>(const Penetration&, const Penetration&) = default;
};

}  // namespace articular::collision
