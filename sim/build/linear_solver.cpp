#include "sim/build/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

double poisson_ratio(const Tissue& tissue) {
  const double kappa = tissue.bulk_modulus, mu = tissue.shear_modulus;
  return (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
}

fem::SolverProblem problem_of(const Scenario& scenario, const Model& model) {
  fem::SolverProblem problem;
  problem.num_blocks = model.layout.num_unknown_blocks();
  problem.num_nodes = model.layout.num_free_nodes;
  problem.has_contact = !model.contacts.empty();
  problem.in_time = !model.is_static;
  for (const Tissue& tissue : model.tissues) {
    problem.has_pressure |= tissue.elements.smoothed() != nullptr;
    problem.largest_nu = std::max(problem.largest_nu, poisson_ratio(tissue));
    const double density = *scenario.bodies[static_cast<std::size_t>(tissue.body)].density;
    const double speed = std::sqrt(constrained_modulus(tissue) / density);
    problem.elements_a_step =
        std::max(problem.elements_a_step, scenario.integrator.step * speed / element_size(tissue));
  }
  return problem;
}

}  // namespace

fem::SolverChoice choose_linear_solver(const Scenario& scenario, const Model& model) {
  const fem::SolverProblem problem = problem_of(scenario, model);
  fem::SolverChoice choice{fem::SolverKind::Cholesky, 0, "as the scenario says"};
  switch (scenario.integrator.solver) {
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

}  // namespace articular::sim
