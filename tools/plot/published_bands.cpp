#include "tools/plot/published_bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"

namespace articular::tools {
namespace {

/// Without a name there is one panel for it, or none.
std::vector<std::size_t> panels_of_band(const CurvePlan& plan, const std::string& probe,
                                        const AxisUnit& unit) {
  std::vector<std::size_t> meant = panels_meant(plan, probe, unit, "--band");
  if (probe.empty() && meant.size() > 1)
    throw sim::InputError(fmt::format("--band: {} panels show {}: say which as PROBE=...",
                                      meant.size(), sim::noun_of(unit.dimension)));
  return meant;
}

FigureBand drawn_table(const BandTable& band, double x_size, double y_size, std::size_t shade) {
  FigureBand drawn{band.x.values, band.low.values, band.high.values, shade};
  for (double& value : drawn.x) value /= x_size;
  for (double& value : drawn.low) value /= y_size;
  for (double& value : drawn.high) value /= y_size;
  return drawn;
}

}  // namespace

std::vector<std::size_t> panels_meant(const CurvePlan& plan, const std::string& probe,
                                      const AxisUnit& unit, const std::string& option) {
  std::vector<std::size_t> meant, others;
  for (std::size_t p = 0; p < plan.panels.size(); ++p) {
    const std::vector<std::size_t>& columns = plan.panels[p].columns;
    const bool is_named = std::any_of(columns.begin(), columns.end(), [&](std::size_t column) {
      return probe.empty() || means(probe, plan.columns[column].name);
    });
    if (is_named) (plan.units[p].dimension == unit.dimension ? meant : others).push_back(p);
  }
  if (!meant.empty()) return meant;
  if (!probe.empty() && !others.empty())
    require_dimension(unit.dimension, plan.units[others.front()],
                      option + " of " + sim::in_ticks(plan.panels[others.front()].title));
  std::vector<std::string> titles;
  for (const ProbePanel& panel : plan.panels) titles.push_back(panel.title);
  if (probe.empty() && unit.dimension == sim::Dimension{} && !plan.units.empty())
    throw sim::InputError(
        fmt::format("{}: numbers without a unit are given, and no panel shows "
                    "such: {} is in {}",
                    option, sim::in_ticks(titles.front()), sim::one_line(plan.units.front().text)));
  if (probe.empty())
    throw sim::InputError(fmt::format("{}: {} is given, and no panel shows one", option,
                                      sim::noun_of(unit.dimension)));
  throw sim::InputError(fmt::format("{}: no panel shows a probe {}{}", option,
                                    sim::in_quotes(probe), sim::suggestion(probe, titles)));
}

std::vector<LegendEntry> add_bands(const std::vector<BandTable>& tables,
                                   const std::vector<Interval>& intervals, const CurvePlan& plan,
                                   const CommonX& x, const AxisRange& x_range,
                                   std::vector<FigurePanel>& panels) {
  std::vector<LegendEntry> legend;
  std::size_t shade = 0;
  for (const BandTable& band : tables) {
    require_dimension(band.x.unit.dimension, x.unit,
                      fmt::format("--band: column {} of {}", sim::in_ticks(band.x.name),
                                  sim::in_ticks(band.name)));
    for (const std::size_t p : panels_of_band(plan, band.probe, band.low.unit))
      panels[p].bands.push_back(drawn_table(band, x.unit.size, plan.units[p].size, shade));
    legend.push_back({band.name, LegendEntry::Kind::Band, shade++});
  }
  for (const Interval& band : intervals)
    for (const std::size_t p : panels_of_band(plan, band.probe, band.unit)) {
      const double low = band.low / plan.units[p].size, high = band.high / plan.units[p].size;
      panels[p].bands.push_back({{x_range.low, x_range.high}, {low, low}, {high, high}, shade});
    }
  if (!intervals.empty()) legend.push_back({"published range", LegendEntry::Kind::Band, shade});
  return legend;
}

}  // namespace articular::tools
