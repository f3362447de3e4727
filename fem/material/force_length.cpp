#include "fem/material/force_length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/material/material.hpp"

namespace articular::fem {
namespace {

// The rule of Gauss and Legendre of 8 points on [-1, 1]; each stands for its mirror image too.
struct Point {
  double at, weight;
};
constexpr std::array kGauss{
    Point{0.1834346424956498, 0.3626837833783620}, Point{0.5255324099163290, 0.3137066458778873},
    Point{0.7966664774136267, 0.2223810344533745}, Point{0.9602898564975363, 0.1012285362903763}};

}  // namespace

ForceLength::ForceLength(const Constants& c) {
  checked_positive(c.sarcomere_length, "sarcomere length", "m");
  checked_positive(c.zero_length, "sarcomere length without active stress", "m");
  checked_positive(c.b, "b", "1/m");
  checked_positive(c.calcium, "calcium", "umol/l");
  checked_positive(c.max_calcium, "largest calcium", "umol/l");
  if (c.calcium > c.max_calcium) {
    std::ostringstream message;
    message << "calcium is " << c.calcium << " umol/l, must be at most the largest calcium, "
            << c.max_calcium << " umol/l";
    throw std::invalid_argument(message.str());
  }
  rate_ = c.b * c.sarcomere_length;
  zero_stretch_ = c.zero_length / c.sarcomere_length;
  ratio_ = (c.max_calcium / c.calcium) * (c.max_calcium / c.calcium);
}

double ForceLength::exponent(double stretch) const { return rate_ * (stretch - zero_stretch_); }

double ForceLength::factor(double stretch) const {
  const double x = exponent(stretch);
  return x > 0 ? -std::expm1(-x) / (1 + (ratio_ - 1) * std::exp(-x)) : 0;
}

double ForceLength::slope(double stretch) const {
  const double x = exponent(stretch);
  if (!(x > 0)) return 0;
  const double decay = std::exp(-x), sum = 1 + (ratio_ - 1) * decay;
  return rate_ * ratio_ * decay / (sum * sum);
}

// Panels are so short that the rule is exact to round-off: as r is at least 1, f is analytic to π
// on both sides of the real x, so that 1 of x is short; and 1/λ to λ = 0. Where f is 1 to round-off
// the rest is a logarithm.
double ForceLength::work(double stretch) const {
  const double saturated = zero_stretch_ + (40 + std::log(ratio_)) / rate_;
  const double end = std::min(stretch, saturated);
  double sum = 0, begin = zero_stretch_;
  while (begin < end) {
    const double next = std::min({begin + 1 / rate_, 1.5 * begin, end});
    const double middle = 0.5 * (begin + next), half = 0.5 * (next - begin);
    for (const auto& [at, weight] : kGauss)
      for (const double s : {middle - half * at, middle + half * at})
        sum += half * weight * factor(s) / s;
    begin = next;
  }
  return stretch > saturated ? sum + std::log(stretch / saturated) : sum;
}

}  // namespace articular::fem
