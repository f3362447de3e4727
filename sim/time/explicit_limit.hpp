#pragma once

#include <complex>
#include <span>
#include <vector>

#include "sim/assembly/dynamics.hpp"

/// How long the steps of the explicit scheme can be.
namespace articular::sim {

using MotionRates = std::vector<std::complex<double>>;  // λ [1/s]: motion goes as exp(λt)

/// The eigenvalues λ of ∂rate/∂y that bound explicit steps, fastest first: ±iω of what swings
/// undamped, −1/τ of what creeps. Found by Arnoldi's iteration with products by differences of the
/// rate that the scheme itself sees: elasticity, contact with the candidates that are set, lines,
/// dampers. What internal variables (activations, relaxing stress) enters by its time constants
/// alone.
/// @param y  the state to linearise at; `dynamics` is left there. At a kink (surfaces that just
///           touch, a ligament that is just taut) it gets the mean of both sides
/// @param accuracy  relative, of the step that follows from them. They come from below
MotionRates fastest_rates(const Model& model, Dynamics& dynamics, const Eigen::VectorXd& y,
                          double t, double accuracy = 1e-3);

/// What a step of an explicit Runge–Kutta scheme multiplies exp(λt) by: R(z) = Σ c_k zᵏ of z = hλ,
/// c_k = bᵀ Aᵏ⁻¹ 1 [Hairer 1996, IV.2]. These are its c_k, from the scheme's own Butcher table.
///
/// [Hairer 1996] Hairer, Wanner. Solving Ordinary Differential Equations II. Springer.
std::vector<double> explicit_growth();

/// The longest step [s] up to which |R(hλ)| ≤ 1 for all λ; infinity where nothing moves. What grows
/// by itself (Re λ > 0) is left out of this: no step makes it calm.
double longest_explicit_step(std::span<const std::complex<double>> rates);

}  // namespace articular::sim
