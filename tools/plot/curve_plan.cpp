#include "tools/plot/curve_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"

namespace articular::tools {
namespace {

constexpr std::size_t kMostPanels = 300;  // a page of 5 m is what PDF allows

/// All columns but the time and that on the x axis, in the order in which they first appear.
std::vector<sim::HistoryColumn> union_of(const std::vector<PlottedRun>& runs,
                                         const std::string& x) {
  std::vector<sim::HistoryColumn> all;
  for (const PlottedRun& run : runs)
    for (std::size_t i = 1; i < run.columns.size(); ++i) {
      const sim::HistoryColumn& column = run.columns[i];
      const auto is_it = [&](const sim::HistoryColumn& one) { return one.name == column.name; };
      if (column.name != x && std::none_of(all.begin(), all.end(), is_it)) all.push_back(column);
    }
  return all;
}

CurvePlan make_plan(const std::vector<PlottedRun>& runs, const std::vector<std::string>& probes,
                    const CommonX& x, std::vector<std::string>& remarks) {
  CurvePlan plan;
  plan.columns = union_of(runs, x.name);
  std::vector<std::string> names;
  for (const sim::HistoryColumn& column : plan.columns) names.push_back(column.name);
  if (names.empty()) throw sim::InputError("these runs have no probes to plot");
  const bool is_single = runs.size() == 1;
  plan.panels = probe_panels(plan.columns, chosen_columns(names, probes), is_single);
  const bool names_components = is_single && has_vector(plan.panels);
  for (std::size_t p = 0; p < plan.panels.size(); ++p) {
    const ProbePanel& panel = plan.panels[p];
    plan.units.emplace_back();
    bool has_unit = false;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const PlottedRun& run = runs[r];
      const std::string folder = sim::one_line(run.folder.string());
      for (std::size_t c = 0; c < panel.columns.size(); ++c) {
        const std::string& name = plan.columns[panel.columns[c]].name;
        const std::optional<std::size_t> found = find_column(run, name);
        if (!found) {
          remarks.push_back(fmt::format("{} has no {}", folder, sim::in_ticks(name)));
          continue;
        }
        const AxisUnit unit = unit_of_column(run, *found);
        if (!has_unit) plan.units[p] = unit;
        has_unit = true;
        require_dimension(unit.dimension, plan.units[p],
                          folder + ": column " + sim::in_ticks(name));
        const std::size_t style = names_components ? component_of(name) : r;
        plan.curves.push_back({p, r, style, unit.size / plan.units[p].size, *found, {}});
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
void leave_zeros_out(CurvePlan& plan, std::vector<std::string>& remarks) {
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
      left_out += (left_out.empty() ? "" : ", ") + sim::in_ticks(plan.panels[p].title);
    }
  }
  std::erase_if(plan.curves, [&](const DrawnCurve& curve) { return !is_shown[curve.panel]; });
  for (DrawnCurve& curve : plan.curves) curve.panel = place[curve.panel];
  plan.panels = std::move(panels);
  plan.units = std::move(units);
  if (!left_out.empty())
    remarks.push_back("0 in all rows, so drawn only where it is named: " + left_out);
}

void check_number(const CurvePlan& plan) {
  if (plan.panels.size() <= kMostPanels) return;
  std::vector<std::string> titles;
  for (const ProbePanel& panel : plan.panels) titles.push_back(panel.title);
  throw sim::InputError(
      fmt::format("these are {} panels, and a page holds {}: choose some by their names{}",
                  plan.panels.size(), kMostPanels, sim::suggestion("", titles)));
}

void read_plan(const std::vector<PlottedRun>& runs, const CommonX& x, CurvePlan& plan,
               std::vector<std::string>& remarks) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const PlottedRun& run = runs[r];
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
                                      sim::in_ticks(run.columns[curve.column].name)));
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

}  // namespace

CurvePlan plan_curves(const std::vector<PlottedRun>& runs, const std::vector<std::string>& probes,
                      const CommonX& x, std::vector<std::string>& remarks) {
  CurvePlan plan = make_plan(runs, probes, x, remarks);
  read_plan(runs, x, plan, remarks);
  if (probes.empty()) leave_zeros_out(plan, remarks);
  check_number(plan);
  return plan;
}

}  // namespace articular::tools
