#pragma once

#include "fem/solver/solver_choice.hpp"
#include "sim/assembly/dynamics.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// The explicit scheme does without.
bool needs_linear_solver(const Model& model, Integrator::Scheme scheme);

/// As scenario files call it: "cholesky", "conjugate-gradients", "multigrid".
std::string name_of(fem::SolverKind kind);

std::unique_ptr<fem::LinearSolver> make_linear_solver(const Model& model);

/// Takes a matrix with what couples all nodes through pressures, and where its free nodes are [m].
/// @return whether it can be solved
bool prepare_linear(fem::LinearSolver& solver, const NewtonEquations& equations,
                    const Positions& x);

}  // namespace articular::sim
