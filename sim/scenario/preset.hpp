#pragma once

#include <string>

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// What `accuracy = "..."` stands for in a dynamic analysis; a static one takes nothing of it but
/// the step and the tolerance.
struct Preset {
  Integrator integrator;
  Scenario::Response contact_response = Scenario::Response::Averaged;
  /// What came out in mandible/opening-study.toml: largest error of the incisors' path, and that of
  /// the mean force on the joint.
  std::string promise;
};

/// Chosen from the studies in scenarios/mandible and scenarios/verification.
Preset preset(Scenario::Accuracy accuracy);

}  // namespace articular::sim
