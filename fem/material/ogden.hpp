#pragma once

#include <utility>
#include <vector>

#include "fem/material/split_material.hpp"

namespace articular::fem {

/// A term c/m² (λ̃1^m + λ̃2^m + λ̃3^m − 3).
struct OgdenTerm {
  double c;  // [Pa], > 0
  double m;  // [-], not 0; a negative one stiffens in compression
};

/// Ψ_d = Σ c_i/m_i² (λ̃1^m_i + λ̃2^m_i + λ̃3^m_i − 3) of the principal stretches λ̃ = J^(−1/3) λ
/// [Ogden 1972], with the constants of other programs' uncoupled law. Ogden's own μ_i/α_i has
/// c = μ α and m = α. Shear modulus at small strain: ½ Σ c_i. As every c is positive, the energy is
/// nowhere negative and the stress rises with each ln λ̃.
///
/// In the axes of F = U diag(λ) Vᵀ, with τ_i = ∂Ψ/∂ln λ_i, the tangent falls apart into a 3x3
/// matrix of the stretches, and a twist and a flip in each plane [Smith 2019]:
///
///   ∂²Ψ/∂λi∂λj,   (τi/λi + τj/λj)/(λi + λj),   (τi/λi − τj/λj)/(λi − λj)
///
/// The last is 0/0 where stretches coincide. There τi − τj = Σ c/m λ̃j^m (exp(m d) − 1) with
/// d = ln(λi/λj), and (exp(m d) − 1)/(exp(d) − 1) is m at d = 0. Not a number for J ≤ 0.
///
/// [Ogden 1972] Ogden. Large deformation isotropic elasticity. Proc. R. Soc. Lond. A 326.
/// [Smith 2019] Smith, De Goes, Kim. Analytic Eigensystems for Isotropic Distortion Energies.
///              ACM TOG 38(1).
class IsochoricOgden {
 public:
  /// @throws std::invalid_argument naming a constant that is out of range, or without a term
  explicit IsochoricOgden(std::vector<OgdenTerm> terms);

  double shear_modulus() const;  // [Pa]

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

 private:
  /// τ of the three axes [Pa]. @param e  ln λ̃
  Vec3 principal_stress(const Vec3& e) const;

  std::vector<OgdenTerm> terms_;
};

/// With κ/2 (J − 1)² or κ/2 (ln J)².
template <DilatationMeasure Theta = VolumeChange>
class Ogden : public SplitMaterial<IsochoricOgden, Theta> {
 public:
  /// @param kappa  [Pa]
  /// @throws std::invalid_argument where a constant is out of range
  Ogden(std::vector<OgdenTerm> terms, double kappa)
      : SplitMaterial<IsochoricOgden, Theta>(IsochoricOgden(std::move(terms)), kappa) {}
};
static_assert(Split<Ogden<>>);

}  // namespace articular::fem
