#include "sim/build/linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "sim/mesh/extent.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Thickness in elements of tissue whose surface is not known: no factor for that.
constexpr double kThick = 100;

double poisson_ratio(const Tissue& tissue) {
  const double kappa = tissue.bulk_modulus, mu = tissue.shear_modulus;
  return (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
}

/// See fem::SolverProblem::reach. Of a body with the box a ≥ b ≥ c and the volume V, and its
/// farthest point D from the nearest node that is tied, or where none is from its middle: D/h ·
/// max(1, D a b/V).
double reach_of(const Tissue& tissue) {
  constexpr std::size_t kMostTied = 400, kMostNodes = 2000;  // looked at: enough for a scale
  std::vector<Eigen::Index> tied, all;
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    all.push_back(static_cast<Eigen::Index>(i));
    if (tissue.nodes[i].rigid >= 0) tied.push_back(all.back());
  }
  Vec3 box = tissue.X.rowwise().maxCoeff() - tissue.X.rowwise().minCoeff();
  double farthest = tied.empty() ? 0.5 * box.norm() : 0;
  for (std::size_t i = 0; !tied.empty() && i < all.size(); i += 1 + all.size() / kMostNodes) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < tied.size(); j += 1 + tied.size() / kMostTied)
      nearest = std::min(nearest, (tissue.X.col(all[i]) - tissue.X.col(tied[j])).norm());
    farthest = std::max(farthest, nearest);
  }
  std::sort(box.data(), box.data() + 3);
  const std::vector<double>& volumes = tissue.elements.rest_volume();
  const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  return farthest / element_size(tissue) * std::max(1.0, farthest * box[2] * box[1] / volume);
}

/// See fem::SolverProblem::thickness. A cell of six tetrahedra has two faces on a side.
double thickness_of(const Collider& collider) {
  constexpr double kTetsByFace = 1.5;  // of one layer
  const auto tets = static_cast<double>(collider.tets.cols());
  return tets / (kTetsByFace * static_cast<double>(collider.surface.faces.cols()));
}

fem::SolverProblem problem_of(const Scenario& scenario, const Model& model) {
  fem::SolverProblem problem;
  problem.num_blocks = model.layout.num_unknown_blocks();
  problem.num_nodes = model.layout.num_free_nodes;
  problem.has_contact = !model.contacts.empty();
  problem.has_friction = has_friction(model);
  problem.in_time = !model.is_static;
  problem.reach = 0;
  problem.along = 1;
  problem.thickness = 0;
  for (const Tissue& tissue : model.tissues) {
    problem.reach = std::max(problem.reach, reach_of(tissue));
    problem.along = std::max(problem.along, extent(tissue.X) / element_size(tissue));
    const std::optional<Collider>& collider =
        model.bodies[static_cast<std::size_t>(tissue.body)].collider;
    problem.thickness = std::max(problem.thickness, collider ? thickness_of(*collider) : kThick);
    problem.is_held = problem.is_held && is_tied(tissue);
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
