#pragma once

#include <concepts>

#include "fem/base/types.hpp"

namespace articular::fem {

struct Lame {
  double mu, lambda;  // [Pa]
};

/// Lamé constants from Young's modulus [Pa] > 0 and Poisson's ratio in (-1, 0.5).
/// @throws std::invalid_argument outside those ranges, naming value and range
Lame lame_parameters(double E, double nu);

/// κ = λ + 2μ/3 [Pa]
inline double bulk_modulus(const Lame& lame) { return lame.lambda + 2 * lame.mu / 3; }

/// The constants of the same shear modulus and no bulk modulus: of the part of a law that is left
/// when κ/2 (tr ε)² is taken from it.
inline Lame without_bulk_modulus(double mu) { return {.mu = mu, .lambda = -2 * mu / 3}; }

/// The value. @throws std::invalid_argument naming it, unless it is finite and positive (or zero)
double checked_positive(double value, const char* name, const char* unit);
double checked_not_negative(double value, const char* name, const char* unit);

/// What the assembly asks of a material. vec() stacks columns: vec(A)[3j + i] = A(i, j).
template <class M>
concept Hyperelastic = requires(const M& m, const Mat3& F) {
  { m.energy_density(F) } -> std::same_as<double>;  // Ψ [J/m³]
  { m.first_piola(F) } -> std::same_as<Mat3>;       // P = ∂Ψ/∂F [Pa]
  { m.tangent(F) } -> std::same_as<Mat9>;           // ∂vec(P)/∂vec(F) [Pa]
};

}  // namespace articular::fem
