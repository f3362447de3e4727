#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/target_error/error_course.hpp"

/// The cheapest sizes for an error, and the least error for a time.
namespace articular::tools {

/// What may be chosen for one kind of size.
struct SizeChoice {
  std::vector<double> sizes;  // from the finest run's down, as those of the course
  double cost_order = 0;      // the time of a run goes with size^-cost_order
};

/// Leaves the size of the finest run, and those that are smaller by 1.3 at least: of closer ones
/// the difference would say little [Celik 2008, J Fluids Eng 130:078001].
void drop_close_sizes(const ErrorCourse& course, SizeChoice& choice);

/// A choice, with what is expected of it.
struct ChosenSizes {
  std::vector<double> sizes;  // one a course
  double bar = 0;             // in the result's unit
  double seconds = 0;
};

/// @param seconds  that the finest run took
/// @return none where no choice reaches the goal
std::optional<ChosenSizes> cheapest_sizes(std::span<const ErrorCourse> courses,
                                          std::span<const SizeChoice> choices, double seconds,
                                          double goal);

/// @return none where even the cheapest choice takes longer than `limit`
std::optional<ChosenSizes> best_sizes_within(std::span<const ErrorCourse> courses,
                                             std::span<const SizeChoice> choices, double seconds,
                                             double limit);

}  // namespace articular::tools
