#pragma once

#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {

/// The largest energy that was there without anything having put it in, by the largest energy that
/// was there at all. From a probe called `energy`.
double energy_created(const ScenarioResults& results);

}  // namespace articular::benchmarks
