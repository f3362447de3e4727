#include "fem/material/isochoric.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

Mat9 on_columns(const Mat3& A) {
  Mat9 result;
  for (int j = 0; j < 3; ++j) {
    for (int l = 0; l < 3; ++l) result.block<3, 3>(3 * j, 3 * l) = A(j, l) * Mat3::Identity();
  }
  return result;
}

Jet composed(const Jet& I, double f, double df, double ddf) {
  const Vec9 g = I.gradient.reshaped();
  return {f, df * I.gradient, df * I.hessian + ddf * g * g.transpose()};
}

Jet product(const Jet& A, const Jet& B) {
  const Vec9 a = A.gradient.reshaped(), b = B.gradient.reshaped();
  return {A.value * B.value, A.value * B.gradient + B.value * A.gradient,
          A.value * B.hessian + B.value * A.hessian + a * b.transpose() + b * a.transpose()};
}

Jet times_power_of_volume(const Jet& I, double p, const Mat3& F) {
  const double J = F.determinant(), scale = std::pow(J, p);
  const Vec9 c = cofactor(F).reshaped(), g = I.gradient.reshaped();
  const double first = p / J, second = p * (p - 1) / (J * J);  // derivatives of J^p, per J^p
  Jet result;
  result.value = scale * I.value;
  result.gradient = scale * (I.gradient + first * I.value * cofactor(F));
  result.hessian =
      scale * (I.hessian + first * (c * g.transpose() + g * c.transpose()) +
               I.value * (second * c * c.transpose() + first * cofactor_derivative(F)));
  return result;
}

Jet first_invariant(const Mat3& F) { return {F.squaredNorm(), 2 * F, 2 * Mat9::Identity()}; }

Jet second_invariant(const Mat3& F) {
  const Mat3 C = cofactor(F);
  const Mat9 H = cofactor_derivative(F);
  const Vec9 gradient = 2 * H * C.reshaped();
  return {C.squaredNorm(), gradient.reshaped(3, 3), 2 * H * H + 2 * cofactor_derivative(C)};
}

Jet first_isochoric_invariant(const Mat3& F) {
  return times_power_of_volume(first_invariant(F), -2.0 / 3, F);
}

Jet second_isochoric_invariant(const Mat3& F) {
  return times_power_of_volume(second_invariant(F), -4.0 / 3, F);
}

}  // namespace articular::fem
