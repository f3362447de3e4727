#pragma once

#include <vector>

#include "fem/base/types.hpp"
#include "fem/material/crimped_fibre.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// A thin sheet of fibres that lies in faces of a mesh and moves with them: an aponeurosis, a
/// fascia, a capsule. It pulls along its fibres only when these are stretched, and resists nothing
/// else: of a face of area A at rest its energy is A t W(λ), λ = |Σ x_a c_a| over the corners.
class FibreSheet {
 public:
  /// @param faces   one column a face: nodes of the mesh
  /// @param fibres  the direction near each face; the part of it within the face counts
  /// @param thickness  t [m], > 0
  /// @param law     stiffness [Pa], by the area at rest
  /// @param matrix  what add_stiffness() will add to: one block row a node, with the couplings of
  ///                the elements at least
  /// @throws std::invalid_argument with the place of a face that has no area, or that fibres cross
  FibreSheet(const Positions& X, const Triangles& faces, const Eigen::Matrix3Xd& fibres,
             double thickness, const CrimpedFibre& law, const BlockMatrix& matrix);

  const Triangles& faces() const { return faces_; }
  const Eigen::VectorXd& area() const { return area_; }  // of each face at rest [m²]

  double energy(const Positions& x) const;  // [J]
  /// f += the force [N] that the shape x asks for.
  void add_force(const Positions& x, Positions& f) const;
  /// K += scale * ∂f/∂x [N/m]: symmetric, positive semidefinite.
  void add_stiffness(const Positions& x, double scale, BlockMatrix& K) const;

  /// Of the fibres of each face [-], and their pull by the width of the sheet [N/m].
  Eigen::VectorXd stretch(const Positions& x) const;
  Eigen::VectorXd tension(const Positions& x) const;

 private:
  Vec3 fibre(const Positions& x, Eigen::Index face) const;  // as long as it is stretched

  Triangles faces_;
  Eigen::Matrix3Xd along_;  // c: ∂N/∂X of each corner along the fibre [1/m]
  Eigen::VectorXd area_;    // [m²]
  double thickness_;        // [m]
  CrimpedFibre law_;
  std::vector<int> slots_;  // 9 a face, 3b + a
};

}  // namespace articular::fem
