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
/// here: a safety factor of 1.25 is for an order that confirms the method's order q, and 3 for
/// another one [Oberkampf, Roy 2010, section 8.7]. Confirmed is q if the order is from 3/4 q to
/// q + 1. Of a larger order than q that of the method is believed, with the two that differ more
/// beyond q + 1.
///
/// Why q + 1: an error a h^q + b h^(q+1) whose terms have one sign shows an order in between. The
/// two finest, with order q, then have
///
///   a h^q + b h^(q+1) (r^(q+1) - 1) / (r^q - 1),  r = ratio of their sizes,
///
/// which is more than the error, by (r^(q+1) - 1) / (r^q - 1) at most.
///
/// [Oberkampf, Roy 2010] Verification and validation in scientific computing. Cambridge.
DiscretisationError error_of(const ErrorCourse& course);

/// The bar that two points would have, were a third one to confirm the method's order; that of
/// error_of() else.
double confirmed_bar(const ErrorCourse& course);

/// Adds a third point, coarser than two, if the three confirm the order.
void add_if_it_confirms(ErrorCourse& course, const SizedValue& coarsest);

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
