#pragma once

#include "fem/base/tangent.hpp"
#include "fem/base/types.hpp"

namespace articular::fem {

struct AnyMaterial;  // any_material.hpp

/// The law of a material at one point, where its fibres have a direction and an activation. Refers
/// to the material. In a file of its own, so that the laws are compiled once and not for each loop
/// over elements.
class PointLaw {
 public:
  /// @param fibres      one an element or domain; empty for materials without
  /// @param e           index into them
  /// @param activation  in [0, 1]
  PointLaw(const AnyMaterial& material, const FibreDirections& fibres, Eigen::Index e,
           double activation)
      : material_(material),
        a0_(fibres.cols() > 0 ? Vec3(fibres.col(e)) : Vec3::Zero()),
        activation_(activation) {}

  double energy_density(const Mat3& F) const;          // Ψ [J/m³]
  Mat3 first_piola(const Mat3& F) const;               // [Pa]
  Mat9 tangent(const Mat3& F, Tangent tangent) const;  // [Pa]
  Mat3 cauchy_stress(const Mat3& F) const;             // [Pa]

  /// Of the fibres from their free length, where there are any [-].
  double fibre_stretch(const Mat3& F) const;

  /// Energy, stress and tangent of the distortion, see Split.
  double distortion_energy_density(const Mat3& F) const;
  Mat3 distortion_first_piola(const Mat3& F) const;
  Mat9 distortion_tangent(const Mat3& F, Tangent tangent) const;
  Mat3 distortion_cauchy_stress(const Mat3& F) const;

  /// Θ with its derivatives.
  double dilatation(const Mat3& F) const;
  Mat3 dilatation_gradient(const Mat3& F) const;
  Mat9 dilatation_hessian(const Mat3& F) const;

 private:
  template <class Function>
  auto with_law(Function function) const;
  template <class Function>
  auto with_dilatation(Function function) const;

  const AnyMaterial& material_;
  Vec3 a0_;
  double activation_;
};

/// Moduli at small strain [Pa].
double bulk_modulus(const AnyMaterial& material);
double shear_modulus(const AnyMaterial& material);

}  // namespace articular::fem
