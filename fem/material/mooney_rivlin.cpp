#include "fem/material/mooney_rivlin.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"
#include "fem/material/isochoric.hpp"

namespace articular::fem {

double IsochoricMooneyRivlin::energy_density(const Mat3& F) const {
  const double J = F.determinant(), a = std::pow(J, -2.0 / 3);
  double energy = c10_ * (a * F.squaredNorm() - 3);
  if (c01_ != 0) energy += c01_ * (a * a * cofactor(F).squaredNorm() - 3);
  return energy;
}

Mat3 IsochoricMooneyRivlin::first_piola(const Mat3& F) const {
  const double J = F.determinant(), a = std::pow(J, -2.0 / 3), I1 = F.squaredNorm();
  const Mat3 C = cofactor(F);
  Mat3 P = 2 * c10_ * a * (F - I1 / (3 * J) * C);
  if (c01_ != 0) {
    const Vec9 dI2 = cofactor_derivative(F) * C.reshaped();
    P += 2 * c01_ * a * a * (dI2.reshaped(3, 3) - 2 * C.squaredNorm() / (3 * J) * C);
  }
  return P;
}

Mat9 IsochoricMooneyRivlin::tangent(const Mat3& F) const {
  Mat9 result = c10_ * first_isochoric_invariant(F).hessian;
  if (c01_ != 0) result += c01_ * second_isochoric_invariant(F).hessian;
  return result;
}

}  // namespace articular::fem
