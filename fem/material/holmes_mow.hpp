#pragma once

#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Cartilage at equilibrium [Holmes 1990], stiffer the more it is pressed or drawn:
///
///   Ψ = c/2 (exp(Q) − 1),   c = (λ + 2μ)/(2β)
///   Q = β/(λ + 2μ) ((2μ − λ)(I1 − 3) + λ (I2 − 3)) − 2β ln J
///
/// Hooke's law of λ and μ at small strain. Confined compression to the stretch s takes the stress
/// (λ + 2μ)/2 (s − 1/s) s^(−2β) exp(β (s² − 1)). Q is nowhere negative while its two factors are
/// not: 0 ≤ ν ≤ 1/3. Beyond, the law would soften in tension, so that other ν are refused. Where Q
/// passes 100 the exponential goes on as its quadratic (bounded_exponential.hpp). Defined for J >
/// 0.
///
/// [Holmes 1990] Holmes, Mow. The nonlinear characteristics of soft gels and hydrated connective
///               tissues in ultrafiltration. J. Biomech. 23.
class HolmesMow {
 public:
  using Dilatation = LogVolumeChange;

  /// @param E     Young's modulus [Pa], > 0
  /// @param nu    Poisson's ratio [-], in [0, 1/3]
  /// @param beta  [-], > 0
  /// @throws std::invalid_argument outside those ranges
  HolmesMow(double E, double nu, double beta);

  double shear_modulus() const { return lame_.mu; }                 // [Pa]
  double bulk_modulus() const { return fem::bulk_modulus(lame_); }  // [Pa]
  /// Ψ_d = Ψ − κ/2 (ln J)²
  HolmesMow distortion() const {
    HolmesMow result = *this;
    result.without_ = bulk_modulus();
    return result;
  }

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

 private:
  double exponent(const Mat3& F) const;         // Q
  Mat3 exponent_gradient(const Mat3& F) const;  // ∂Q/∂F

  Lame lame_;
  double beta_;        // [-]
  double half_c_;      // [Pa]
  double of_I1_;       // β (2μ − λ)/(λ + 2μ), factor in Q
  double of_I2_;       // β λ/(λ + 2μ)
  double without_{0};  // the κ of a κ/2 (ln J)² that is left out [Pa]
};
static_assert(Split<HolmesMow>);

}  // namespace articular::fem
