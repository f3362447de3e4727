#include "tools/plot/axis_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace articular::tools {
namespace {

// history.csv has nine digits: what differs in the last of them is noise, not a curve.
constexpr double kNoise = 1e-8;
constexpr double kRoom = 0.05;

bool is_one_value(const AxisRange& range) {
  return !(range.high - range.low > kNoise * size_of(range));
}

AxisRange around(const AxisRange& values) {
  const double room = size_of(values) > 0 ? 0.1 * size_of(values) : 1;
  return {values.low - room, values.high + room};
}

std::string label(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (!text.starts_with('-')) return text;
  text.erase(0, 1);
  return text.find_first_not_of("0.") == std::string::npos ? text : "−" + text;
}

}  // namespace

double size_of(const AxisRange& range) {
  return std::max(std::abs(range.low), std::abs(range.high));
}

AxisRange with_room(const AxisRange& values) {
  if (is_one_value(values)) return around(values);
  const double room = kRoom * (values.high - values.low);
  return {values.low - room, values.high + room};
}

AxisRange with_length(const AxisRange& values) {
  return is_one_value(values) ? around(values) : values;
}

Ticks ticks(const AxisRange& range, int most) {
  const double length = range.high - range.low;
  const double slack = 1e-9 * length;  // a tick at the end counts though it is rounded
  int power = static_cast<int>(std::floor(std::log10(length / most)));
  const auto count = [&](double step) {
    return std::floor((range.high + slack) / step) - std::ceil((range.low - slack) / step) + 1;
  };
  double step = 0;
  for (; step == 0; ++power)
    for (const int multiple : {1, 2, 5})
      if (step == 0 && count(multiple * std::pow(10, power)) <= most)
        step = multiple * std::pow(10, power);
  const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step * (1 + 1e-9)))));
  Ticks result;
  const double first = std::ceil((range.low - slack) / step);
  for (int i = 0; i < static_cast<int>(count(step)); ++i) {
    result.at.push_back(std::clamp((first + i) * step, range.low, range.high));
    result.labels.push_back(label(result.at.back(), digits));
  }
  return result;
}

}  // namespace articular::tools
