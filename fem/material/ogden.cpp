#include "fem/material/ogden.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/base/rotation_svd.hpp"

namespace articular::fem {
namespace {

/// Below this the constant part of λ̃^m leaves too few digits: those of the energy are 1e-16/m.
constexpr double kLeastExponent = 0.01;  // [-]

/// ln λ̃: the sum is 0. Not numbers for J ≤ 0.
Vec3 log_stretches(const Vec3& stretch) {
  const Vec3 e = stretch.array().log();
  return e.array() - e.sum() / 3;
}

/// (exp(m d) − 1)/(exp(d) − 1)
double ratio(double m, double d) { return d == 0 ? m : std::expm1(m * d) / std::expm1(d); }

/// The change of F that draws its stretches i and j into each other (i, j, k cyclic), stacked: as
/// twist(), but with both parts of one sign.
Vec9 flip(const RotationSvd& svd, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Mat3 L = svd.U.col(j) * svd.V.col(i).transpose() + svd.U.col(i) * svd.V.col(j).transpose();
  return L.reshaped() / std::sqrt(2.0);
}

}  // namespace

IsochoricOgden::IsochoricOgden(std::vector<OgdenTerm> terms) : terms_(std::move(terms)) {
  if (terms_.empty()) throw std::invalid_argument("there is no term, must be one at least");
  for (const OgdenTerm& term : terms_) {
    checked_positive(term.c, "c", "Pa");
    if (std::abs(term.m) >= kLeastExponent && std::isfinite(term.m)) continue;
    std::ostringstream message;
    message << "m is " << term.m << ", must be finite and " << kLeastExponent
            << " or more away from 0";
    throw std::invalid_argument(message.str());
  }
}

double IsochoricOgden::shear_modulus() const {
  double sum = 0;
  for (const OgdenTerm& term : terms_) sum += term.c;
  return sum / 2;
}

double IsochoricOgden::energy_density(const Mat3& F) const {
  const Vec3 e = log_stretches(rotation_svd(F).sigma);
  double energy = 0;
  for (const auto& [c, m] : terms_)
    energy += c / (m * m) * (std::expm1(m * e[0]) + std::expm1(m * e[1]) + std::expm1(m * e[2]));
  return energy;
}

Vec3 IsochoricOgden::principal_stress(const Vec3& e) const {
  Vec3 tau = Vec3::Zero();
  for (const auto& [c, m] : terms_) {
    const Vec3 g(std::expm1(m * e[0]), std::expm1(m * e[1]), std::expm1(m * e[2]));
    tau.array() += c / m * (g.array() - g.sum() / 3);
  }
  return tau;
}

Mat3 IsochoricOgden::first_piola(const Mat3& F) const {
  const RotationSvd svd = rotation_svd(F);
  const Vec3 tau = principal_stress(log_stretches(svd.sigma));
  return svd.U * tau.cwiseQuotient(svd.sigma).asDiagonal() * svd.V.transpose();
}

Mat9 IsochoricOgden::tangent(const Mat3& F) const {
  const RotationSvd svd = rotation_svd(F);
  const Vec3 &sigma = svd.sigma, e = log_stretches(sigma), tau = principal_stress(e);
  Vec3 w = Vec3::Zero();  // ∂τ_i/∂e_i before the mean is taken off
  for (const auto& [c, m] : terms_) w.array() += c * (m * e.array()).exp();

  Eigen::Matrix<double, 9, 3> axes;
  for (int i = 0; i < 3; ++i)
    axes.col(i) = (svd.U.col(i) * svd.V.col(i).transpose()).eval().reshaped() / sigma[i];
  Mat3 of_stretches;  // times λi λj
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      of_stretches(i, j) = (i == j ? w[i] - tau[i] : 0) - (w[i] + w[j]) / 3 + w.sum() / 9;
  Mat9 result = axes * of_stretches * axes.transpose();

  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    double slope = 0;  // (τi − τj)/(λi − λj) λj
    for (const auto& [c, m] : terms_) slope += c / m * std::exp(m * e[j]) * ratio(m, e[i] - e[j]);
    const double of_flip = (slope - tau[j]) / (sigma[i] * sigma[j]);
    const double of_twist = (tau[i] / sigma[i] + tau[j] / sigma[j]) / (sigma[i] + sigma[j]);
    const Vec9 L = flip(svd, k), T = twist(svd, k);
    result += of_flip * L * L.transpose() + of_twist * T * T.transpose();
  }
  return result;
}

}  // namespace articular::fem
