#include "sim/scenario/curve_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/scenario/scenario_reader.hpp"
#include "sim/scenario/toml_walk.hpp"

namespace articular::sim {
namespace {

/// Whether any of its lists changes between or after times that the run does not reach.
bool changes_later(const TomlTable& table, const std::vector<double>& times, double duration) {
  const auto reached = static_cast<std::size_t>(
      std::upper_bound(times.begin(), times.end(), duration) - times.begin());
  const std::size_t last = std::max<std::size_t>(reached, 1) - 1;  // constant before the first time
  return std::ranges::any_of(table.members, [&](const Member& member) {
    const Node::List* values = member.node.list();
    if (member.key == "time" || values == nullptr || values->size() != times.size()) return false;
    const std::string held = plain_text((*values)[last]);
    return std::any_of(values->begin() + static_cast<std::ptrdiff_t>(last), values->end(),
                       [&](const Node& value) { return plain_text(value) != held; });
  });
}

void doubt_later_changes(const Node& node, double duration, std::vector<std::string>& doubts) {
  const Node* time = node.find("time");
  if (time == nullptr || time->list() == nullptr) return;
  const std::vector<double> times = read_times(*time);
  if (times.back() <= duration || !changes_later(*node.table(), times, duration)) return;
  doubts.push_back(prefix(time->where) +
                   fmt::format("{} changes until {:.6g} s, and the run ends at {:.6g} s: what "
                               "comes later is not computed",
                               in_ticks(node.name), times.back(), duration));
}

}  // namespace

std::set<std::string> named_curves(const Node& root) {
  std::set<std::string> names;
  for_each_node(root, [&](const Node& node) {
    if (node.name != "excitation" && node.name != "profile") return;
    for_each_node(node, [&](const Node& part) {
      if (const std::string* text = part.text()) names.insert(*text);
    });
  });
  return names;
}

std::vector<std::string> unnamed_curve_doubts(const Node& root,
                                              const std::set<std::string>& named) {
  std::vector<std::string> doubts;
  if (const Node* curves = root.find("curve"); curves != nullptr && curves->table() != nullptr)
    for (const Member& curve : curves->table()->members)
      if (!named.contains(curve.key))
        doubts.push_back(
            prefix(curve.key_where) +
            fmt::format("no `excitation` or `profile` names the curve {}: it has no effect",
                        in_ticks(curve.key)));
  return doubts;
}

std::vector<std::string> cut_off_doubts(const Node& root, double duration) {
  std::vector<std::string> doubts;
  const auto doubt = [&](const Node& node) { doubt_later_changes(node, duration, doubts); };
  const std::set<std::string> named = named_curves(root);
  for (const Member& member : root.table()->members) {
    if (member.key != "curve") {
      for_each_node(member.node, doubt);
      continue;
    }
    for (const Member& curve : member.node.table()->members)
      if (named.contains(curve.key)) doubt(curve.node);
  }
  return doubts;
}

}  // namespace articular::sim
