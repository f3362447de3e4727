#include "tools/plot/common_x.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"

namespace articular::tools {
namespace {

CommonX load_axis(const std::vector<PlottedRun>& runs) {
  CommonX x{"load", axis_unit("%"), {}, {}};
  for (const PlottedRun& run : runs) {
    x.column.push_back(0);
    x.factor.push_back(100 / run.duration);
  }
  return x;
}

}  // namespace

CommonX common_x(const std::vector<PlottedRun>& runs, const std::string& name) {
  const auto is_load = [](const PlottedRun& run) { return run.is_static && run.duration > 0; };
  if (name.empty() && std::all_of(runs.begin(), runs.end(), is_load)) return load_axis(runs);
  if (name.empty() && std::any_of(runs.begin(), runs.end(), is_load))
    throw sim::InputError(
        "some of these runs are static and go on with the load, others with the time: --x PROBE "
        "plots them against what both have");
  CommonX x{name.empty() ? "time" : name, {}, {}, {}};
  for (const PlottedRun& run : runs) {
    std::vector<std::string> names;
    for (const sim::HistoryColumn& column : run.columns) names.push_back(column.name);
    const std::optional<std::size_t> found = find_column(run, x.name);
    if (!found)
      throw sim::InputError(fmt::format("--x: {} has no column {}{}",
                                        sim::one_line(run.folder.string()), sim::in_quotes(x.name),
                                        sim::suggestion(x.name, names)));
    const AxisUnit unit = unit_of_column(run, *found);
    if (x.column.empty()) x.unit = unit;
    require_dimension(
        unit.dimension, x.unit,
        fmt::format("{}: column {}", sim::one_line(run.folder.string()), sim::in_ticks(x.name)));
    x.column.push_back(*found);
    x.factor.push_back(unit.size / x.unit.size);
  }
  return x;
}

}  // namespace articular::tools
