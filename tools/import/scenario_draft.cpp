#include "tools/import/scenario_draft.hpp"

#include <fmt/format.h>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::tools {

const sim::MeshSet* set_called(const ScenarioDraft& draft, const std::string& name, int line) {
  const sim::MeshSet* const set = sim::find_set(draft.mesh, name);
  if (set == nullptr)
    throw sim::InputError(
        {draft.file, line},
        fmt::format("there is no set {}{}", sim::in_ticks(name), sim::known_sets(draft.mesh)));
  return set;
}

std::string new_name(ScenarioDraft& draft, const std::string& wanted) {
  std::string name = wanted;
  for (int k = 2; !draft.names.insert(name).second; ++k) name = fmt::format("{} {}", wanted, k);
  return name;
}

std::string curve_name(const std::string& id) { return "lc" + scenario_name(id); }

CurveLists curve_lists(const sim::Curve& curve, double factor) {
  CurveLists lists;
  for (std::size_t k = 0; k < curve.time.size(); ++k) {
    const char* const comma = k == 0 ? "" : ", ";
    lists.times += comma + toml_quantity(curve.time[k], "s");
    lists.values += fmt::format("{}{}", comma, factor * curve.value[k]);
  }
  return lists;
}

void add_profile(ScenarioDraft& draft, const FebioValue& value, TomlEntry& entry) {
  if (value.curve.empty()) return;
  draft.used_curves.insert(value.curve);
  entry.add("profile", toml_text(curve_name(value.curve)));
}

void add_reaction(ScenarioDraft& draft, std::string_view kind, const std::string& name) {
  draft.probes += TomlEntry("[[probe]]")
                      .add("name", toml_text(name))
                      .add("kind", "\"reaction\"")
                      .add(kind, toml_text(name))
                      .text();
}

void attach(ScenarioDraft& draft, const ImportedBody& tissue, const std::string& to,
            const sim::MeshSet& set) {
  for (const int node : set.nodes) draft.attached[static_cast<std::size_t>(node)] = 1;
  draft.text += TomlEntry("[[attach]]")
                    .add("body", toml_text(tissue.name))
                    .add("to", toml_text(to))
                    .add("region", fmt::format("{{ set = {} }}", toml_text(set.name)))
                    .text();
}

}  // namespace articular::tools
