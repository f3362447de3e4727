#include "fem/material/bounded_exponential.hpp"

#include <cmath>

namespace articular::fem::bounded_exponential {
namespace {

constexpr double kLargest = 100;  // [-]

}  // namespace

double minus_one(double x) {
  const double d = x - kLargest;
  return d <= 0 ? std::expm1(x) : std::exp(kLargest) * (1 + d + 0.5 * d * d) - 1;
}

double slope(double x) {
  const double d = x - kLargest;
  return d <= 0 ? std::exp(x) : std::exp(kLargest) * (1 + d);
}

double curvature(double x) { return std::exp(std::fmin(x, kLargest)); }

}  // namespace articular::fem::bounded_exponential
