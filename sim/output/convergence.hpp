#pragma once

#include <string>
#include <vector>

#include "sim/statics/load_step.hpp"

/// convergence.csv: every Newton iteration of a static analysis.
namespace articular::sim {

/// The first line.
std::string convergence_header(const Model& model);
/// One line each.
std::string convergence_rows(const Model& model, const std::vector<ConvergenceRow>& rows);

/// The rows of a table with times [s] in its first column, after the header, up to a time.
std::string rows_until(const std::string& table, double time);

}  // namespace articular::sim
