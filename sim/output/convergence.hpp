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
std::string convergence_rows(const std::vector<ConvergenceRow>& rows, const LengthUnit& unit);

/// The rows of a table with times [s] in its first column, after the header, up to a time.
std::string rows_until(const std::string& table, double time);

}  // namespace articular::sim
