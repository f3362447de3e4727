#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/model/model.hpp"
#include "sim/model/step_settings.hpp"

namespace articular::tools {

/// What one term of a scene takes, by evaluating it where things are at the start.
struct TermCost {
  std::string term;           // "elasticity of `disc_left` (plain)"
  int unknowns = 0;           // velocities
  double force_seconds = 0;   // of one evaluation of its forces; detection: of one search
  double matrix_seconds = 0;  // of its part in one matrix, where that can be told apart
};

/// All that a step has to do, measured on this machine. Contact that is only made later costs
/// nothing yet, and the factor of the linear solver grows as it couples bodies.
struct SceneCosts {
  std::vector<TermCost> terms;
  double evaluation_seconds = 0;                    // of all forces
  double assembly_seconds = 0;                      // of the whole matrix
  double factor_seconds = 0;                        // preparing the linear solver with it
  double solve_seconds = 0;                         // with the factor
  double detection_seconds = 0;                     // of one search for contacts
  std::int64_t possible_pairs = 0, near_pairs = 0;  // of bodies; boxes that overlap with the margin
  // Heap that each of them holds [bytes]:
  double detection_bytes = 0, matrix_bytes = 0, solver_bytes = 0;
  double peak_bytes = 0;  // of this process by now: about what a run needs
  /// Of a dynamic analysis [s], where things are at the start: see sim/time/explicit_limit.hpp.
  std::optional<double> longest_explicit_step;

  /// One iteration of Newton's method: forces, matrix, factor and solution.
  double iteration_seconds() const {
    return evaluation_seconds + assembly_seconds + factor_seconds + solve_seconds;
  }
};

SceneCosts measure_costs(const sim::Model& model, const sim::StepSettings& settings);

/// Bytes of heap in use by this process.
double heap_in_use();

}  // namespace articular::tools
