#pragma once

#include "sim/base/sundials.hpp"
#include "sim/time/newton_system.hpp"
#include "sim/time/time_integrator.hpp"

/// What the schemes' C callbacks have in common.
namespace articular::sim::sundials {

/// y_dot = rate(t, y), unless the integrator is asked to stop. @return 0, or 1 where a force is not
/// finite
inline int evaluate_rate(const TimeIntegrator& integrator, Dynamics& dynamics, SolverCounts& counts,
                         std::exception_ptr& error, double t, N_Vector y, N_Vector y_dot) {
  return guarded(error, [&] {
    integrator.stop_if_asked();
    ++counts.force_evaluations;
    dynamics.evaluate(N_VGetArrayPointer(y), t);
    dynamics.rate(N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot));
    return dynamics.forces().allFinite() ? 0 : 1;
  });
}

/// x: Newton's correction at the state y, where the rate was evaluated last (the residual comes
/// first). @return 0, or 1 where there is none
inline int correct(NewtonSystem& newton, SolverCounts& counts, double gamma, N_Vector y, N_Vector x,
                   N_Vector b) {
  ++counts.newton_iterations;
  const bool solved = newton.solve(N_VGetArrayPointer(y), gamma, N_VGetArrayPointer(b),
                                   N_VGetArrayPointer(x), counts);
  return solved ? 0 : 1;
}

inline SUNLinearSolver_Type matrix_embedded(SUNLinearSolver) {
  return SUNLINEARSOLVER_MATRIX_EMBEDDED;
}

}  // namespace articular::sim::sundials
