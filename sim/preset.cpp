#include "sim/preset.hpp"

namespace articular::sim {

Preset preset(Scenario::Accuracy accuracy) {
  Preset preset;
  Integrator& integrator = preset.integrator;
  switch (accuracy) {
    case Scenario::Accuracy::Fast:
      integrator.step = 2e-3;
      preset.sides = Detection::Sides::One;
      preset.promise = "TODO";
      break;
    case Scenario::Accuracy::Balanced:
      preset.promise = "TODO";
      break;
    case Scenario::Accuracy::Accurate:
      integrator.scheme = Integrator::Scheme::TrBdf2;
      integrator.element_tolerance = 5e-5;
      preset.promise = "TODO";
      break;
  }
  return preset;
}

}  // namespace articular::sim
