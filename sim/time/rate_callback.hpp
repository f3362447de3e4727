#pragma once

#include "sim/base/sundials.hpp"
#include "sim/time/time_integrator.hpp"

/// What the schemes' C callbacks have in common.
namespace articular::sim::sundials {

/// y_dot = rate(t, y), unless the integrator is asked to stop. @return 0, or 1 where a force is not
/// finite
inline int evaluate_rate(const TimeIntegrator& integrator, Dynamics& dynamics,
                         const Conditions& conditions, SolverCounts& counts,
                         std::exception_ptr& error, double t, N_Vector y, N_Vector y_dot) {
  return guarded(error, [&] {
    integrator.stop_if_asked();
    ++counts.force_evaluations;
    dynamics.evaluate(N_VGetArrayPointer(y), t, conditions);
    dynamics.rate(N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot));
    return dynamics.now().forces.allFinite() ? 0 : 1;
  });
}

}  // namespace articular::sim::sundials
