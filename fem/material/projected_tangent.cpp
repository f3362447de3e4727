#include "fem/material/projected_tangent.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace articular::fem {

Mat9 projected(const Mat9& tangent) {
  // One whose lowest eigenvalue lies above minus this part of its norm is positive semidefinite up
  // to round-off: rigid rotations put zeros there.
  constexpr double kRoundOff = 1e-13;  // [-]
  const double round_off = kRoundOff * tangent.norm();
  const Eigen::LLT<Mat9> shifted(tangent + round_off * Mat9::Identity());
  if (shifted.info() == Eigen::Success) return tangent;
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(tangent);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace articular::fem
