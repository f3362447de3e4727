#include "tools/plot/axis_unit.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"

namespace articular::tools {
namespace {

/// A value at least this large is shown in that unit.
struct Step {
  std::string_view written, shown;
  double size;      // of the unit shown, in that written
  double at_least;  // in the unit written
};

// A knee's load stays 1000 N, and half a second of simulated time becomes 500 ms.
constexpr std::array kSteps{
    Step{"s", "s", 1, 1},        Step{"s", "ms", 1e-3, 1e-4}, Step{"Pa", "GPa", 1e9, 1e9},
    Step{"Pa", "MPa", 1e6, 1e6}, Step{"Pa", "kPa", 1e3, 1e3}, Step{"Pa", "Pa", 1, 1e-2},
    Step{"N", "kN", 1e3, 1e4},   Step{"N", "N", 1, 0.1},      Step{"N", "mN", 1e-3, 1e-4},
    Step{"J", "J", 1, 0.1},      Step{"J", "mJ", 1e-3, 1e-4},
};

// Beyond these a tick label has more digits than fit beside an axis.
constexpr double kLargest = 1e5, kSmallest = 1e-2;

void replace_all(std::string& text, std::string_view old, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
    text.replace(at, old.size(), by);
}

std::string superscript(int number) {
  constexpr std::array<std::string_view, 10> kDigits{"⁰", "¹", "²", "³", "⁴",
                                                     "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number)))
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

/// "mm²" for "mm^2", "N·m" for "N m".
std::string typeset(std::string_view unit) {
  if (unit == "-") return "";
  std::string text(unit);
  for (int power = 9; power >= 0; --power)
    for (const int signed_power : {-power, power})
      replace_all(text, "^" + std::to_string(signed_power), superscript(signed_power));
  replace_all(text, " ", "·");
  return text;
}

}  // namespace

AxisUnit axis_unit(std::string_view text) {
  const std::string written(sim::trimmed(text));
  if (written.empty() || written == "-") return {"-", {}, 1};
  if (written == "%") return {"%", {}, 0.01};
  const sim::MeasuredUnit unit = sim::parse_any_unit(written);
  return {written, unit.dimension, unit.size};
}

void require_dimension(const sim::Dimension& found, const AxisUnit& expected,
                       const std::string& what) {
  if (found == expected.dimension) return;
  throw sim::InputError(fmt::format("{}: expected {}, found {}", what,
                                    sim::noun_of(expected.dimension), sim::noun_of(found)));
}

ShownUnit shown_unit(const AxisUnit& unit, double largest) {
  ShownUnit shown{1, typeset(unit.text)};
  for (const Step& step : kSteps)
    if (step.written == unit.text && largest >= step.at_least) {
      shown = {1 / step.size, std::string(step.shown)};
      break;
    }
  const double most = largest * shown.factor;
  if (!(most > 0) || (most < kLargest && most >= kSmallest)) return shown;
  const int power = 3 * static_cast<int>(std::floor(std::log10(most) / 3));
  shown.factor /= std::pow(10, power);
  shown.text = "10" + superscript(power) + (shown.text.empty() ? "" : " " + shown.text);
  return shown;
}

}  // namespace articular::tools
