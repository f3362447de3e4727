#pragma once

#include <string>
#include <vector>

#include "sim/base/length_unit.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

/// What a probe's columns are called: "incisor.position.z [mm]".
std::vector<std::string> column_names(const ProbeModel& probe, const LengthUnit& unit);

/// Appends what they show now, in the units of their names. A share is NaN: it needs the whole row.
void append_values(const ProbeModel& probe, const Model& model, const LengthUnit& unit,
                   const State& state, const Stepper& stepper, std::vector<double>& values);

}  // namespace articular::sim
