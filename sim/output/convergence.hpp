#pragma once

#include <string>
#include <vector>

#include "sim/base/length_unit.hpp"
#include "sim/statics/load_step.hpp"

/// convergence.csv: every Newton iteration of a static analysis.
namespace articular::sim {

/// The first line.
std::string convergence_header(const LengthUnit& unit);
/// One line each.
std::string convergence_rows(const Model& model, const std::vector<ConvergenceRow>& rows,
                             const LengthUnit& unit);

}  // namespace articular::sim
