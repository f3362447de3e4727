#pragma once

#include <string>
#include <vector>

#include "sim/output/history.hpp"
#include "sim/output/provenance.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

struct WallTimes {
  double total = 0, overlap_resolution = 0, output = 0;  // [s]
};

/// summary.json: settings, sizes, counts, wall time by phase, energy balance, memory, versions.
/// @param inputs    of the scenario
/// @param warnings  of the run, beyond those of the model
/// @param outcome   "finished", "interrupted" or the reason why it could not go on
std::string summary_json(const Scenario& scenario, const Model& model, const State& state,
                         const Stepper& stepper, const PhaseTimes& phases, const WallTimes& wall,
                         const std::vector<InputFile>& inputs,
                         const std::vector<std::string>& warnings, const std::string& outcome);

}  // namespace articular::sim
