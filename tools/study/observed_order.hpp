#pragma once

/// How fast runs of three sizes converge.
namespace articular::tools {

/// Orders of convergence beyond these are not told.
inline constexpr double kLeastOrder = 0.5, kMostOrder = 4;

/// The safety factor of the grid convergence index from three runs [Roache 1994].
inline constexpr double kGridSafety = 1.25;

/// The order p at which an error C h^p makes these differences, from [Celik 2008]
///
///   e32 / e21 = (r32^p - 1) r21^p / (r21^p - 1)
///
/// kMostOrder or kLeastOrder where it lies beyond.
/// @param e21, e32  differences of the medium run from the fine one, of the coarse one from the
///                  medium one; of one sign
/// @param r21, r32  ratios of their sizes, above 1
double observed_order(double e21, double e32, double r21, double r32);

}  // namespace articular::tools
