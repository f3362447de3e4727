#pragma once

#include <string>

#include "tests/benchmarks/extremes/bench.hpp"

namespace articular::benchmarks {

struct SpinDrift {
  ProgramRun run;
  double energy = 0;    // E/E₀ − 1
  double momentum = 0;  // |L − L₀|/|L₀|
};

/// Drifts of a free body with three different moments of inertia, which tumbles at 100 rad/s for
/// this time [s]. The last checkpoint tells its state in full precision.
/// @param integrator  lines of [integrator]
SpinDrift spin_drift(const Bench& bench, const std::string& name, double step, double time,
                     const std::string& integrator);

}  // namespace articular::benchmarks
