#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fem/base/types.hpp"

namespace articular::fem {

/// ∂det(F)/∂F: its columns are f1×f2, f2×f0, f0×f1 for the columns f0 f1 f2 of F. Defined for every
/// F; equals det(F) F⁻ᵀ where F is invertible.
inline Mat3 cofactor(const Mat3& F) {
  Mat3 C;
  C.col(0) = F.col(1).cross(F.col(2));
  C.col(1) = F.col(2).cross(F.col(0));
  C.col(2) = F.col(0).cross(F.col(1));
  return C;
}

/// The matrix of v ↦ a × v.
inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 A;
  A << 0, -a.z(), a.y(),  //
      a.z(), 0, -a.x(),   //
      -a.y(), a.x(), 0;
  return A;
}

/// ∂vec(cofactor(F))/∂vec(F) = ∂²det(F)/∂vec(F)², symmetric. With [a] the matrix of v ↦ a × v:
///
///        f0    f1    f2
///      [  0  −[f2]  [f1] ]  f1×f2
///      [ [f2]   0  −[f0] ]  f2×f0
///      [−[f1] [f0]   0   ]  f0×f1
inline Mat9 cofactor_derivative(const Mat3& F) {
  const Mat3 A0 = cross_matrix(F.col(0)), A1 = cross_matrix(F.col(1)), A2 = cross_matrix(F.col(2));
  Mat9 H = Mat9::Zero();
  H.block<3, 3>(0, 3) = -A2;
  H.block<3, 3>(0, 6) = A1;
  H.block<3, 3>(3, 0) = A2;
  H.block<3, 3>(3, 6) = -A0;
  H.block<3, 3>(6, 0) = -A1;
  H.block<3, 3>(6, 3) = A0;
  return H;
}

}  // namespace articular::fem
