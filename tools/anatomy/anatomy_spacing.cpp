#include "tools/anatomy/anatomy_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "tools/anatomy/anatomy_grid.hpp"

namespace articular::anatomy {
namespace {

/// By the size away from the focus, at a place [mm].
double relative_size(double place, const Focus& focus) {
  const double t = std::clamp(std::abs(place - focus.middle) / focus.reach - 1, 0.0, 1.0);
  const double away = t * t * (3 - 2 * t);
  return away + (1 - away) / focus.factor;
}

}  // namespace

Spacing::Spacing(double length, double size, const Focus& focus)
    : cells_(even_cells(length, size, 4)) {
  if (!(focus.factor > 1)) return;
  // Cells up to a place: the integral of 1/size, by the midpoint rule.
  constexpr int kSamples = 2000;
  even_.push_back(0);
  for (int i = 0; i < kSamples; ++i) {
    const double place = length * ((i + 0.5) / kSamples - 0.5);
    even_.push_back(even_.back() + length / kSamples / relative_size(place, focus));
  }
  const double all = even_.back();  // the length that as many cells of one size would have
  cells_ = even_cells(all, size, 4);
  for (double& t : even_) t = 2 * t / all - 1;
}

double Spacing::place(double t) const {
  if (even_.empty()) return t;
  const auto after = std::upper_bound(even_.begin() + 1, even_.end() - 1, t);
  const double before = *(after - 1);
  const double i =
      static_cast<double>(after - 1 - even_.begin()) + (t - before) / (*after - before);
  return 2 * i / static_cast<double>(even_.size() - 1) - 1;
}

}  // namespace articular::anatomy
