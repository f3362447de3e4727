#pragma once

#include <concepts>

#include "fem/base/types.hpp"

/// Measures Θ(F) of the change of volume, for a volumetric energy κ/2 Θ². All are 0 without strain
/// and tr ε + O(ε²) for small strain.
namespace articular::fem {

template <class D>
concept DilatationMeasure = requires(const Mat3& F) {
  { D::value(F) } -> std::same_as<double>;
  { D::gradient(F) } -> std::same_as<Mat3>;  // ∂Θ/∂F
  { D::hessian(F) } -> std::same_as<Mat9>;   // ∂²Θ/∂vec(F)²
};

/// Θ = J − 1: defined for every F.
struct VolumeChange {
  static double value(const Mat3& F);
  static Mat3 gradient(const Mat3& F);
  static Mat9 hessian(const Mat3& F);
};
static_assert(DilatationMeasure<VolumeChange>);

/// Θ = ln J: not a number for an inverted F.
struct LogVolumeChange {
  static double value(const Mat3& F);
  static Mat3 gradient(const Mat3& F);
  static Mat9 hessian(const Mat3& F);
};
static_assert(DilatationMeasure<LogVolumeChange>);

/// Θ = tr S − 3 of the polar decomposition F = R S, with R the rotation nearest to F: the sum of
/// the principal strains of corotated elasticity. Defined for every F.
struct StretchDilatation {
  static double value(const Mat3& F);
  static Mat3 gradient(const Mat3& F);
  static Mat9 hessian(const Mat3& F);
};
static_assert(DilatationMeasure<StretchDilatation>);

/// Θ = tr E of the Green–Lagrange strain E = (FᵀF − I)/2. Defined for every F.
struct GreenDilatation {
  static double value(const Mat3& F);
  static Mat3 gradient(const Mat3& F);
  static Mat9 hessian(const Mat3&);
};
static_assert(DilatationMeasure<GreenDilatation>);

/// Θ = tr ε = tr F − 3, of the theory of small strain.
struct SmallDilatation {
  static double value(const Mat3& F);
  static Mat3 gradient(const Mat3&);
  static Mat9 hessian(const Mat3&);
};
static_assert(DilatationMeasure<SmallDilatation>);

}  // namespace articular::fem
