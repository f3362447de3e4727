#pragma once

#include "sim/time/time_integrator.hpp"

namespace articular::sim {

/// Diagonally implicit Runge–Kutta schemes of ARKODE at fixed step. Each step starts afresh from
/// (t, y): nothing of the past enters but the last matrix and its pattern.
std::unique_ptr<TimeIntegrator> make_implicit_runge_kutta(const Model& model, Dynamics& dynamics,
                                                          const StepSettings& settings);

/// An explicit pair of ARKODE with error control, as a reference: its steps stay below the limit
/// of stability because the error would grow. Fixed: steps of the length that advance() asks for,
/// whatever the error, to see where that limit is.
enum class ExplicitSteps { ByError, Fixed };
std::unique_ptr<TimeIntegrator> make_explicit_runge_kutta(
    const Model& model, Dynamics& dynamics, const StepSettings& settings,
    ExplicitSteps steps = ExplicitSteps::ByError);

}  // namespace articular::sim
