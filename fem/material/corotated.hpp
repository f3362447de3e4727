#pragma once

#include "fem/material/batch_law.hpp"
#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Corotated linear elasticity [Kim 2022, ch. 3 and 5]: Hooke's law behind the polar rotation R,
/// the rotation nearest to F (det R = +1 where F is inverted, too):
///
///   Ψ(F) = μ |F − R|² + λ/2 tr²(RᵀF − I)
///   P(F) = 2μ (F − R) + λ tr(RᵀF − I) R                 (∂Ψ/∂R vanishes along rotations)
///   ∂P/∂F = 2μ 1 + λ R⊗R + (λ tr(RᵀF − I) − 2μ) ∂R/∂F
///   ∂R/∂F = Σ_k 2/(σi + σj) T_k⊗T_k,   T_k = U [e_k]× Vᵀ/√2,   F = U diag(σ) Vᵀ
///
/// [Kim 2022] Kim, Eberle. Dynamic Deformables: Implementation and Production Practicalities.
///            SIGGRAPH 2022 Courses.
class Corotated {
 public:
  using Dilatation = StretchDilatation;

  /// @param E   Young's modulus [Pa], > 0
  /// @param nu  Poisson's ratio [-], in (-1, 0.5)
  /// @throws std::invalid_argument outside those ranges
  Corotated(double E, double nu) : lame_(lame_parameters(E, nu)) {}

  double shear_modulus() const { return lame_.mu; }                 // [Pa]
  double bulk_modulus() const { return fem::bulk_modulus(lame_); }  // [Pa]
  /// Ψ_d = μ |dev S|² with F = R S
  Corotated distortion() const { return Corotated(without_bulk_modulus(lame_.mu)); }

  double energy_density(const Mat3& F) const;
  Mat3 first_piola(const Mat3& F) const;
  Mat9 tangent(const Mat3& F) const;

  /// The nearest positive semidefinite matrix to the tangent: only the twists T_k can be negative.
  Mat9 projected_tangent(const Mat3& F) const;

  BatchLaw batch_law() const { return {BatchLaw::Kind::Corotated, lame_.mu, lame_.lambda}; }
  /// Of a distortion().
  SplitBatchLaw split_batch_law() const {
    return {.distortion = SplitBatchLaw::Distortion::Corotated, .c = {lame_.mu, lame_.lambda, 0}};
  }

 private:
  explicit Corotated(const Lame& lame) : lame_(lame) {}

  /// The tangent, with `twist_stiffness` applied to its eigenvalues of the twists T_k.
  template <class Function>
  Mat9 tangent(const Mat3& F, Function twist_stiffness) const;

  Lame lame_;
};
static_assert(Split<Corotated> && Batched<Corotated>);

}  // namespace articular::fem
