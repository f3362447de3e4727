#pragma once

#include <Eigen/Core>

#include "fem/base/types.hpp"

/// The linear tetrahedron: four nodes, one constant deformation gradient.
namespace articular::fem {

using Mat34 = Eigen::Matrix<double, 3, 4>;  // one column a node

/// (x1 − x0, x2 − x0, x3 − x0) [m]; its determinant is six times the volume.
inline Mat3 edge_matrix(const Mat34& x) { return x.rightCols<3>().colwise() - x.col(0); }

/// ∂N_a/∂X, one column a node [1/m]. @param inverse_edges  edge_matrix(X)⁻¹
inline Mat34 shape_gradients(const Mat3& inverse_edges) {
  Mat34 dN_dX;
  dN_dX.rightCols<3>() = inverse_edges.transpose();
  dN_dX.col(0) = -dN_dX.rightCols<3>().rowwise().sum();
  return dN_dX;
}

/// F = Σ_a x_a ⊗ ∂N_a/∂X, written with edges so that a translation cancels first.
inline Mat3 deformation_gradient(const Mat34& x, const Mat3& inverse_edges) {
  return edge_matrix(x) * inverse_edges;
}

/// f_a = V P ∂N_a/∂X [N]
inline Mat34 nodal_force(const Mat3& P, const Mat34& dN_dX, double volume) {
  return volume * P * dN_dX;
}

/// K_ab = V Σ_jl ∂N_a/∂X_j C_jl ∂N_b/∂X_l [N/m], where C_jl is the 3x3 block at (3j, 3l) of the
/// tangent ∂vec(P)/∂vec(F), symmetric. Rows and columns 3a + i.
inline Mat12 stiffness(const Mat9& tangent, const Mat34& dN_dX, double volume) {
  Mat12 K;
  for (int b = 1; b < 4; ++b) {
    Eigen::Matrix<double, 9, 3> CB = tangent.middleCols<3>(0) * (volume * dN_dX(0, b)) +
                                     tangent.middleCols<3>(3) * (volume * dN_dX(1, b)) +
                                     tangent.middleCols<3>(6) * (volume * dN_dX(2, b));
    for (int a = b; a < 4; ++a) {
      const Mat3 K_ab = CB.middleRows<3>(0) * dN_dX(0, a) + CB.middleRows<3>(3) * dN_dX(1, a) +
                        CB.middleRows<3>(6) * dN_dX(2, a);
      K.block<3, 3>(3 * a, 3 * b) = K_ab;
      if (a != b) K.block<3, 3>(3 * b, 3 * a) = K_ab.transpose();
    }
  }
  // Translations are free: the blocks of node 0 are minus the sums over the other nodes.
  for (int b = 1; b < 4; ++b) {
    const Mat3 K_0b =
        -(K.block<3, 3>(3, 3 * b) + K.block<3, 3>(6, 3 * b) + K.block<3, 3>(9, 3 * b));
    K.block<3, 3>(0, 3 * b) = K_0b;
    K.block<3, 3>(3 * b, 0) = K_0b.transpose();
  }
  K.block<3, 3>(0, 0) = -(K.block<3, 3>(0, 3) + K.block<3, 3>(0, 6) + K.block<3, 3>(0, 9));
  return K;
}

}  // namespace articular::fem
