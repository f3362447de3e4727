#include "fem/material/fibre_shear.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

std::array<double, 3> squared_acosh(double y) {
  const double z = y - 1;
  if (z < 0.1) {  // the terms fall by more than 20 each: 14 are enough for round-off
    std::array<double, 3> sum{2 * z, 2, 0};
    double coefficient = 2, power = 1;  // of zⁿ; zⁿ⁻²
    for (int n = 2; n <= 14; ++n) {
      coefficient *= -(n - 1.0) * (n - 1.0) / (n * (2.0 * n - 1));
      sum[0] += coefficient * power * z * z;
      sum[1] += coefficient * n * power * z;
      sum[2] += coefficient * n * (n - 1) * power;
      power *= z;
    }
    return sum;
  }
  const double s2 = y * y - 1, s = std::sqrt(s2), a = std::acosh(y);
  return {a * a, 2 * a / s, 2 * (1 - y * a / s) / s2};
}

double FibreShear::energy_density(const Mat3& F) const {
  const Vec3 b = F * a0_;
  const double I1 = F.squaredNorm(), I4 = b.squaredNorm(), I5 = (F.transpose() * b).squaredNorm();
  const double J = F.determinant(), cosh_B2 = (I1 * I4 - I5) / (2 * J * std::sqrt(I4));
  return G1_ * (I5 / (I4 * I4) - 1) + G2_ * squared_acosh(cosh_B2)[0] +
         c10_ * (std::pow(J, -2.0 / 3) * I1 - 3);
}

Mat3 FibreShear::first_piola(const Mat3& F) const {
  const Vec3 b = F * a0_;
  const double I1 = F.squaredNorm(), I4 = b.squaredNorm(), I5 = (F.transpose() * b).squaredNorm();
  const double J = F.determinant(), scale = 0.5 / (J * std::sqrt(I4));
  const double cosh_B2 = (I1 * I4 - I5) * scale;
  const Mat3 dI4 = 2 * b * a0_.transpose(), dI5 = fifth_invariant_gradient(F, a0_);
  const Mat3 dJ_J = cofactor(F) / J;
  const Mat3 along = dI5 / (I4 * I4) - 2 * I5 / (I4 * I4 * I4) * dI4;
  const Mat3 across = scale * (2 * I4 * F + I1 * dI4 - dI5) - cosh_B2 * (dJ_J + dI4 / (2 * I4));
  return G1_ * along + G2_ * squared_acosh(cosh_B2)[1] * across +
         2 * c10_ * std::pow(J, -2.0 / 3) * (F - I1 / 3 * dJ_J);
}

Mat9 FibreShear::tangent(const Mat3& F) const {
  const Jet I1 = first_invariant(F), I4 = fourth_invariant(F, a0_), I5 = fifth_invariant(F, a0_);
  Jet numerator = product(I1, I4);
  numerator.value -= I5.value;
  numerator.gradient -= I5.gradient;
  numerator.hessian -= I5.hessian;
  const Jet cosh_B2 = times_power_of_volume(product(numerator, power(I4, -0.5, 0.5)), -1, F);
  const auto [value, first, second] = squared_acosh(cosh_B2.value);
  return G1_ * product(I5, power(I4, -2, 1)).hessian +
         G2_ * composed(cosh_B2, value, first, second).hessian +
         c10_ * first_isochoric_invariant(F).hessian;
}

Jet FibreShear::power(const Jet& I, double p, double scale) {
  const double value = scale * std::pow(I.value, p);
  return composed(I, value, p * value / I.value, p * (p - 1) * value / (I.value * I.value));
}

}  // namespace articular::fem
