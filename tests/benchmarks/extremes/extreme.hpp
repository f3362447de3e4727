#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/benchmarks/extremes/bench.hpp"

namespace articular::benchmarks {

/// How articular came out of an extreme.
enum class Outcome {
  Right,     // within the stated bound
  Degraded,  // beyond it, but stable, and summary.json warns
  Refused,   // exit code 2 or 3, with a message that names what and why; what was written is valid
  Failed     // anything else: NaN, crash, endless loop, or an error that nobody tells
};

std::string name_of(Outcome outcome);

struct Finding {
  Outcome outcome = Outcome::Failed;
  std::string measured;  // with the bound, or what the program said
};

/// One row of the table.
struct Extreme {
  std::string name;   // "time step"
  std::string range;  // "1e-6 s"
  Outcome expected = Outcome::Right;
  bool quick = false;  // a matter of seconds: part of the test
  std::function<Finding(const Bench&)> study;
};

/// The rows of each theme.
std::vector<Extreme> time_steps();
std::vector<Extreme> materials();
std::vector<Extreme> densities();
std::vector<Extreme> dragged_spheres();
std::vector<Extreme> meshes();
std::vector<Extreme> squeezes();
std::vector<Extreme> start_shapes();
std::vector<Extreme> fast_motions();
std::vector<Extreme> large_loads();
std::vector<Extreme> overlaps();
std::vector<Extreme> heaps();
std::vector<Extreme> long_runs();
std::vector<Extreme> missing_supports();

/// All of them.
std::vector<Extreme> all_extremes();

}  // namespace articular::benchmarks
