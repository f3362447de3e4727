#include "tools/import/febio_body_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/febio_mesh.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "sim/scenario/curve.hpp"
#include "tools/import/febio_material.hpp"
#include "tools/import/febio_motion.hpp"

namespace articular::tools {
namespace {

/// Of the mesh; "" if it has none.
std::string fibre_array(const sim::MeshData& mesh) {
  for (const auto& [name, values] : mesh.cell_vectors)
    if (name == "fiber" || name == "mat_axis" || mesh.cell_vectors.size() == 1) return name;
  return {};
}

std::string excitation(ScenarioDraft& draft, const FebioValue& value, int line) {
  sim::Curve curve{{0}, {1}};
  if (!value.curve.empty()) {
    const auto given = draft.model.curves.find(value.curve);
    if (given == draft.model.curves.end())
      throw sim::InputError({draft.file, line},
                            fmt::format("there is no load curve {} that can be taken over",
                                        sim::in_ticks(value.curve)));
    curve = given->second;
  }
  const CurveLists lists = curve_lists(curve, value.value);
  return fmt::format("{{ time = [{}], value = [{}] }}", lists.times, lists.values);
}

bool add_tissue(ScenarioDraft& draft, const ImportedBody& body, const std::string& mesh) {
  const std::optional<MaterialText> material = material_text(
      *body.material, draft.units, fibre_array(draft.mesh), draft.model.is_dynamic, draft.losses);
  if (!material) return false;
  draft.text += TomlEntry("[[body]]")
                    .add("name", toml_text(body.name))
                    .add("kind", "\"tissue\"")
                    .add("mesh", mesh)
                    .add("density", material->density)
                    .add("material", material->table)
                    .text();
  if (material->activation) {
    TomlEntry muscle("[[muscle]]");
    muscle.add("name", toml_text(body.name + " fibres")).add("tissue", toml_text(body.name));
    muscle.add("excitation",
               excitation(draft, *material->activation, body.material->element->line));
    draft.text += muscle.text();
  }
  return true;
}

Eigen::Vector3d center_of_mass(const ScenarioDraft& draft, const ImportedBody& body) {
  const sim::XmlElement* const given = body.material->element->child("center_of_mass");
  return given != nullptr ? sim::febio_vector({draft.file, given->line}, given->text)
                          : center_of(body, draft.mesh);
}

/// FEBio's default is 1.
double density_of(const ScenarioDraft& draft, const ImportedBody& body) {
  const sim::XmlElement* const given = body.material->element->child("density");
  if (given == nullptr) return 1;
  const std::optional<double> density = sim::parse_number(given->text);
  if (!density) throw sim::InputError({draft.file, given->line}, "<density> is no number");
  return *density;
}

void add_rigid_force(ScenarioDraft& draft, const ImportedBody& body, const Eigen::Vector3d& center,
                     const FebioRigidForce& force) {
  TomlEntry entry("[[load]]");
  entry.add("kind", "\"force\"").add("body", toml_text(body.name));
  entry.add("force",
            toml_vector(force.force.value * Eigen::Vector3d::Unit(force.axis), draft.units.force));
  entry.add("point", toml_vector(center, draft.units.length));
  add_profile(draft, force.force, entry);
  draft.text += entry.text();
}

/// A rigid body of which all freedoms are held or moved is fixed here, and may be driven.
bool add_rigid_body(ScenarioDraft& draft, const ImportedBody& body, const std::string& mesh) {
  Drive drive;
  std::array<bool, 6> held{};
  for (const FebioRigidCondition& condition : draft.model.rigid_conditions) {
    if (find_material(draft.model, condition.material) != body.material) continue;
    held[static_cast<std::size_t>(condition.freedom)] = true;
    drive[static_cast<std::size_t>(condition.freedom)] = condition.prescribed;
  }
  if (std::count(held.begin() + 3, held.end(), true) == 1) {
    draft.lose(
        body.material->element->line,
        fmt::format("the one rotation of {} that is held: one alone can't be, and it is free",
                    sim::in_ticks(body.name)));
    for (std::size_t i = 3; i < 6; ++i) held[i] = false;
    for (std::size_t i = 3; i < 6; ++i) drive[i].reset();
  }
  const bool is_fixed = std::all_of(held.begin(), held.end(), [](bool is) { return is; });
  const Eigen::Vector3d center = center_of_mass(draft, body);
  TomlEntry entry("[[body]]");
  entry.add("name", toml_text(body.name)).add("kind", is_fixed ? "\"fixed\"" : "\"rigid\"");
  entry.add("mesh", mesh);
  if (!is_fixed) {
    entry.add("density", toml_quantity(density_of(draft, body), draft.units.density()));
    entry.add("center_of_mass", toml_vector(center, draft.units.length));
    std::string freedoms;
    for (std::size_t i = 0; i < 6; ++i)
      if (held[i])
        freedoms += fmt::format("{}\"{}\"", freedoms.empty() ? "" : ", ", kFreedomWords[i]);
    if (!freedoms.empty())
      entry.add("hold", fmt::format("{{ freedoms = [{}], at = {} }}", freedoms,
                                    toml_vector(center, draft.units.length)));
  }
  draft.text += entry.text();
  add_motion(draft,
             {"body", body.name, is_fixed ? std::optional(center) : std::nullopt, !is_fixed,
              body.material->element->line},
             drive);
  for (const FebioRigidForce& force : draft.model.rigid_forces)
    if (!is_fixed && find_material(draft.model, force.material) == body.material)
      add_rigid_force(draft, body, center, force);
  return true;
}

/// @return whether the scenario has it
bool add_body(ScenarioDraft& draft, const ImportedBody& body) {
  std::string parts;
  for (const std::string& part : body.parts) parts += (parts.empty() ? "" : ", ") + toml_text(part);
  const std::string mesh = fmt::format("{{ file = {}, unit = \"{}\", part = [{}] }}",
                                       toml_text(draft.mesh_file), draft.units.length, parts);
  return body.is_rigid() ? add_rigid_body(draft, body, mesh) : add_tissue(draft, body, mesh);
}

}  // namespace

void add_bodies(ScenarioDraft& draft) {
  for (ImportedBody& body : bodies_of(draft.model, draft.mesh, draft.losses))
    if (add_body(draft, body)) draft.bodies.push_back(std::move(body));
  draft.attached.resize(static_cast<std::size_t>(draft.mesh.X.cols()));
}

void add_attachments(ScenarioDraft& draft) {
  for (const ImportedBody& rigid : draft.bodies) {
    if (!rigid.is_rigid()) continue;
    std::vector<const sim::MeshSet*> sets;
    for (const std::string& part : rigid.parts) sets.push_back(sim::find_set(draft.mesh, part));
    for (const FebioRigidNodes& nodes : draft.model.rigid_nodes)
      if (find_material(draft.model, nodes.material) == rigid.material)
        sets.push_back(set_called(draft, nodes.set, nodes.line));
    for (const ImportedBody& tissue : draft.bodies)
      for (const sim::MeshSet* const set : sets)
        if (!tissue.is_rigid() && has_any(tissue, *set)) attach(draft, tissue, rigid.name, *set);
  }
  for (const FebioRigidNodes& nodes : draft.model.rigid_nodes)
    if (find_material(draft.model, nodes.material) == nullptr)
      draft.lose(nodes.line, fmt::format("nodes of {} that go with a rigid body that is not there",
                                         sim::in_ticks(nodes.set)));
}

}  // namespace articular::tools
