#pragma once

#include <string>

#include "tests/benchmarks/extremes/bench.hpp"

namespace articular::benchmarks {

struct StabilityLimit {
  double mean_step = 0;          // [s] that the explicit scheme took
  double largest_frequency = 0;  // [1/s] of the scene at rest
};

/// Runs an explicit scene whose tolerance is loose, so that its error control finds the limit of
/// stability: there the error grows from step to step. Beside it ω_max, by power iteration on M⁻¹K.
StabilityLimit find_stability_limit(const Bench& bench, const std::string& scene);

}  // namespace articular::benchmarks
