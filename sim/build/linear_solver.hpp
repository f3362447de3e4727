#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// The linear solver that the scenario asks for, or with "auto" the one that suits the model's
/// size, its elements and its analysis, with the reason. The contacts are there.
fem::SolverChoice choose_linear_solver(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
