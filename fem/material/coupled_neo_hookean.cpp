#include "fem/material/coupled_neo_hookean.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

double CoupledNeoHookean::energy_density(const Mat3& F) const {
  const double log_J = std::log(F.determinant());
  return 0.5 * lame_.mu * (F.squaredNorm() - 3) + (0.5 * lame_.lambda * log_J - lame_.mu) * log_J;
}

Mat3 CoupledNeoHookean::first_piola(const Mat3& F) const {
  const double J = F.determinant();
  return lame_.mu * F + (lame_.lambda * std::log(J) - lame_.mu) / J * cofactor(F);
}

Mat9 CoupledNeoHookean::tangent(const Mat3& F) const {
  const double J = F.determinant(), slope = (lame_.lambda * std::log(J) - lame_.mu) / J;
  const Vec9 c = cofactor(F).reshaped();
  return lame_.mu * Mat9::Identity() + (lame_.lambda / J - slope) / J * c * c.transpose() +
         slope * cofactor_derivative(F);
}

}  // namespace articular::fem
