#include "fem/material/viscosity.hpp"

#include "fem/base/on_columns.hpp"

namespace articular::fem {

double KelvinVoigt::dissipation(const Mat3& F, const Mat3& rate) const {
  return first_piola(F, rate).cwiseProduct(rate).sum();
}

Mat3 KelvinVoigt::first_piola(const Mat3& F, const Mat3& rate) const {
  return F * second_piola(F, rate);
}

Mat9 KelvinVoigt::rate_tangent(const Mat3& F) const { return chained(F, F); }

Mat9 KelvinVoigt::tangent(const Mat3& F, const Mat3& rate) const {
  return chained(F, rate) + on_columns(second_piola(F, rate));
}

Mat3 KelvinVoigt::second_piola(const Mat3& F, const Mat3& rate) const {
  const Mat3 A = F.transpose() * rate;
  return eta_ * (A + A.transpose()) + lambda_ * A.trace() * Mat3::Identity();
}

Mat9 KelvinVoigt::chained(const Mat3& F, const Mat3& B) const {
  const Mat3 FB = eta_ * F * B.transpose();
  Mat9 result = lambda_ * F.reshaped() * B.reshaped().transpose();
  for (int j = 0; j < 3; ++j) {
    result.block<3, 3>(3 * j, 3 * j) += FB;
    for (int k = 0; k < 3; ++k)
      result.block<3, 3>(3 * j, 3 * k) += eta_ * F.col(k) * B.col(j).transpose();
  }
  return result;
}

KelvinVoigt stiffness_damping(double beta, double shear_modulus, double bulk_modulus) {
  checked_not_negative(beta, "stiffness damping", "s");
  return {beta * shear_modulus, beta * bulk_modulus};
}

void add_mass_damping(double alpha, const Eigen::VectorXd& lumped_mass, const Positions& v,
                      Positions& f) {
  f += alpha * v * lumped_mass.asDiagonal();
}

}  // namespace articular::fem
