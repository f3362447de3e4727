#pragma once

#include <string>

#include "sim/scenario.hpp"

namespace articular::sim {

/// What `accuracy = "..."` stands for in a dynamic analysis; a static one takes nothing of it but the
/// step and the tolerance.
struct Preset {
  Integrator integrator;
  Detection::Sides sides = Detection::Sides::Both;
  /// What came out on the jaw's opening, scenarios/mandible/README.md.
  std::string promise;
};

/// Chosen from the studies in scenarios/: each lies on the front of error against time there, or
/// near it.
Preset preset(Scenario::Accuracy accuracy);

}  // namespace articular::sim
