#pragma once

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// How a model is moved on: what its equations do not say.
struct StepSettings {
  Integrator::Scheme scheme = Integrator::Scheme::ImplicitEuler;  // of a dynamic analysis
  double step = 1e-3;       // [s], the longest; of a static analysis, of the loads
  int max_iterations = 20;  // Newton iterations before the step is halved
  Detection::Tree tree = Detection::Tree::Blocks;
};

}  // namespace articular::sim
