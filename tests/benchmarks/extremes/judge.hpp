#pragma once

#include <optional>
#include <string>

#include "tests/benchmarks/extremes/extreme.hpp"

namespace articular::benchmarks {

/// What a run must have come to.
struct Bound {
  double right = 0;   // an error up to this is right
  double stable = 0;  // up to this, and told by a warning, is degraded; in time
};

/// A run that did not end with exit code 0: refused, where the message names a body in backticks
/// and what was written is valid, or failed. Nothing where it finished with valid files.
std::optional<Finding> ended_early(const ProgramRun& run);

/// Judges a finished run. A static one ends in an equilibrium, which does not run away: however
/// far from the expected one it is, a warning makes it degraded.
/// @param what  of the error: "tip against the closed form"
Finding judged(const ProgramRun& run, double error, const Bound& bound, const std::string& what);

/// The warnings and notes in summary.json that speak of what happened in the run (not those of the
/// file, which begin with its line), one after the other.
std::string warnings_of(const ProgramRun& run);

}  // namespace articular::benchmarks
