#pragma once

#include <string>
#include <vector>

#include "tools/error_bars/error_bars.hpp"

namespace articular::tools {

/// "negligible", "asymptotic", "not asymptotic (mesh: goes to and fro)" or "not estimated (...)".
std::string verdict(const ErrorBar& bar);

/// error_bars.csv: a row a quantity, with value, bar, and bar and observed order of each direction.
std::string error_bars_csv(const std::vector<Direction>& directions,
                           const std::vector<ErrorBar>& bars);

/// The same for a terminal, after what was varied by how much and what is not in the bars.
std::string error_bars_text(const std::vector<Direction>& directions,
                            const std::vector<ErrorBar>& bars);

/// summary.json with `error_bars`: the coarser runs, what is not in the bars, how many quantities
/// are asymptotic.
std::string summary_with_error_bars(const std::string& summary,
                                    const std::vector<Direction>& directions,
                                    const std::vector<ErrorBar>& bars);

}  // namespace articular::tools
