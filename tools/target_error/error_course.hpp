#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/error_bars/discretisation_error.hpp"

/// How the error of one result falls with each kind of size, and what that means for sizes that
/// have not been tried.
namespace articular::tools {

/// One kind of size: of elements, steps, penetrations, the iteration's tolerance.
struct ErrorCourse {
  std::string name;
  double formal_order = 1;
  /// The finest first; sizes relative to the first run's. Values are those with the other kinds as
  /// in the first run: only their differences count. One point: this kind is not varied.
  std::vector<SizedValue> points;

  double size() const { return points.front().size; }  // of the finest run
};

/// Of the finest run, by the three finest points; 0 where the kind is not varied. Runs are coarse
/// here: a safety factor of 1.25 is for an order that is the method's within a quarter, and 3 for
/// another one [Oberkampf, Roy 2010, section 8.7]. Of a larger order that of the method is
/// believed, and the bar is no less than the two coarser ones foretold.
///
/// [Oberkampf, Roy 2010] Verification and validation in scientific computing. Cambridge.
DiscretisationError error_of(const ErrorCourse& course);

/// The bar that a run with `ratio` (at most 1) of the finest run's size is expected to have.
///
/// It falls with the order that was seen, or the method's, whichever is less; with order 1 where
/// the points show none. Two points have a bar with a safety factor of 3, and a third one brings
/// that of 1.25 if it confirms the order.
double expected_bar(const ErrorCourse& course, double ratio);

/// By how much the result is expected to change from the finest run to one with `ratio` of its
/// size.
double expected_change(const ErrorCourse& course, double ratio);

/// Adds a finer run, whose kinds may all have changed at once.
///
/// Its change is shared out among the kinds as expected_change() foretold, and what was not
/// foretold in proportion to that: so an order that is not as it was taken to be shows in the next
/// error_of().
/// @param sizes  one a course, at most size()
/// @param change of the result from the finest run
void add_finer_run(std::span<ErrorCourse> courses, std::span<const double> sizes, double change);

}  // namespace articular::tools
