#include "tools/study/front_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace articular::tools {
namespace {

/// As shares of the axes of a picture of 900 x 420 pixels with a legend at its side.
constexpr double kDigitWidth = 0.0155, kDigitHeight = 0.04;
constexpr double kPoint = 0.008,
                 kGap = 0.01;  // half the size of a point; from its middle to a number

struct Box {
  double left, right, bottom, top;

  bool meets(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
};

struct Place {
  const char* text;  // for gnuplot
  bool right, above;
};
constexpr std::array<Place, 4> kPlaces{{{"left offset 0.5,0.5", true, true},
                                        {"left offset 0.5,-0.6", true, false},
                                        {"right offset -0.5,0.5", false, true},
                                        {"right offset -0.5,-0.6", false, false}}};

Box number_box(const SharePoint& point, const Place& place, double width) {
  const double left = place.right ? point.x + kGap : point.x - kGap - width;
  const double bottom = place.above ? point.y + kGap : point.y - kGap - kDigitHeight;
  return {left, left + width, bottom, bottom + kDigitHeight};
}

}  // namespace

std::string axis_numbers(char axis, double low, double high) {
  const bool are_few = high < 100 * low;
  std::string numbers;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10, power) <= high;
       ++power)
    for (const int digit : {1, 2, 5}) {
      const double value = digit * std::pow(10, power);
      if (value >= low && value <= high && (digit == 1 || are_few))
        numbers += fmt::format("{}{:.6g}", numbers.empty() ? "" : ", ", value);
    }
  return fmt::format("set {}tics ({})\n", axis, numbers);
}

std::vector<std::string> number_places(const std::vector<SharePoint>& points) {
  std::vector<Box> taken;
  taken.reserve(2 * points.size());
  for (const SharePoint& p : points)
    taken.push_back({p.x - kPoint, p.x + kPoint, p.y - kPoint, p.y + kPoint});
  std::vector<std::string> places;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double width = kDigitWidth * static_cast<double>(std::to_string(n + 1).size());
    const auto is_free = [&](const Place& place) {
      const Box box = number_box(points[n], place, width);
      return std::none_of(taken.begin(), taken.end(),
                          [&](const Box& other) { return box.meets(other); });
    };
    const auto* const found = std::find_if(kPlaces.begin(), kPlaces.end(), is_free);
    const Place& place = found != kPlaces.end() ? *found : kPlaces.front();
    taken.push_back(number_box(points[n], place, width));
    places.emplace_back(place.text);
  }
  return places;
}

}  // namespace articular::tools
