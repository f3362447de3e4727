#pragma once

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// How a model is moved on: what its equations do not say.
struct StepSettings {
  Integrator::Scheme scheme = Integrator::Scheme::ImplicitEuler;  // of a dynamic analysis
  double step = 1e-3;       // [s], the longest; of a static analysis, of the loads
  double min_step = 1e-7;   // [s], below which the run stops
  int max_iterations = 20;  // Newton iterations before the step is halved
  Detection detection;
};

}  // namespace articular::sim
