#pragma once

#include "fem/solver/solver_choice.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// The explicit scheme does without.
bool needs_linear_solver(const Model& model, Integrator::Scheme scheme);

/// As scenario files call it: "cholesky", "conjugate-gradients", "multigrid".
std::string name_of(fem::SolverKind kind);

std::unique_ptr<fem::LinearSolver> make_linear_solver(const Model& model);

/// Takes a matrix, where its free nodes are, and what couples all nodes through pressures.
/// @return whether it can be solved
bool prepare_linear(fem::LinearSolver& solver, const fem::BlockMatrix& A, const Positions& x,
                    const fem::PressurePart& pressure);

}  // namespace articular::sim
