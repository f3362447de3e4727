#include "fem/material/projected_tangent.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace articular::fem {

Mat9 projected(const Mat9& tangent) {
  const double round_off = kRoundOffOfProjection * tangent.norm();
  const Eigen::LLT<Mat9> shifted(tangent + round_off * Mat9::Identity());
  if (shifted.info() == Eigen::Success) return tangent;
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(tangent);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace articular::fem
