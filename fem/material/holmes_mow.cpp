#include "fem/material/holmes_mow.hpp"

#include <Eigen/LU>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/base/cofactor.hpp"
#include "fem/material/bounded_exponential.hpp"
#include "fem/material/invariants.hpp"

namespace articular::fem {

HolmesMow::HolmesMow(double E, double nu, double beta)
    : lame_(lame_parameters(E, nu)),
      beta_(checked_positive(beta, "beta", "(no unit)")),
      half_c_((lame_.lambda + 2 * lame_.mu) / (4 * beta)),
      of_I1_(beta * (2 * lame_.mu - lame_.lambda) / (lame_.lambda + 2 * lame_.mu)),
      of_I2_(beta * lame_.lambda / (lame_.lambda + 2 * lame_.mu)) {
  constexpr double kLargest = 1.0 / 3, kRounding = 1e-6;  // as 0.333333 is written for it
  if (nu >= 0 && nu <= kLargest + kRounding) return;
  std::ostringstream message;
  message << "Poisson's ratio is " << nu
          << ", must lie between 0 and 1/3 for a Holmes-Mow solid: others soften in tension";
  throw std::invalid_argument(message.str());
}

double HolmesMow::exponent(const Mat3& F) const {
  return of_I1_ * (F.squaredNorm() - 3) + of_I2_ * (cofactor(F).squaredNorm() - 3) -
         2 * beta_ * std::log(F.determinant());
}

// ∂I2/∂F = 2 (I1 F − F FᵀF)
Mat3 HolmesMow::exponent_gradient(const Mat3& F) const {
  return 2 * (of_I1_ + of_I2_ * F.squaredNorm()) * F - 2 * of_I2_ * F * F.transpose() * F -
         2 * beta_ / F.determinant() * cofactor(F);
}

double HolmesMow::energy_density(const Mat3& F) const {
  const double log_J = std::log(F.determinant());
  return half_c_ * bounded_exponential::minus_one(exponent(F)) - 0.5 * without_ * log_J * log_J;
}

Mat3 HolmesMow::first_piola(const Mat3& F) const {
  return half_c_ * bounded_exponential::slope(exponent(F)) * exponent_gradient(F) -
         without_ * LogVolumeChange::value(F) * LogVolumeChange::gradient(F);
}

Mat9 HolmesMow::tangent(const Mat3& F) const {
  const Invariants I(F);
  const double J = I[kJ], log_J = std::log(J);
  InvariantSlopes Q, energy;
  Q.first[kI1] = of_I1_;
  Q.first[kI2] = of_I2_;
  Q.first[kJ] = -2 * beta_ / J;
  Q.second(kJ, kJ) = 2 * beta_ / (J * J);
  const double at = exponent(F);
  energy.add(Q, half_c_ * bounded_exponential::slope(at),
             half_c_ * bounded_exponential::curvature(at));
  energy.first[kJ] -= without_ * log_J / J;
  energy.second(kJ, kJ) -= without_ * (1 - log_J) / (J * J);
  return fem::tangent(I, energy);
}

}  // namespace articular::fem
