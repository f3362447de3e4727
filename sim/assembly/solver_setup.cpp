#include "sim/assembly/solver_setup.hpp"

#include <algorithm>
#include <cmath>

#include "fem/material/point_law.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Iterations stop here: Newton's iteration corrects the rest.
constexpr double kLinearTolerance = 1e-6;
constexpr int kMostLinearIterations = 2000;

double poisson_ratio(const fem::AnyMaterial& law) {
  const double kappa = fem::bulk_modulus(law), mu = fem::shear_modulus(law);
  return (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
}

fem::SolverProblem problem_of(const Model& model) {
  fem::SolverProblem problem;
  problem.num_blocks = model.layout.num_unknown_blocks();
  problem.num_nodes = model.layout.num_free_nodes;
  problem.has_contact = !model.contacts.empty();
  problem.in_time = model.scenario.analysis == Scenario::Analysis::Dynamic;
  for (const Tissue& tissue : model.tissues) {
    problem.has_pressure |= tissue.elements.smoothed() != nullptr;
    const Body& body = model.scenario.bodies[static_cast<std::size_t>(tissue.body)];
    problem.largest_nu = std::max(problem.largest_nu, poisson_ratio(*body.material->law));
    const double speed = std::sqrt(constrained_modulus(*body.material) / *body.density);
    problem.elements_a_step = std::max(
        problem.elements_a_step, model.scenario.integrator.step * speed / element_size(tissue));
  }
  return problem;
}

}  // namespace

fem::SolverChoice choose_linear_solver(const Model& model) {
  const fem::SolverProblem problem = problem_of(model);
  fem::SolverChoice choice{fem::SolverKind::Cholesky, 0, "as the scenario says"};
  switch (model.scenario.integrator.solver) {
    case Integrator::Solver::Auto:
      return fem::choose_solver(problem);
    case Integrator::Solver::Cholesky:
      if (problem.has_pressure) choice.kind = fem::SolverKind::SaddlePoint;
      break;
    case Integrator::Solver::ConjugateGradients:
      choice.kind = fem::SolverKind::ConjugateGradients;
      break;
    case Integrator::Solver::Multigrid:
      choice.kind = fem::SolverKind::Multigrid;
      break;
  }
  return choice;
}

bool needs_linear_solver(const Model& model) {
  return model.scenario.analysis == Scenario::Analysis::Static ||
         model.scenario.integrator.scheme != Integrator::Scheme::Explicit;
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
  return fem::make_linear_solver(choose_linear_solver(model), kLinearTolerance,
                                 kMostLinearIterations, model.pool);
}

bool prepare_linear(fem::LinearSolver& solver, const fem::BlockMatrix& A, const Positions& x,
                    const fem::PressurePart& pressure) {
  const fem::FactorStatus status =
      pressure.terms.empty() ? solver.prepare(A, x) : solver.prepare_with_pressure(A, x, pressure);
  return status == fem::FactorStatus::Ready;
}

}  // namespace articular::sim
