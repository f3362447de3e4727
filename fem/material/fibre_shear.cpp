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

// y = cosh B2 = (I1 I4 − I5) s with s = 1/(2 J √I4).
void FibreShear::add_slopes(const Invariants& I, InvariantSlopes& energy) const {
  const double I1 = I[kI1], I4 = I[kI4], I5 = I[kI5], J = I[kJ];
  InvariantSlopes along;
  along.first[kI4] = -2 * I5 / (I4 * I4 * I4);
  along.first[kI5] = 1 / (I4 * I4);
  along.second(kI4, kI4) = 6 * I5 / (I4 * I4 * I4 * I4);
  along.second(kI4, kI5) = along.second(kI5, kI4) = -2 / (I4 * I4 * I4);
  energy.add(along, G1_, 0);

  const double s = 0.5 / (J * std::sqrt(I4)), y = (I1 * I4 - I5) * s;
  InvariantSlopes across;
  auto& [first, second] = across;
  first[kI1] = I4 * s;
  first[kI4] = I1 * s - y / (2 * I4);
  first[kI5] = -s;
  first[kJ] = -y / J;
  second(kI1, kI4) = s / 2;
  second(kI4, kI4) = (0.75 * y / I4 - I1 * s) / I4;
  second(kI4, kI5) = s / (2 * I4);
  second(kJ, kJ) = 2 * y / (J * J);
  for (const int i : {kI1, kI4, kI5}) second(i, kJ) = -first[i] / J;
  second.triangularView<Eigen::StrictlyLower>() = second.transpose();
  const std::array<double, 3> B2_squared = squared_acosh(y);
  energy.add(across, G2_ * B2_squared[1], G2_ * B2_squared[2]);

  if (c10_ != 0) energy.add(first_isochoric_invariant(I).slopes, c10_, 0);
}

Mat9 FibreShear::tangent(const Mat3& F) const {
  const Invariants I(F, a0_);
  InvariantSlopes energy;
  add_slopes(I, energy);
  return fem::tangent(I, energy);
}

}  // namespace articular::fem
