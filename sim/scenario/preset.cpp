#include "sim/scenario/preset.hpp"

namespace articular::sim {

Preset preset(Scenario::Accuracy accuracy) {
  Preset preset;
  Integrator& integrator = preset.integrator;
  switch (accuracy) {
    case Scenario::Accuracy::Fast:
      integrator.step = 2e-3;
      preset.contact_response = Scenario::Response::Pointwise;
      preset.promise =
          "within 0.5 mm of a converged run where a jaw opens by 37 mm, and 4 % of the force on "
          "its joint, at 0.6 of the time of balanced";
      break;
    case Scenario::Accuracy::Balanced:
      preset.promise =
          "within 0.25 mm of a converged run where a jaw opens by 37 mm, and 0.7 % of the force on "
          "its joint";
      break;
    case Scenario::Accuracy::Accurate:
      integrator.scheme = Integrator::Scheme::TrBdf2;
      integrator.element_tolerance = 5e-5;
      // Forces of averages no longer depend on it; noise of the forces is within the tolerance.
      preset.contact_stiffness_factor = 1000;
      preset.promise =
          "within 0.07 mm of a converged run where a jaw opens by 37 mm, and 0.1 % of the force on "
          "its joint, at 2.6 times the time of balanced";
      break;
  }
  return preset;
}

}  // namespace articular::sim
