#pragma once

#include <limits>
#include <string_view>

namespace articular::sim {

/// The numbers that a value may have.
struct Range {
  double min, max;
  bool excludes_ends;
  std::string_view rule;          // "must be positive"
  std::string_view subject = "";  // in place of the key: "Poisson's ratio"
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{-kInfinity, kInfinity, true, "must be finite"};
inline constexpr Range kPositive{0, kInfinity, true, "must be positive"};
inline constexpr Range kNotNegative{0, kInfinity, false, "must not be negative"};
inline constexpr Range kFraction{0, 1, false, "must lie between 0 and 1"};
inline constexpr Range kMoreThanOne{1, kInfinity, true, "must be greater than 1"};
inline constexpr Range kOneOrMore{1, kInfinity, false, "must be 1 or more"};
inline constexpr Range kPoissonRange{-1, 0.5, true, "must lie between -1 and 0.5 (exclusive)",
                                     "Poisson's ratio"};

}  // namespace articular::sim
