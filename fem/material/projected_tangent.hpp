#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "fem/base/tangent.hpp"
#include "fem/material/material.hpp"

/// What every assembly does with a material's stress and tangent at one F.
namespace articular::fem {

/// The nearest positive semidefinite matrix (in the Frobenius norm): eigenvalues below 0 become 0.
inline Mat9 projected(const Mat9& tangent) {
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

template <Hyperelastic M>
Mat9 projected_tangent(const M& material, const Mat3& F) {
  if constexpr (requires { material.projected_tangent(F); }) {
    return material.projected_tangent(F);
  } else {
    return projected(material.tangent(F));
  }
}

/// Cauchy stress σ = P Fᵀ/J [Pa]; not finite where J = 0.
template <Hyperelastic M>
Mat3 cauchy(const M& material, const Mat3& F) {
  if constexpr (requires { material.cauchy_stress(F); }) {
    return material.cauchy_stress(F);
  } else {
    return material.first_piola(F) * F.transpose() / F.determinant();
  }
}

}  // namespace articular::fem
