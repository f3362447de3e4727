#include "fem/material/invariants.hpp"

#include <cmath>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

Invariants::Invariants(const Mat3& deformation, const Vec3& fibre)
    : F(deformation),
      cofactor(fem::cofactor(F)),
      a0(fibre),
      b(F * a0),
      w(F.transpose() * b),
      value(F.squaredNorm(), cofactor.squaredNorm(), b.squaredNorm(), w.squaredNorm(),
            F.col(0).dot(cofactor.col(0))) {}

void InvariantSlopes::add(const InvariantSlopes& q, double slope, double curvature) {
  first += slope * q.first;
  second += slope * q.second + curvature * q.first * q.first.transpose();
}

IsochoricInvariant::IsochoricInvariant(const Invariants& I, int i, double r, double p)
    : value(std::pow(I[i], r) * std::pow(I[kJ], p)) {
  const double by_i = r / I[i], by_J = p / I[kJ];
  slopes.first[i] = value * by_i;
  slopes.first[kJ] = value * by_J;
  slopes.second(i, i) = value * by_i * (r - 1) / I[i];
  slopes.second(i, kJ) = slopes.second(kJ, i) = value * by_i * by_J;
  slopes.second(kJ, kJ) = value * by_J * (p - 1) / I[kJ];
}

IsochoricInvariant first_isochoric_invariant(const Invariants& I) { return {I, kI1, 1, -2.0 / 3}; }

IsochoricInvariant second_isochoric_invariant(const Invariants& I) { return {I, kI2, 1, -4.0 / 3}; }

IsochoricInvariant isochoric_stretch(const Invariants& I) { return {I, kI4, 0.5, -1.0 / 3}; }

// With f_j the columns of F, S = FᵀF and B = FFᵀ, the blocks (j, l) of the second derivatives are
//
//   I1   2 δ_jl 1                          I2   4 f_j f_lᵀ − 2 f_l f_jᵀ − 2 S_jl 1 + 2 δ_jl (I1 1 −
//   B) I4   2 a_j a_l 1                       I5   2 (δ_jl b bᵀ + a_l b f_jᵀ + a_j f_l bᵀ + a_j a_l
//   B + (w_j a_l + a_j w_l) 1)
//
// of which 4 f_j f_lᵀ is ∇I1 ∇I1ᵀ. Lazy products: Eigen's general one takes memory for them.
Mat9 tangent(const Invariants& I, const InvariantSlopes& energy) {
  const auto& [F, cof, a0, b, w, value] = I;
  const auto& first = energy.first;
  const Mat3 S = F.transpose().lazyProduct(F), B = F.lazyProduct(F.transpose());
  Eigen::Matrix<double, 9, kNumInvariants> gradient;
  gradient.col(kI1) = 2 * F.reshaped();
  gradient.col(kI2) = 2 * (value[kI1] * F - F.lazyProduct(S)).reshaped();
  gradient.col(kI4) = 2 * (b * a0.transpose()).reshaped();
  gradient.col(kI5) = 2 * (b * w.transpose() + F.lazyProduct(w) * a0.transpose()).reshaped();
  gradient.col(kJ) = cof.reshaped();
  Eigen::Matrix<double, kNumInvariants, kNumInvariants> second = energy.second;
  second(kI1, kI1) += first[kI2];
  const Eigen::Matrix<double, 9, kNumInvariants> weighted = gradient.lazyProduct(second);
  Mat9 result = weighted.lazyProduct(gradient.transpose());
  result += first[kJ] * cofactor_derivative(F);

  const Mat3 same = 2 * first[kI5] * b * b.transpose() - 2 * first[kI2] * B;
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l) {
      auto block = result.block<3, 3>(3 * j, 3 * l);
      block +=
          2 * first[kI5] *
          (a0[l] * b * F.col(j).transpose() + a0[j] * F.col(l) * b.transpose() + a0[j] * a0[l] * B);
      block -= 2 * first[kI2] * F.col(l) * F.col(j).transpose();
      block.diagonal().array() += 2 * (first[kI4] * a0[j] * a0[l] - first[kI2] * S(j, l) +
                                       first[kI5] * (w[j] * a0[l] + a0[j] * w[l]));
      if (j != l) continue;
      block += same;
      block.diagonal().array() += 2 * (first[kI1] + first[kI2] * value[kI1]);
    }
  return result;
}

}  // namespace articular::fem
