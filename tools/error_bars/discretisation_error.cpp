#include "tools/error_bars/discretisation_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/study/observed_order.hpp"

namespace articular::tools {
namespace {

constexpr double kTrustedOrder = 3;  // faster is not the law of an error, but chance

double spread_of(const std::vector<SizedValue>& values) {
  const auto [least, most] = std::minmax_element(
      values.begin(), values.end(),
      [](const SizedValue& a, const SizedValue& b) { return a.value < b.value; });
  return most->value - least->value;
}

DiscretisationError from_two(const std::vector<SizedValue>& f, double formal_order) {
  const double r = f[1].size / f[0].size;
  return {kDoubtSafety * std::abs(f[1].value - f[0].value) / (std::pow(r, formal_order) - 1),
          kNoValue, fmt::format("order {} taken, not seen", formal_order)};
}

DiscretisationError from_three(const std::vector<SizedValue>& f, double formal_order) {
  const double e21 = f[1].value - f[0].value, e32 = f[2].value - f[1].value;
  const double r21 = f[1].size / f[0].size, r32 = f[2].size / f[1].size;
  const double spread = spread_of(f);
  if (e21 * e32 <= 0) {
    if (std::abs(e21) >= std::abs(e32))
      return {kDoubtSafety * spread, kNoValue, "differences grow"};
    return {kGridSafety * spread, kNoValue, e21 == 0 ? "stands still" : "goes to and fro"};
  }
  const double order = observed_order(std::abs(e21), std::abs(e32), r21, r32);
  if (order <= kLeastOrder) return {kDoubtSafety * spread, kNoValue, "hardly converges"};
  if (order > kTrustedOrder) return {kGridSafety * spread, kNoValue, "order above 3"};
  const double believed = std::min(order, formal_order);
  return {kGridSafety * std::abs(e21) / (std::pow(r21, believed) - 1), order, ""};
}

}  // namespace

DiscretisationError discretisation_error(std::span<const SizedValue> values, double formal_order) {
  if (values.empty() || !std::isfinite(values[0].value)) return {kNoValue, kNoValue, "no value"};
  std::vector<SizedValue> known;
  for (const SizedValue& value : values)
    if (std::isfinite(value.value)) known.push_back(value);
  if (known.size() < 2) return {kNoValue, kNoValue, "no value in the coarser runs"};
  if (spread_of(known) == 0) return {0, kNoValue, ""};
  return known.size() == 2 ? from_two(known, formal_order) : from_three(known, formal_order);
}

}  // namespace articular::tools
