#include "fem/material/mooney_rivlin.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"
#include "fem/material/invariants.hpp"

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

void IsochoricMooneyRivlin::add_slopes(const Invariants& I, InvariantSlopes& energy) const {
  energy.add(first_isochoric_invariant(I).slopes, c10_, 0);
  if (c01_ != 0) energy.add(second_isochoric_invariant(I).slopes, c01_, 0);
}

Mat9 IsochoricMooneyRivlin::tangent(const Mat3& F) const {
  const Invariants I(F);
  InvariantSlopes energy;
  add_slopes(I, energy);
  return fem::tangent(I, energy);
}

}  // namespace articular::fem
