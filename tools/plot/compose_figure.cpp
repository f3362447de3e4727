#include "tools/plot/compose_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "tools/plot/axis_unit.hpp"
#include "tools/plot/common_x.hpp"
#include "tools/plot/curve_plan.hpp"
#include "tools/plot/published_bands.hpp"

namespace articular::tools {
namespace {

constexpr double kBarRoom = 0.03;  // of the x range, right of an error bar at its end

/// The least and the largest of what was added.
class Extent {
 public:
  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  bool is_empty() const { return low_ > high_; }
  double size() const { return is_empty() ? 0 : std::max(std::abs(low_), std::abs(high_)); }
  AxisRange range() const { return is_empty() ? AxisRange{0, 1} : AxisRange{low_, high_}; }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

std::string with_unit(const std::string& name, const ShownUnit& unit) {
  if (unit.text.empty()) return name;
  return fmt::format("{}{}[{}]", name, name.empty() ? "" : " ", unit.text);
}

/// The curves, in the units of the plan.
std::vector<FigurePanel> panels_of(const CurvePlan& plan) {
  std::vector<FigurePanel> panels(plan.panels.size());
  for (std::size_t p = 0; p < panels.size(); ++p) panels[p].title = plan.panels[p].title;
  for (const DrawnCurve& curve : plan.curves)
    panels[curve.panel].curves.push_back({curve.pieces, curve.style});
  return panels;
}

/// Error bars at the ends of curves, in the units as written.
void add_bars(const std::vector<PlottedRun>& runs, const CurvePlan& plan,
              std::vector<FigurePanel>& panels, std::vector<std::string>& remarks) {
  for (const DrawnCurve& curve : plan.curves) {
    if (curve.pieces.empty()) continue;
    const PlottedRun& run = runs[curve.run];
    const PlotPoint end = curve.pieces.back().back();
    for (const LastBar& bar : run.bars) {
      if (bar.column != run.columns[curve.column]) continue;
      const std::string what =
          fmt::format("{}: no error bar of {}: ", sim::one_line(run.folder.string()),
                      sim::in_ticks(bar.column.name));
      // Nine digits in both tables; another value is that of another run.
      if (std::abs(bar.value * curve.factor - end.y) > 1e-6 * std::abs(end.y))
        remarks.push_back(what + "error_bars.csv has another last value than history.csv");
      else if (!bar.bar)
        remarks.push_back(what + sim::one_line(bar.verdict));
      else
        panels[curve.panel].bars.push_back({end.x, end.y, *bar.bar * curve.factor, curve.style});
    }
  }
}

/// What --x-range says, else all that the curves have; against a probe with room at both ends.
AxisRange x_range_of(const FigureRequest& request, const CommonX& x,
                     const std::vector<FigurePanel>& panels) {
  if (request.x_range) {
    require_dimension(request.x_range->unit.dimension, x.unit, "--x-range");
    return {request.x_range->low / x.unit.size, request.x_range->high / x.unit.size};
  }
  Extent all;
  bool has_bars = false;
  for (const FigurePanel& panel : panels) {
    has_bars = has_bars || !panel.bars.empty();
    for (const FigureCurve& curve : panel.curves)
      for (const auto& piece : curve.pieces)
        for (const PlotPoint& point : piece) all.add(point.x);
  }
  if (!request.x.empty()) return with_room(all.range());
  AxisRange range = with_length(all.range());
  if (has_bars) range.high += kBarRoom * (range.high - range.low);
  return range;
}

/// All y of a panel that lie within the x range.
Extent y_extent(const FigurePanel& panel, const AxisRange& x) {
  Extent y;
  const auto add = [&](double at, double value) {
    if (at >= x.low && at <= x.high) y.add(value);
  };
  for (const FigureCurve& curve : panel.curves)
    for (const auto& piece : curve.pieces)
      for (const PlotPoint& point : piece) add(point.x, point.y);
  for (const FigureBar& bar : panel.bars)
    for (const double sign : {-1.0, 1.0}) add(bar.x, bar.y + sign * bar.half);
  for (const FigureBand& band : panel.bands)
    for (std::size_t i = 0; i < band.x.size(); ++i) {
      add(band.x[i], band.low[i]);
      add(band.x[i], band.high[i]);
    }
  return y;
}

/// Whether a curve comes into the frame, be it between two of its points.
bool shows_a_curve(const FigurePanel& panel, const AxisRange& x, const AxisRange& y) {
  const auto is_beside = [&](const PlotPoint& p, const PlotPoint& q) {
    return std::max(p.x, q.x) < x.low || std::min(p.x, q.x) > x.high ||
           std::max(p.y, q.y) < y.low || std::min(p.y, q.y) > y.high;
  };
  for (const FigureCurve& curve : panel.curves)
    for (const auto& piece : curve.pieces)
      for (std::size_t i = 0; i < piece.size(); ++i)
        if (!is_beside(piece[i], piece[std::min(i + 1, piece.size() - 1)])) return true;
  return false;
}

/// The limits that --range gives each panel, in its unit.
std::vector<std::optional<AxisRange>> given_ranges(const FigureRequest& request,
                                                   const CurvePlan& plan) {
  std::vector<std::optional<AxisRange>> given(plan.panels.size());
  for (const Interval& range : request.ranges)
    for (const std::size_t p : panels_meant(plan, range.probe, range.unit, "--range"))
      given[p] = {range.low / plan.units[p].size, range.high / plan.units[p].size};
  return given;
}

void scale(FigurePanel& panel, double x, double y) {
  for (FigureCurve& curve : panel.curves)
    for (auto& piece : curve.pieces)
      for (PlotPoint& point : piece) point = {point.x * x, point.y * y};
  for (FigureBar& bar : panel.bars) bar = {bar.x * x, bar.y * y, bar.half * y, bar.style};
  for (FigureBand& band : panel.bands)
    for (std::size_t i = 0; i < band.x.size(); ++i) {
      band.x[i] *= x;
      band.low[i] *= y;
      band.high[i] *= y;
    }
}

/// "area" of "plate.area" and "force.z" of "plate.force.z": the title above has all of it.
std::string short_name(const std::string& title) {
  std::size_t dot = title.rfind('.');
  if (dot == std::string::npos || dot == 0) return title;
  const std::string last = title.substr(dot + 1);
  if (last == "x" || last == "y" || last == "z") dot = title.rfind('.', dot - 1);
  return dot == std::string::npos ? title : title.substr(dot + 1);
}

AxisRange operator*(const AxisRange& range, double factor) {
  return {range.low * factor, range.high * factor};
}

/// Puts a panel into units that make numbers short, and names its axes.
void set_axes(FigurePanel& panel, const std::string& x_name, const ShownUnit& x_unit,
              const AxisRange& x_range, const AxisUnit& written, const AxisRange& y_range) {
  const ShownUnit y_unit = shown_unit(written, size_of(y_range));
  scale(panel, x_unit.factor, y_unit.factor);
  panel.x = {with_unit(x_name, x_unit), "", x_range * x_unit.factor};
  panel.y = {with_unit(short_name(panel.title), y_unit), with_unit("", y_unit),
             y_range * y_unit.factor};
}

/// Runs, or the components of vectors where there is one run.
std::vector<LegendEntry> curve_legend(const FigureRequest& request, const CurvePlan& plan) {
  std::vector<LegendEntry> legend;
  if (request.runs.size() > 1)
    for (std::size_t r = 0; r < request.runs.size(); ++r)
      legend.push_back({request.labels[r], LegendEntry::Kind::Curve, r});
  else if (has_vector(plan.panels))
    for (std::size_t c = 0; c < 3; ++c)
      legend.push_back({std::string(1, "xyz"[c]), LegendEntry::Kind::Curve, c});
  return legend;
}

}  // namespace

ComposedFigure compose_figure(const FigureRequest& request) {
  ComposedFigure composed;
  std::vector<FigurePanel>& panels = composed.figure.panels;
  const CommonX x = common_x(request.runs, request.x);
  const CurvePlan plan = plan_curves(request.runs, request.probes, x, composed.remarks);
  panels = panels_of(plan);
  add_bars(request.runs, plan, panels, composed.remarks);
  const AxisRange x_range = x_range_of(request, x, panels);
  const std::vector<LegendEntry> bands =
      add_bands(request.band_tables, request.bands, plan, x, x_range, panels);
  const std::vector<std::optional<AxisRange>> given = given_ranges(request, plan);
  const ShownUnit x_unit = shown_unit(x.unit, size_of(x_range));
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const AxisRange y_range =
        given[p] ? *given[p] : with_room(y_extent(panels[p], x_range).range());
    if ((given[p] || request.x_range) && !shows_a_curve(panels[p], x_range, y_range))
      composed.remarks.push_back(
          fmt::format("warning: no curve of {} comes into the range that was asked for",
                      sim::in_ticks(panels[p].title)));
    set_axes(panels[p], x.name, x_unit, x_range, plan.units[p], y_range);
  }
  composed.figure.legend = curve_legend(request, plan);
  composed.figure.legend.insert(composed.figure.legend.end(), bands.begin(), bands.end());
  return composed;
}

}  // namespace articular::tools
