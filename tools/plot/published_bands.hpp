#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/plot/common_x.hpp"
#include "tools/plot/curve_plan.hpp"
#include "tools/plot/figure.hpp"
#include "tools/plot/published_range.hpp"

/// Published ranges, and limits of axes, in the panels that they belong to.
namespace articular::tools {

/// The panels of a limit or a range: those of its dimension, of those that show the named probe.
/// @param option  for messages: "--range"
/// @throws sim::InputError  where there is none
std::vector<std::size_t> panels_meant(const CurvePlan& plan, const std::string& probe,
                                      const AxisUnit& unit, const std::string& option);

/// Adds the bands to their panels, tables first, in the units of `plan`.
/// @param x_range  over which an interval goes
/// @return         what the legend says of them
/// @throws sim::InputError  where a band has no panel, or several and names none
std::vector<LegendEntry> add_bands(const std::vector<BandTable>& tables,
                                   const std::vector<Interval>& intervals, const CurvePlan& plan,
                                   const CommonX& x, const AxisRange& x_range,
                                   std::vector<FigurePanel>& panels);

}  // namespace articular::tools
