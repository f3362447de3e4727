#pragma once

#include "sim/time/time_integrator.hpp"

namespace articular::sim {

/// CVODE's BDF of orders 1 and 2 with error control: each step's estimated error is kept within
/// position_tolerance. Its history is of the solution that it returned last: another y begins
/// anew, at order 1.
std::unique_ptr<TimeIntegrator> make_bdf(const Model& model, Dynamics& dynamics,
                                         const StepSettings& settings);

}  // namespace articular::sim
