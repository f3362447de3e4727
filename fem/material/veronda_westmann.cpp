#include "fem/material/veronda_westmann.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"
#include "fem/material/bounded_exponential.hpp"
#include "fem/material/invariants.hpp"

namespace articular::fem {

double IsochoricVerondaWestmann::energy_density(const Mat3& F) const {
  const double a = std::pow(F.determinant(), -2.0 / 3);
  const double x = c2_ * (a * F.squaredNorm() - 3);
  const double I2 = a * a * cofactor(F).squaredNorm();
  return c1_ * (bounded_exponential::minus_one(x) - 0.5 * c2_ * (I2 - 3));
}

Mat3 IsochoricVerondaWestmann::first_piola(const Mat3& F) const {
  const double J = F.determinant(), a = std::pow(J, -2.0 / 3), I1 = F.squaredNorm();
  const Mat3 C = cofactor(F);
  const Vec9 dI2 = cofactor_derivative(F) * C.reshaped();
  const double slope = bounded_exponential::slope(c2_ * (a * I1 - 3));
  return c1_ * c2_ *
         (2 * a * slope * (F - I1 / (3 * J) * C) -
          a * a * (dI2.reshaped(3, 3) - 2 * C.squaredNorm() / (3 * J) * C));
}

Mat9 IsochoricVerondaWestmann::tangent(const Mat3& F) const {
  const Invariants I(F);
  const IsochoricInvariant I1 = first_isochoric_invariant(I);
  const double x = c2_ * (I1.value - 3), c = c1_ * c2_;
  InvariantSlopes energy;
  energy.add(I1.slopes, c * bounded_exponential::slope(x),
             c * c2_ * bounded_exponential::curvature(x));
  energy.add(second_isochoric_invariant(I).slopes, -0.5 * c, 0);
  return fem::tangent(I, energy);
}

}  // namespace articular::fem
