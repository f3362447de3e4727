#pragma once

#include <limits>

namespace articular::tools {

/// How a number is spread. Mean and standard deviation are those before it is cut off.
struct Distribution {
  enum class Kind { Uniform, Normal, Lognormal };
  Kind kind = Kind::Uniform;
  double mean = 0, sd = 1;  // of the number itself, also where it is lognormal
  /// Ends of a uniform distribution; where others are cut off.
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// The value below which the share p lies. @param p  in (0, 1)
double quantile(const Distribution& distribution, double p);

/// The share of a distribution that lies between where it is cut off; 1: it is not.
double kept_share(const Distribution& distribution);

double normal_quantile(double p);
/// The share of a standard normal distribution below z.
double normal_share(double z);

}  // namespace articular::tools
