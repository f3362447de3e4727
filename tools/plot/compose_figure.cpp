#include "tools/plot/compose_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "tools/plot/axis_unit.hpp"

namespace articular::tools {
namespace {

constexpr std::size_t kMostPanels = 80;
constexpr double kBarRoom = 0.03;  // of the x range, right of an error bar at its end

std::string in_ticks(const std::string& name) { return "`" + sim::one_line(name) + "`"; }

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

AxisUnit unit_of(const HistoryColumn& column, const PlottedRun& run) {
  try {
    return axis_unit(column.unit);
  } catch (const std::invalid_argument& error) {
    throw sim::InputError({sim::one_line((run.folder / "history.csv").string()), 1},
                          fmt::format("column {}: {}", in_ticks(column.name), error.what()));
  }
}

void require(const sim::Dimension& found, const AxisUnit& expected, const std::string& what) {
  if (found == expected.dimension) return;
  throw sim::InputError(fmt::format("{}: expected {}, found {}", what,
                                    sim::noun_of(expected.dimension), sim::noun_of(found)));
}

std::string with_unit(const std::string& name, const ShownUnit& unit) {
  if (unit.text.empty()) return name;
  return fmt::format("{}{}[{}]", name, name.empty() ? "" : " ", unit.text);
}

/// The axis that all panels have below them. In statics the time counts the load, and is shown as
/// its part in per cent.
struct CommonX {
  std::string name;
  AxisUnit unit;                    // of the first run
  std::vector<std::size_t> column;  // of each run
  std::vector<double> factor;       // from each run's column to `unit`
};

CommonX load_axis(const std::vector<PlottedRun>& runs) {
  CommonX x{"load", axis_unit("%"), {}, {}};
  for (const PlottedRun& run : runs) {
    x.column.push_back(0);
    x.factor.push_back(100 / run.duration);
  }
  return x;
}

CommonX common_x(const FigureRequest& request) {
  const std::vector<PlottedRun>& runs = request.runs;
  const auto is_load = [](const PlottedRun& run) { return run.is_static && run.duration > 0; };
  if (request.x.empty() && std::all_of(runs.begin(), runs.end(), is_load)) return load_axis(runs);
  if (request.x.empty() && std::any_of(runs.begin(), runs.end(), is_load))
    throw sim::InputError(
        "some of these runs are static and go on with the load, others with the time: --x PROBE "
        "plots them against what both have");
  CommonX x{request.x.empty() ? "time" : request.x, {}, {}, {}};
  for (const PlottedRun& run : runs) {
    std::vector<std::string> names;
    for (const HistoryColumn& column : run.columns) names.push_back(column.name);
    const std::optional<std::size_t> found = find_column(run, x.name);
    if (!found)
      throw sim::InputError(fmt::format("--x: {} has no column {}{}",
                                        sim::one_line(run.folder.string()), sim::in_quotes(x.name),
                                        sim::suggestion(x.name, names)));
    const AxisUnit unit = unit_of(run.columns[*found], run);
    if (x.column.empty()) x.unit = unit;
    require(unit.dimension, x.unit,
            fmt::format("{}: column {}", sim::one_line(run.folder.string()), in_ticks(x.name)));
    x.column.push_back(*found);
    x.factor.push_back(unit.size / x.unit.size);
  }
  return x;
}

/// All columns but the time and that on the x axis, in the order in which they first appear.
std::vector<HistoryColumn> union_of(const std::vector<PlottedRun>& runs, const std::string& x) {
  std::vector<HistoryColumn> all;
  for (const PlottedRun& run : runs)
    for (std::size_t i = 1; i < run.columns.size(); ++i) {
      const HistoryColumn& column = run.columns[i];
      const auto is_it = [&](const HistoryColumn& one) { return one.name == column.name; };
      if (column.name != x && std::none_of(all.begin(), all.end(), is_it)) all.push_back(column);
    }
  return all;
}

/// One curve of a panel with what it was read from, in the units of the panel as written.
struct DrawnCurve {
  std::size_t panel = 0, run = 0, style = 0;
  double factor = 1;       // of y, from the run's unit to that of the panel
  std::size_t column = 0;  // of the run
  std::vector<std::vector<PlotPoint>> pieces;
};

struct Plan {
  std::vector<HistoryColumn> columns;
  std::vector<ProbePanel> panels;
  std::vector<AxisUnit> units;  // of the panels
  std::vector<DrawnCurve> curves;
};

Plan make_plan(const FigureRequest& request, std::vector<std::string>& remarks) {
  Plan plan;
  plan.columns = union_of(request.runs, request.x);
  std::vector<std::string> names;
  for (const HistoryColumn& column : plan.columns) names.push_back(column.name);
  if (names.empty()) throw sim::InputError("these runs have no probes to plot");
  const bool is_single = request.runs.size() == 1;
  plan.panels = probe_panels(plan.columns, chosen_columns(names, request.probes), is_single);
  for (std::size_t p = 0; p < plan.panels.size(); ++p) {
    const ProbePanel& panel = plan.panels[p];
    plan.units.emplace_back();
    bool has_unit = false;
    for (std::size_t r = 0; r < request.runs.size(); ++r) {
      const PlottedRun& run = request.runs[r];
      const std::string folder = sim::one_line(run.folder.string());
      for (std::size_t c = 0; c < panel.columns.size(); ++c) {
        const std::string& name = plan.columns[panel.columns[c]].name;
        const std::optional<std::size_t> found = find_column(run, name);
        if (!found) {
          remarks.push_back(fmt::format("{} has no {}", folder, in_ticks(name)));
          continue;
        }
        const AxisUnit unit = unit_of(run.columns[*found], run);
        if (!has_unit) plan.units[p] = unit;
        has_unit = true;
        require(unit.dimension, plan.units[p], folder + ": column " + in_ticks(name));
        plan.curves.push_back(
            {p, r, is_single ? c : r, unit.size / plan.units[p].size, *found, {}});
      }
    }
  }
  return plan;
}

bool is_zero(const DrawnCurve& curve) {
  for (const auto& piece : curve.pieces)
    for (const PlotPoint& point : piece)
      if (point.y != 0) return false;
  return !curve.pieces.empty();
}

/// Takes out panels of which all curves stay 0, as energies of what a scene doesn't have. Where
/// there is nothing else, nothing is taken out.
void leave_zeros_out(Plan& plan, std::vector<std::string>& remarks) {
  std::vector<bool> is_shown(plan.panels.size(), false);
  for (const DrawnCurve& curve : plan.curves)
    if (!is_zero(curve)) is_shown[curve.panel] = true;
  if (std::count(is_shown.begin(), is_shown.end(), true) == 0) return;
  std::vector<std::size_t> place(plan.panels.size());
  std::vector<ProbePanel> panels;
  std::vector<AxisUnit> units;
  std::string left_out;
  for (std::size_t p = 0; p < plan.panels.size(); ++p) {
    place[p] = panels.size();
    if (is_shown[p]) {
      panels.push_back(plan.panels[p]);
      units.push_back(plan.units[p]);
    } else {
      left_out += (left_out.empty() ? "" : ", ") + in_ticks(plan.panels[p].title);
    }
  }
  std::erase_if(plan.curves, [&](const DrawnCurve& curve) { return !is_shown[curve.panel]; });
  for (DrawnCurve& curve : plan.curves) curve.panel = place[curve.panel];
  plan.panels = std::move(panels);
  plan.units = std::move(units);
  if (!left_out.empty())
    remarks.push_back("0 in all rows, so drawn only where it is named: " + left_out);
}

void check_number(const Plan& plan) {
  if (plan.panels.size() <= kMostPanels) return;
  std::vector<std::string> titles;
  for (const ProbePanel& panel : plan.panels) titles.push_back(panel.title);
  throw sim::InputError(
      fmt::format("these are {} panels, and a page holds {}: choose some by their names{}",
                  plan.panels.size(), kMostPanels, sim::suggestion("", titles)));
}

void read_plan(const FigureRequest& request, const CommonX& x, Plan& plan,
               std::vector<std::string>& remarks) {
  for (std::size_t r = 0; r < request.runs.size(); ++r) {
    const PlottedRun& run = request.runs[r];
    const std::string folder = sim::one_line(run.folder.string());
    std::vector<std::size_t> columns;
    for (const DrawnCurve& curve : plan.curves)
      if (curve.run == r) columns.push_back(curve.column);
    const RunCurves read = read_curves(run, x.column[r], columns);
    std::size_t next = 0;
    for (DrawnCurve& curve : plan.curves) {
      if (curve.run != r) continue;
      curve.pieces = read.curves[next++].pieces();
      for (auto& piece : curve.pieces)
        for (PlotPoint& point : piece) point = {point.x * x.factor[r], point.y * curve.factor};
      if (curve.pieces.empty())
        remarks.push_back(fmt::format("{}: {} has no value in any row", folder,
                                      in_ticks(run.columns[curve.column].name)));
    }
    if (read.is_torn)
      remarks.push_back(
          fmt::format("{}: the last line of history.csv has no end and is left out", folder));
    if (run.outcome != "finished")
      remarks.push_back(
          fmt::format("{}: the run is not finished ({}); its curves end where it is", folder,
                      run.outcome.empty() ? "it has no summary.json" : sim::one_line(run.outcome)));
  }
}

/// Where a band or a limit is meant: panels of its dimension, of those that show the named probe.
std::vector<std::size_t> panels_meant(const Plan& plan, const std::string& probe,
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
    require(unit.dimension, plan.units[others.front()],
            option + " of " + in_ticks(plan.panels[others.front()].title));
  std::vector<std::string> titles;
  for (const ProbePanel& panel : plan.panels) titles.push_back(panel.title);
  if (probe.empty())
    throw sim::InputError(fmt::format("{}: {} is given, and no panel shows one", option,
                                      sim::noun_of(unit.dimension)));
  throw sim::InputError(fmt::format("{}: no panel shows a probe {}{}", option,
                                    sim::in_quotes(probe), sim::suggestion(probe, titles)));
}

/// Of published ranges: one that belongs to nothing named belongs to the only panel.
std::vector<std::size_t> panels_of_band(const Plan& plan, const std::string& probe,
                                        const AxisUnit& unit) {
  std::vector<std::size_t> meant = panels_meant(plan, probe, unit, "--band");
  if (probe.empty() && meant.size() > 1)
    throw sim::InputError(fmt::format("--band: {} panels show {}: say which as PROBE=...",
                                      meant.size(), sim::noun_of(unit.dimension)));
  return meant;
}

/// Error bars at the ends of curves, in the units as written.
void add_bars(const FigureRequest& request, const Plan& plan, std::vector<FigurePanel>& panels,
              std::vector<std::string>& remarks) {
  for (const DrawnCurve& curve : plan.curves) {
    if (curve.pieces.empty()) continue;
    const PlottedRun& run = request.runs[curve.run];
    const PlotPoint end = curve.pieces.back().back();
    for (const LastBar& bar : run.bars) {
      if (bar.column != run.columns[curve.column]) continue;
      const std::string what =
          fmt::format("{}: no error bar of {}: ", sim::one_line(run.folder.string()),
                      in_ticks(bar.column.name));
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

/// "area" of "plate.area" and "force.z" of "plate.force.z": the title above has all of it.
std::string short_name(const std::string& title) {
  std::size_t dot = title.rfind('.');
  if (dot == std::string::npos || dot == 0) return title;
  const std::string last = title.substr(dot + 1);
  if (last == "x" || last == "y" || last == "z") dot = title.rfind('.', dot - 1);
  return dot == std::string::npos ? title : title.substr(dot + 1);
}

}  // namespace

ComposedFigure compose_figure(const FigureRequest& request) {
  ComposedFigure composed;
  std::vector<FigurePanel>& panels = composed.figure.panels;

  // 1. What is drawn where, and the curves, in units as written.
  const CommonX x = common_x(request);
  Plan plan = make_plan(request, composed.remarks);
  read_plan(request, x, plan, composed.remarks);
  if (request.probes.empty()) leave_zeros_out(plan, composed.remarks);
  check_number(plan);
  panels.resize(plan.panels.size());
  Extent all_x;
  for (const DrawnCurve& curve : plan.curves) {
    panels[curve.panel].curves.push_back({curve.pieces, curve.style});
    for (const auto& piece : curve.pieces)
      for (const PlotPoint& point : piece) all_x.add(point.x);
  }
  add_bars(request, plan, panels, composed.remarks);

  // 2. The x axis, and what is published over it.
  AxisRange x_range = request.x.empty() ? with_length(all_x.range()) : with_room(all_x.range());
  const auto has_bars = [](const FigurePanel& panel) { return !panel.bars.empty(); };
  if (request.x.empty() && std::any_of(panels.begin(), panels.end(), has_bars))
    x_range.high += kBarRoom * (x_range.high - x_range.low);
  if (request.x_range) {
    require(request.x_range->unit.dimension, x.unit, "--x-range");
    x_range = {request.x_range->low / x.unit.size, request.x_range->high / x.unit.size};
  }
  std::size_t shade = 0;
  std::vector<LegendEntry> legend_bands;
  for (const BandTable& band : request.band_tables) {
    require(band.x.unit.dimension, x.unit,
            fmt::format("--band: column {} of {}", in_ticks(band.x.name), in_ticks(band.name)));
    for (const std::size_t p : panels_of_band(plan, band.probe, band.low.unit)) {
      FigureBand drawn{band.x.values, band.low.values, band.high.values, shade};
      for (double& value : drawn.x) value /= x.unit.size;
      for (double& value : drawn.low) value /= plan.units[p].size;
      for (double& value : drawn.high) value /= plan.units[p].size;
      panels[p].bands.push_back(std::move(drawn));
    }
    legend_bands.push_back({band.name, LegendEntry::Kind::Band, shade++});
  }
  for (const Interval& band : request.bands) {
    for (const std::size_t p : panels_of_band(plan, band.probe, band.unit)) {
      const double low = band.low / plan.units[p].size, high = band.high / plan.units[p].size;
      panels[p].bands.push_back({{x_range.low, x_range.high}, {low, low}, {high, high}, shade});
    }
  }
  if (!request.bands.empty())
    legend_bands.push_back({"published range", LegendEntry::Kind::Band, shade});

  // 3. Ranges, and units that make numbers short.
  const double x_size = std::max(std::abs(x_range.low), std::abs(x_range.high));
  const ShownUnit x_unit = shown_unit(x.unit, x_size);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    FigurePanel& panel = panels[p];
    const Extent seen = y_extent(panel, x_range);
    AxisRange y_range = with_room(seen.range());
    for (const Interval& range : request.ranges)
      for (const std::size_t meant : panels_meant(plan, range.probe, range.unit, "--range"))
        if (meant == p) y_range = {range.low / plan.units[p].size, range.high / plan.units[p].size};
    const ShownUnit y_unit =
        shown_unit(plan.units[p], std::max(std::abs(y_range.low), std::abs(y_range.high)));
    scale(panel, x_unit.factor, y_unit.factor);
    panel.title = plan.panels[p].title;
    panel.x = {
        with_unit(x.name, x_unit), "", {x_range.low * x_unit.factor, x_range.high * x_unit.factor}};
    panel.y = {with_unit(short_name(panel.title), y_unit),
               with_unit("", y_unit),
               {y_range.low * y_unit.factor, y_range.high * y_unit.factor}};
  }

  // 4. The legend: components of vectors, or runs.
  std::vector<LegendEntry>& legend = composed.figure.legend;
  const bool has_vector = std::any_of(plan.panels.begin(), plan.panels.end(),
                                      [](const ProbePanel& p) { return p.columns.size() == 3; });
  if (request.runs.size() > 1)
    for (std::size_t r = 0; r < request.runs.size(); ++r)
      legend.push_back({request.labels[r], LegendEntry::Kind::Curve, r});
  else if (has_vector)
    for (std::size_t c = 0; c < 3; ++c)
      legend.push_back({std::string(1, "xyz"[c]), LegendEntry::Kind::Curve, c});
  legend.insert(legend.end(), legend_bands.begin(), legend_bands.end());
  return composed;
}

}  // namespace articular::tools
