#pragma once

#include <concepts>

#include "fem/types.hpp"

namespace articular::fem {

struct Lame {
  double mu, lambda;  // [Pa]
};

/// Lamé constants from Young's modulus [Pa] > 0 and Poisson's ratio in (-1, 0.5).
/// @throws std::invalid_argument outside those ranges, naming value and range
Lame lame_parameters(double E, double nu);

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
