#include "tools/study/observed_order.hpp"

#include <cmath>

namespace articular::tools {

// By bisection: the ratio grows with p.
double observed_order(double e21, double e32, double r21, double r32) {
  const auto ratio = [&](double p) {
    return (std::pow(r32, p) - 1) * std::pow(r21, p) / (std::pow(r21, p) - 1);
  };
  double low = kLeastOrder, high = kMostOrder;
  if (e21 == 0 || e32 / e21 >= ratio(high)) return high;
  if (e32 / e21 <= ratio(low)) return low;
  for (int i = 0; i < 60; ++i) {
    const double p = 0.5 * (low + high);
    (ratio(p) < e32 / e21 ? low : high) = p;
  }
  return 0.5 * (low + high);
}

}  // namespace articular::tools
