#pragma once

#include <Eigen/Core>

#include "fem/material/split_material.hpp"

namespace articular::fem {

/// Hooke's law on the small strain tensor:
///
///   ε = (F + Fᵀ)/2 − I,   Ψ = μ ε:ε + λ/2 (tr ε)²,   P = σ = 2μ ε + λ tr(ε) I
///
/// For small rotations only: a finite rotation strains it.
class Linear {
 public:
  using Dilatation = SmallDilatation;

  /// @param E   Young's modulus [Pa], > 0
  /// @param nu  Poisson's ratio [-], in (-1, 0.5)
  /// @throws std::invalid_argument outside those ranges
  Linear(double E, double nu) : lame_(lame_parameters(E, nu)) {}

  double shear_modulus() const { return lame_.mu; }                 // [Pa]
  double bulk_modulus() const { return fem::bulk_modulus(lame_); }  // [Pa]
  /// Ψ_d = μ dev ε : dev ε
  Linear distortion() const { return Linear(without_bulk_modulus(lame_.mu)); }

  double energy_density(const Mat3& F) const {
    const Mat3 strain = small_strain(F);
    const double trace = strain.trace();
    return lame_.mu * strain.squaredNorm() + 0.5 * lame_.lambda * trace * trace;
  }

  Mat3 first_piola(const Mat3& F) const {
    const Mat3 strain = small_strain(F);
    return 2 * lame_.mu * strain + lame_.lambda * strain.trace() * Mat3::Identity();
  }

  Mat9 tangent(const Mat3&) const {
    Mat9 C = Mat9::Zero();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        C(3 * j + i, 3 * j + i) += lame_.mu;  // ∂F_ij/∂F_ij
        C(3 * j + i, 3 * i + j) += lame_.mu;  // ∂F_ji/∂F_ij
        C(4 * i, 4 * j) += lame_.lambda;      // tr(F) I
      }
    }
    return C;
  }

  /// In the small-strain theory all stresses are one: P Fᵀ/J would not even be symmetric.
  Mat3 cauchy_stress(const Mat3& F) const { return first_piola(F); }

 private:
  explicit Linear(const Lame& lame) : lame_(lame) {}

  static Mat3 small_strain(const Mat3& F) { return 0.5 * (F + F.transpose()) - Mat3::Identity(); }

  Lame lame_;
};
static_assert(Split<Linear>);

}  // namespace articular::fem
