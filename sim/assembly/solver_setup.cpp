#include "sim/assembly/solver_setup.hpp"

namespace articular::sim {
namespace {

/// Iterations stop here: Newton's iteration corrects the rest.
constexpr double kLinearTolerance = 1e-3;
constexpr int kMostLinearIterations = 2000;

}  // namespace

bool needs_linear_solver(const Model& model, Integrator::Scheme scheme) {
  return model.is_static || scheme != Integrator::Scheme::Explicit;
}

std::string name_of(fem::SolverKind kind) {
  switch (kind) {
    case fem::SolverKind::Cholesky:
    case fem::SolverKind::SaddlePoint:
      return "cholesky";
    case fem::SolverKind::ConjugateGradients:
      return "conjugate-gradients";
    case fem::SolverKind::Multigrid:
      return "multigrid";
  }
  return "";
}

std::unique_ptr<fem::LinearSolver> make_linear_solver(const Model& model) {
  return fem::make_linear_solver(model.linear_solver, kLinearTolerance, kMostLinearIterations,
                                 model.pool);
}

bool prepare_linear(fem::LinearSolver& solver, const NewtonEquations& equations,
                    const Positions& x) {
  const fem::FactorStatus status =
      equations.pressure.terms.empty()
          ? solver.prepare(equations.A, x)
          : solver.prepare_with_pressure(equations.A, x, equations.pressure);
  return status == fem::FactorStatus::Ready;
}

}  // namespace articular::sim
