#include "sim/time/time_integrator.hpp"

#include "sim/time/runge_kutta.hpp"

namespace articular::sim {

std::unique_ptr<TimeIntegrator> make_time_integrator(const Model& model, Dynamics& dynamics,
                                                     const StepSettings& settings) {
  if (settings.scheme == Integrator::Scheme::Explicit)
    return make_explicit_runge_kutta(model, dynamics, settings);
  return make_implicit_runge_kutta(model, dynamics, settings);
}

}  // namespace articular::sim
