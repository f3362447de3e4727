#include "fem/material/neo_hookean.hpp"

#include <Eigen/LU>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

double NeoHookean::energy_density(const Mat3& F) const {
  const double dJ = F.determinant() - alpha_, dJ_rest = 1 - alpha_;
  return 0.5 * mu_ * (F.squaredNorm() - 3) + 0.5 * lambda_ * (dJ * dJ - dJ_rest * dJ_rest);
}

Mat3 NeoHookean::first_piola(const Mat3& F) const {
  return mu_ * F + lambda_ * (F.determinant() - alpha_) * cofactor(F);
}

Mat9 NeoHookean::tangent(const Mat3& F) const {
  const Vec9 c = cofactor(F).reshaped();
  return mu_ * Mat9::Identity() + lambda_ * c * c.transpose() +
         lambda_ * (F.determinant() - alpha_) * cofactor_derivative(F);
}

}  // namespace articular::fem
