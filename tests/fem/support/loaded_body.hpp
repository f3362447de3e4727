#pragma once

#include <Eigen/Core>

#include "fem/sparse/block_matrix.hpp"
#include "fem/sparse/pressure_gradient.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::fem {

/// A mesh with supports and dead loads, and the displacement that is asked for.
struct LoadedBody {
  TetMesh mesh;
  Eigen::Array<bool, 3, Eigen::Dynamic> fixed;  // components that keep their rest position
  Positions f_ext;                              // [N]
  int probe = 0, axis = 0;                      // result: this component of this node

  explicit LoadedBody(TetMesh m);
};

/// How a box mesh becomes irregular: inner nodes moved by up to 25 % of a cell (nodes of a face
/// stay in it), or also another split of each cell (five tetrahedra, every second cell mirrored).
enum class MeshKind { Kuhn, MovedNodes, FiveTetrahedra };

/// Cook's membrane as a slab one layer thick in plane strain: 48 x 44/16, clamped at x = 0, shear
/// traction 6.25 upward on the face x = 48; the result is u_y of the corner (48, 60). Units of
/// length and stress are free: mm and MPa, say.
LoadedBody cook_membrane(int n, MeshKind kind = MeshKind::Kuhn);
/// On any mesh of that shape with nodes where its corners are.
LoadedBody cook_membrane(TetMesh mesh);
/// Its shape: where a point of the unit cube comes to lie.
Vec3 cook_point(int n, const Vec3& unit);

/// A quarter of a 2 x 2 x 1 block between a smooth base and a top that keeps its horizontal place,
/// with the dead pressure 100 on x, y ≤ 0.5 of the top; the result is u_z of (0, 0, 1).
LoadedBody block_compression(int n, MeshKind kind = MeshKind::Kuhn);
/// On any mesh of the unit cube with edges around the load.
LoadedBody block_compression(TetMesh mesh);

/// A cantilever of 10 x 1 x 1, 40n x 2n x 2n cells of six tetrahedra each (n = 1: 960), clamped
/// at x = 0, with the dead force `force` upward spread over the face x = 10; the result is u_y in
/// its middle.
LoadedBody bent_beam(int n, double force, MeshKind kind = MeshKind::Kuhn);

/// Rows (and columns) of fixed components become zero, those of K's diagonal one times `diagonal`.
void fix_components(const Eigen::Array<bool, 3, Eigen::Dynamic>& fixed, double diagonal,
                    BlockMatrix& K);
void fix_components(const Eigen::Array<bool, 3, Eigen::Dynamic>& fixed, PressureGradient& G);

}  // namespace articular::fem
