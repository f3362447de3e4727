#include "tools/import/febio_loads.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_sets.hpp"

namespace articular::tools {
namespace {

/// The force in the file acts on each node, here it is shared by them.
void add_node_load(ScenarioDraft& draft, const FebioNodeLoad& load, const ImportedBody& tissue,
                   const sim::MeshSet& set) {
  const auto count = std::count_if(set.nodes.begin(), set.nodes.end(), [&](int node) {
    return tissue.has_node[static_cast<std::size_t>(node)] != 0;
  });
  TomlEntry entry("[[load]]");
  entry.add("kind", "\"force\"").add("body", toml_text(tissue.name));
  entry.add("region", fmt::format("{{ set = {} }}", toml_text(set.name)));
  entry.add("force", toml_vector(static_cast<double>(count) * load.value.value * load.direction,
                                 draft.units.force));
  add_profile(draft, load.value, entry);
  draft.text += entry.text();
}

void add_surface_load(ScenarioDraft& draft, const FebioSurfaceLoad& load) {
  const sim::MeshSet& set = *set_called(draft, load.surface, load.line);
  bool is_used = false;
  for (const ImportedBody& tissue : draft.bodies) {
    if (tissue.is_rigid() || !has_all(tissue, set)) continue;
    TomlEntry entry("[[load]]");
    entry.add("kind", load.traction ? "\"traction\"" : "\"pressure\"");
    entry.add("body", toml_text(tissue.name));
    entry.add("region", fmt::format("{{ set = {} }}", toml_text(set.name)));
    if (load.traction)
      entry.add("traction", toml_vector(load.value.value * *load.traction, draft.units.stress));
    else
      entry.add("pressure", toml_quantity(load.value.value, draft.units.stress));
    add_profile(draft, load.value, entry);
    draft.text += entry.text();
    is_used = true;
  }
  if (!is_used)
    draft.lose(load.line, fmt::format("the load on {}: it is not the surface of one tissue",
                                      sim::in_ticks(set.name)));
}

}  // namespace

void add_loads(ScenarioDraft& draft) {
  for (const FebioBodyForce& force : draft.model.body_forces) {
    TomlEntry entry("[[load]]");
    entry.add("kind", "\"gravity\"");
    entry.add("acceleration",
              toml_vector(force.value.value * force.acceleration, draft.units.acceleration()));
    add_profile(draft, force.value, entry);
    draft.text += entry.text();
  }
  for (const FebioNodeLoad& load : draft.model.node_loads) {
    const sim::MeshSet& set = *set_called(draft, load.set, load.line);
    for (const ImportedBody& tissue : draft.bodies)
      if (!tissue.is_rigid() && has_any(tissue, set)) add_node_load(draft, load, tissue, set);
  }
  for (const FebioSurfaceLoad& load : draft.model.surface_loads) add_surface_load(draft, load);
}

}  // namespace articular::tools
