#include "tools/import/febio_node_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "tools/import/febio_motion.hpp"

namespace articular::tools {
namespace {

/// Which condition each node has along each axis: the last one that names it, -1 if there is none.
using ConditionTable = std::vector<std::array<int, 3>>;

bool is_same(const std::optional<FebioValue>& a, const std::optional<FebioValue>& b) {
  if (!a || !b) return !a && !b;
  return a->value == b->value && a->curve == b->curve;
}

bool is_moved(const FebioNodeCondition& condition) {
  return condition.prescribed && condition.prescribed->value != 0;
}

/// Along all three axes, the same of all nodes of the set; empty if it is not so.
std::optional<Drive> drive_of(const ScenarioDraft& draft, const ConditionTable& table,
                              const sim::MeshSet& set) {
  Drive drive;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::optional<std::optional<FebioValue>> common;
    for (const int node : set.nodes) {
      const int c = table[static_cast<std::size_t>(node)][axis];
      if (c < 0) return std::nullopt;
      const FebioNodeCondition& condition =
          draft.model.node_conditions[static_cast<std::size_t>(c)];
      const std::optional<FebioValue> value =
          is_moved(condition) ? condition.prescribed : std::nullopt;
      if (common && !is_same(*common, value)) return std::nullopt;
      common = value;
    }
    if (common) drive[axis] = *common;
  }
  return drive;
}

bool are_attached(const ScenarioDraft& draft, const sim::MeshSet& set) {
  return std::all_of(set.nodes.begin(), set.nodes.end(),
                     [&](int node) { return draft.attached[static_cast<std::size_t>(node)] != 0; });
}

bool is_one_attached(const ScenarioDraft& draft, const sim::MeshSet& set) {
  return std::any_of(set.nodes.begin(), set.nodes.end(),
                     [&](int node) { return draft.attached[static_cast<std::size_t>(node)] != 0; });
}

/// Nodes that are moved along all three axes hang on a fixed body without a shape, which is
/// driven.
void add_grip(ScenarioDraft& draft, const ConditionTable& table,
              const FebioNodeCondition& condition) {
  const sim::MeshSet& set = *set_called(draft, condition.set, condition.line);
  const std::optional<Drive> drive = drive_of(draft, table, set);
  if (!drive || is_one_attached(draft, set)) return;
  const std::string grip = scenario_name("grip of " + set.name);
  draft.text += TomlEntry("[[body]]").add("name", toml_text(grip)).add("kind", "\"fixed\"").text();
  for (const ImportedBody& tissue : draft.bodies)
    if (!tissue.is_rigid() && has_any(tissue, set)) attach(draft, tissue, grip, set);
  add_motion(draft, {"body", grip, Eigen::Vector3d::Zero(), false, condition.line}, *drive);
  add_reaction(draft, "body", grip);
}

/// With a probe of its reaction. @return its name
std::string add_support_entry(ScenarioDraft& draft, const std::string& wanted,
                              const ImportedBody& tissue, const sim::MeshSet& set,
                              const std::string& freedoms) {
  std::string name = new_name(draft, wanted);
  draft.text += TomlEntry("[[support]]")
                    .add("name", toml_text(name))
                    .add("body", toml_text(tissue.name))
                    .add("region", fmt::format("{{ set = {} }}", toml_text(set.name)))
                    .add("freedoms", "[" + freedoms + "]")
                    .text();
  add_reaction(draft, "support", name);
  return name;
}

/// Nodes that are moved along one axis alone.
void add_driven_support(ScenarioDraft& draft, const ConditionTable& table, int index) {
  const FebioNodeCondition& condition =
      draft.model.node_conditions[static_cast<std::size_t>(index)];
  const sim::MeshSet& set = *set_called(draft, condition.set, condition.line);
  if (are_attached(draft, set)) return;  // they hang on a grip
  const auto is_all = [&](const auto& test) {
    return std::all_of(set.nodes.begin(), set.nodes.end(), test);
  };
  const auto axis = static_cast<std::size_t>(condition.axis);
  std::string_view why;
  if (is_one_attached(draft, set))
    why = "some of the nodes go with a rigid body";
  else if (!is_all([&](int node) { return table[static_cast<std::size_t>(node)][axis] == index; }))
    why = "some of the nodes are held or moved along it by another condition";
  else if (value_of(draft, condition.prescribed, 0) != 0)
    why = "it is not 0 at the start";
  if (!why.empty())
    return draft.lose(condition.line, fmt::format("the prescribed displacement of {} along {}: {}",
                                                  sim::in_ticks(set.name), "xyz"[axis], why));
  Drive drive;
  drive[axis] = condition.prescribed;
  const std::string wanted = fmt::format("{} {}", scenario_name(set.name), "xyz"[axis]);
  for (const ImportedBody& tissue : draft.bodies) {
    if (tissue.is_rigid() || !has_any(tissue, set)) continue;
    const std::string name =
        add_support_entry(draft, wanted, tissue, set, fmt::format("\"{}\"", kFreedomWords[axis]));
    add_motion(draft, {"support", name, std::nullopt, false, condition.line}, drive);
  }
}

bool is_one_moved(const ScenarioDraft& draft, const ConditionTable& table, const sim::MeshSet& set,
                  int axis) {
  return std::any_of(set.nodes.begin(), set.nodes.end(), [&](int node) {
    const int c = table[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
    return c >= 0 && is_moved(draft.model.node_conditions[static_cast<std::size_t>(c)]);
  });
}

void add_support(ScenarioDraft& draft, const ConditionTable& table,
                 const FebioNodeCondition& first) {
  const sim::MeshSet& set = *set_called(draft, first.set, first.line);
  if (are_attached(draft, set)) return;  // held by what they hang on
  if (is_one_attached(draft, set))
    return draft.lose(first.line,
                      fmt::format("the held nodes of {}: some of them are moved, or go with a "
                                  "rigid body",
                                  sim::in_ticks(set.name)));
  std::string freedoms;
  for (int axis = 0; axis < 3; ++axis)
    for (const FebioNodeCondition& condition : draft.model.node_conditions) {
      if (condition.set != first.set || condition.axis != axis || is_moved(condition) ||
          freedoms.find(kFreedomWords[axis]) != std::string::npos)
        continue;
      if (is_one_moved(draft, table, set, axis))
        draft.lose(condition.line,
                   fmt::format("the held nodes of {} along {}: some of them are moved "
                               "along it by another condition",
                               sim::in_ticks(set.name), "xyz"[axis]));
      else
        freedoms += fmt::format("{}\"{}\"", freedoms.empty() ? "" : ", ", kFreedomWords[axis]);
    }
  if (freedoms.empty()) return;
  for (const ImportedBody& tissue : draft.bodies) {
    if (tissue.is_rigid() || !has_any(tissue, set)) continue;
    add_support_entry(draft, scenario_name(set.name), tissue, set, freedoms);
  }
}

}  // namespace

void add_node_conditions(ScenarioDraft& draft) {
  const auto& conditions = draft.model.node_conditions;
  ConditionTable table(static_cast<std::size_t>(draft.mesh.X.cols()), {-1, -1, -1});
  for (std::size_t c = 0; c < conditions.size(); ++c)
    for (const int node : set_called(draft, conditions[c].set, conditions[c].line)->nodes)
      table[static_cast<std::size_t>(node)][static_cast<std::size_t>(conditions[c].axis)] =
          static_cast<int>(c);
  std::set<std::string> done;
  for (const FebioNodeCondition& condition : conditions)
    if (is_moved(condition) && done.insert(condition.set).second) add_grip(draft, table, condition);
  for (std::size_t c = 0; c < conditions.size(); ++c)
    if (is_moved(conditions[c])) add_driven_support(draft, table, static_cast<int>(c));
  done.clear();
  for (const FebioNodeCondition& condition : conditions)
    if (!is_moved(condition) && done.insert(condition.set).second)
      add_support(draft, table, condition);
}

}  // namespace articular::tools
