#include "tools/render/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "sim/scenario/quantity.hpp"
#include "tools/render/nearest.hpp"
#include "tools/render/survey.hpp"

namespace articular::tools {
namespace {

/// The name of an array as words.
std::string title_of(const Survey& survey) {
  static const std::map<std::string, std::string> kTitles = {{"von_mises", "von Mises stress"},
                                                             {"activation", "muscle activation"},
                                                             {"force", "tension of lines"},
                                                             {"length", "length of lines"}};
  std::string title = survey.field;
  const auto known = kTitles.find(title);
  if (known != kTitles.end() && (survey.of_lines || title == "von_mises")) return known->second;
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

bool has_no_unit(const std::string& unit) { return unit.empty() || unit == "-" || unit == "1"; }

/// Large values in a larger unit.
void choose_unit(const std::string& unit, double reach, ColourScale& scale) {
  scale.unit = has_no_unit(unit) ? "" : unit;
  static const std::map<std::string, std::pair<std::string, std::string>> kLarger = {
      {"Pa", {"kPa", "MPa"}}, {"J/m^3", {"kJ/m^3", "MJ/m^3"}}};
  const auto larger = kLarger.find(unit);
  if (larger == kLarger.end() || reach < 1e3) return;
  scale.factor = reach < 1e6 ? 1e-3 : 1e-6;
  scale.unit = reach < 1e6 ? larger->second.first : larger->second.second;
}

struct End {
  double number = 0;
  std::string unit;
};

End parse_end(const std::string& text, const std::string& unit) {
  End end;
  char* rest = nullptr;
  end.number = std::strtod(text.c_str(), &rest);
  if (rest == text.c_str() || !std::isfinite(end.number))
    throw sim::InputError("--range: expected a number" +
                          std::string(has_no_unit(unit) ? "" : " with its unit") + ", not `" +
                          text + "`");
  while (*rest == ' ') ++rest;
  end.unit = rest;
  return end;
}

/// How many of the file's units one of this unit is.
double size_in(const std::string& file_unit, const std::string& unit, const std::string& field) {
  const std::string expected = "--range: " + field + " is in " + file_unit + "; ";
  try {
    const sim::MeasuredUnit of_file = sim::parse_any_unit(file_unit),
                            asked = sim::parse_any_unit(unit);
    if (of_file.dimension == asked.dimension) return asked.size / of_file.size;
  } catch (const std::invalid_argument& error) {
    throw sim::InputError(expected + error.what());
  }
  throw sim::InputError(expected + "expected such a unit, not `" + unit + "`");
}

void apply_range(const AskedRange& asked, const Survey& survey, ColourScale& scale, double& low,
                 double& high) {
  const End first = parse_end(asked.low, survey.unit), last = parse_end(asked.high, survey.unit);
  const std::string unit = last.unit.empty() ? first.unit : last.unit;
  low = first.number;
  high = last.number;
  if (has_no_unit(survey.unit)) {
    if (!first.unit.empty() || !last.unit.empty())
      throw sim::InputError("--range: " + survey.field + " has no unit; expected numbers alone");
  } else {
    for (const End& end : {first, last})
      if (end.unit.empty() && end.number != 0)
        throw sim::InputError(
            fmt::format("--range {:g}: {} is in {}; expected a number with its "
                        "unit, e.g. \"{:g} {}\"",
                        end.number, survey.field, survey.unit, end.number, survey.unit));
    if (!unit.empty()) {
      const double size = size_in(survey.unit, unit, survey.field);
      if (!first.unit.empty()) low *= size_in(survey.unit, first.unit, survey.field) / size;
      scale.factor = 1 / size;
      scale.unit = unit;
    }
  }
  if (!(low < high))
    throw sim::InputError("--range " + asked.low + " " + asked.high +
                          ": expected the low end first, then a higher one");
}

const ColourMap& chosen_map(const std::string& asked, bool two_sided) {
  const auto& maps = colour_maps();
  const auto found = maps.find(asked.empty() ? (two_sided ? "blue-red" : "viridis") : asked);
  if (found != maps.end()) return found->second;
  std::set<std::string> names;
  for (const auto& [name, map] : maps) names.insert(name);
  throw sim::InputError("--colour-map: " + unknown_name("colour map", asked, names));
}

}  // namespace

ColourScale field_scale(const Survey& survey, const std::optional<AskedRange>& range,
                        const std::string& map) {
  // Round-off and overshoot beyond rest are said in the legend, and take no half of the colours.
  constexpr double kHardly = 0.02;
  const bool two_sided =
      survey.is_difference ||
      survey.rest - survey.lowest > kHardly * std::max(0.0, survey.highest - survey.rest);
  const ColourMap& colours = chosen_map(map, two_sided);
  ColourScale scale;
  scale.title = (survey.is_difference ? "difference of " : "") + title_of(survey);
  scale.has_blank = survey.has_blank;
  const double largest =
      std::max(std::abs(survey.lowest - survey.rest), std::abs(survey.highest - survey.rest));
  // One peak must not take all colours for itself; if it is not far above the rest, it may.
  double reach = largest > 1.5 * survey.high_percentile ? survey.high_percentile : largest;
  choose_unit(survey.unit, reach, scale);
  reach = round_up(reach * scale.factor);
  double low = survey.rest * scale.factor - (two_sided ? reach : 0),
         high = survey.rest * scale.factor + reach;
  if (range) apply_range(*range, survey, scale, low, high);
  scale.colours = colour_table(colours, low, high);
  const double slack = 1e-9 * (high - low);  // round-off of the units
  if (survey.lowest * scale.factor < low - slack) scale.lowest_below = survey.lowest * scale.factor;
  if (survey.highest * scale.factor > high + slack)
    scale.highest_above = survey.highest * scale.factor;
  return scale;
}

ColourScale activation_scale() {
  ColourScale scale;
  scale.title = "muscle activation";
  scale.colours = colour_table(muscle_colours(), 0, 1);
  return scale;
}

ColourScale tension_scale(double highest) {
  ColourScale scale;
  scale.title = "ligament tension";
  scale.unit = "N";
  scale.colours = colour_table(ligament_colours(), 0, round_up(highest));
  return scale;
}

std::string range_text(const ColourScale& scale) {
  const double* const range = scale.colours->GetRange();
  return fmt::format("{:g} to {:g}{}{}", range[0], range[1], scale.unit.empty() ? "" : " ",
                     scale.unit);
}

double round_up(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (factor * power >= value * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace articular::tools
