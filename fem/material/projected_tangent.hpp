#pragma once

#include <Eigen/LU>

#include "fem/base/tangent.hpp"
#include "fem/material/material.hpp"

/// What every assembly does with a material's stress and tangent at one F.
namespace articular::fem {

/// The nearest positive semidefinite matrix (in the Frobenius norm): eigenvalues below 0 become 0.
Mat9 projected(const Mat9& tangent);

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
