#pragma once

#include <Eigen/Core>
#include <functional>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/loaded_body.hpp"

namespace articular::fem {

/// What Newton's method asks of a formulation: with a nodal pressure where `smoothed` is set, of
/// the displacement alone otherwise (p is empty then).
struct Formulation {
  std::function<double(const Positions& x, const Eigen::VectorXd& p)> energy;
  std::function<void(const Positions& x, Positions& f)> add_internal_force;
  std::function<BlockMatrix()> make_matrix;
  std::function<void(const Positions& x, const Eigen::VectorXd& p, Tangent, BlockMatrix& K)>
      add_stiffness;
  const SmoothedElasticity* smoothed = nullptr;
};

Formulation formulation_of(const SmoothedElasticity& elasticity);

struct NewtonReport {
  bool converged = false;
  int iterations = 0, linear_iterations = 0, cut_steps = 0, projections = 0;
  double assembly = 0, solution = 0;  // [s] of CPU time
};

struct NewtonSettings {
  double tolerance = 1e-9;  // [-] of the residual, on the free components of the loads
  int max_iterations = 60;
  bool pressure_unknown = true;  // false: Newton's method in x alone, p = A⁻¹ b(x)
};

/// Equilibrium under the whole load, from x on entry. A step is cut back until L(x, p_next) − f·x
/// falls.
NewtonReport equilibrate(const Formulation& formulation, const LoadedBody& body,
                         LinearSolver& solver, Positions& x, const NewtonSettings& settings = {});

}  // namespace articular::fem
