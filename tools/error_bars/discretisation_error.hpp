#pragma once

#include <span>
#include <string>

#include "tools/study/study_values.hpp"

namespace articular::tools {

/// The safety factor where nothing tells how fast a result converges.
inline constexpr double kDoubtSafety = 3;

/// A result, and the size of what it was computed with: elements, steps, ...
struct SizedValue {
  double size = 0;   // in any unit, above 0
  double value = 0;  // NaN: there was none
};

/// How far a result may be from that of size 0.
struct DiscretisationError {
  double bar = kNoValue;    // in the result's unit; NaN: not estimated
  double order = kNoValue;  // observed order of convergence; NaN: none was
  std::string doubt;        // why the bar is no extrapolation in the asymptotic range; "": it is
};

/// From the same result with sizes that grow. Those without a value are left out.
///
/// - Three that converge with an order p from 1/2 to 3: grid convergence index [Roache 1994],
///
///     bar = 1.25 |f2 - f1| / (r^q - 1),  r = h2 / h1,  q = min(p, formal order)
///
///   with p from uneven ratios [Celik 2008]. An order above the formal one is no reason to trust
///   in less error.
/// - Three that go to and fro with differences that fall, or converge faster than any method does:
///   1.25 times their spread. Half of it would be the usual bar [Stern 2001].
/// - Three whose differences hardly fall or grow: three times their spread [Eca, Hoekstra 2014].
/// - Two: 3 |f2 - f1| / (r^q - 1) with the formal order q [Roache 1994].
/// - Equal values: 0.
///
/// @param values        the finest first, sizes strictly growing
/// @param formal_order  of the method, > 0
///
/// [Roache 1994] J Fluids Eng 116:405. [Celik 2008] J Fluids Eng 130:078001.
/// [Stern 2001] J Fluids Eng 123:793. [Eca, Hoekstra 2014] J Comput Phys 262:104.
DiscretisationError discretisation_error(std::span<const SizedValue> values, double formal_order);

}  // namespace articular::tools
