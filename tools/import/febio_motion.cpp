#include "tools/import/febio_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/base/message_text.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::tools {
namespace {

/// Times of all curves of a drive. What has no curve is reached in the first step.
std::set<double> times_of(const ScenarioDraft& draft, const Drive& drive) {
  std::set<double> times = {0};
  for (const std::optional<FebioValue>& value : drive) {
    if (!value) continue;
    if (value->curve.empty()) {
      times.insert(draft.model.step);
      continue;
    }
    const sim::Curve& curve = draft.model.curves.at(value->curve);
    for (const double t : curve.time)
      if (t > 0) times.insert(t);
  }
  if (times.size() == 1) times.insert(draft.model.step);
  return times;
}

}  // namespace

double value_of(const ScenarioDraft& draft, const std::optional<FebioValue>& value, double t) {
  if (!value) return 0;
  if (value->curve.empty()) return t > 0 ? value->value : 0;
  return value->value * sim::value_at(draft.model.curves.at(value->curve), t);
}

void add_motion(ScenarioDraft& draft, const Moved& moved, const Drive& drive) {
  const auto moves = [&](std::size_t first) {
    return std::any_of(drive.begin() + first, drive.begin() + first + 3,
                       [](const auto& value) { return value && value->value != 0; });
  };
  if (!moves(0) && !moves(3)) return;
  std::string times, ways, turns;
  for (const double t : times_of(draft, drive)) {
    const auto at = [&](std::size_t first) {
      return Eigen::Vector3d(value_of(draft, drive[first], t), value_of(draft, drive[first + 1], t),
                             value_of(draft, drive[first + 2], t));
    };
    const char* const comma = times.empty() ? "" : ", ";
    times += comma + toml_quantity(t, "s");
    ways += comma + toml_vector(at(0), draft.units.length);
    turns += comma + toml_vector(at(3), "rad");
  }
  TomlEntry entry("[[load]]");
  entry.add("kind", "\"motion\"").add(moved.kind, toml_text(moved.name));
  entry.add("time", "[" + times + "]");
  if (moves(0)) entry.add("translation", "[" + ways + "]");
  if (moves(3)) entry.add("rotation", "[" + turns + "]");
  if (moves(3) && moved.about) entry.add("about", toml_vector(*moved.about, draft.units.length));
  if (!moved.has_mass || !draft.model.is_dynamic)
    entry.add("interpolation", "\"linear\"");
  else
    draft.lose(moved.line,
               fmt::format("the constant velocities of the motion of {}: it goes smoothly "
                           "from point to point",
                           sim::in_ticks(moved.name)));
  draft.text += entry.text();
}

}  // namespace articular::tools
