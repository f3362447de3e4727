#include "fem/material/yeoh.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"
#include "fem/material/invariants.hpp"

namespace articular::fem {

double IsochoricYeoh::energy_density(const Mat3& F) const {
  const double x = std::pow(F.determinant(), -2.0 / 3) * F.squaredNorm() - 3;
  return (c10_ + c20_ * x) * x;
}

Mat3 IsochoricYeoh::first_piola(const Mat3& F) const {
  const double J = F.determinant(), a = std::pow(J, -2.0 / 3), I1 = F.squaredNorm();
  const double slope = c10_ + 2 * c20_ * (a * I1 - 3);
  return 2 * slope * a * (F - I1 / (3 * J) * cofactor(F));
}

Mat9 IsochoricYeoh::tangent(const Mat3& F) const {
  const Invariants I(F);
  const IsochoricInvariant I1 = first_isochoric_invariant(I);
  InvariantSlopes energy;
  energy.add(I1.slopes, c10_ + 2 * c20_ * (I1.value - 3), 2 * c20_);
  return fem::tangent(I, energy);
}

}  // namespace articular::fem
