#pragma once

#include <optional>
#include <string>

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// The keys of a dynamic scenario that `accuracy = "..."` stands for, each of which may be given
/// beside it.
struct Preset {
  Integrator integrator;
  Scenario::Response contact_response = Scenario::Response::Averaged;
  std::optional<double> contact_stiffness_factor;  // default: chosen by the scheme
  /// What came out in mandible/opening-study.toml: largest error of the incisors' path, and that of
  /// the mean force on the joint.
  std::string promise;
};

/// Chosen from the studies in scenarios/mandible and scenarios/verification.
Preset preset(Scenario::Accuracy accuracy);

}  // namespace articular::sim
