#include "sim/scenario/scenario.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "sim/scenario/curve_doubts.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/excitation_table.hpp"
#include "sim/scenario/scenario_choices.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"
#include "sim/scenario/toml_override.hpp"
#include "sim/scenario/toml_walk.hpp"

namespace articular::sim {
namespace {

/// frames/BODY_contact_000000.vtp must not be a body's own file.
void check_names_of_contact_surfaces(const std::vector<Body>& bodies) {
  std::unordered_map<std::string, const Body*> by_name;
  for (const Body& body : bodies) by_name[body.name] = &body;
  for (const Body& body : bodies)
    if (const auto other = by_name.find(body.name + "_contact"); other != by_name.end())
      throw InputError(other->second->where,
                       fmt::format("body `{}` has the name of the contact surface "
                                   "of `{}` in the results; expected another name, "
                                   "or no output.contact_surfaces",
                                   other->first, body.name));
}

/// Inertia would have to give it an impulse at each of its times.
void check_motions_of_masses(const Scenario& scenario) {
  for (const Load& load : scenario.loads) {
    const auto* driven = std::get_if<MotionLoad>(&load);
    if (driven == nullptr || driven->motion.interpolation != Motion::Interpolation::Linear)
      continue;
    const auto is_driven = [&](const Body& body) {
      return body.name == driven->body && body.kind == Body::Kind::Rigid;
    };
    if (std::any_of(scenario.bodies.begin(), scenario.bodies.end(), is_driven))
      throw InputError(
          driven->where,
          fmt::format("body `{}` has a mass, whose velocity can't jump as with "
                      "`interpolation` \"linear\"; expected \"smooth\" or \"spline\", or a "
                      "static analysis",
                      driven->body));
  }
}

/// TOML has no way back from a [table] to the keys above it: a setting at the end of the file is a
/// key of the last one.
void refuse_settings_below_tables(const Node& root) {
  constexpr std::string_view kSettings[] = {
      "title",  "duration", "analysis", "accuracy", "contact_response", "contact_stiffness_factor",
      "contact"};
  const auto check = [&](const Node& node, const std::string& name) {
    if (node.table() == nullptr) return;
    for (const Member& member : node.table()->members)
      if (std::find(std::begin(kSettings), std::end(kSettings), member.key) != std::end(kSettings))
        throw InputError(member.key_where,
                         fmt::format("`{}` is no key of {} but of the scenario: expected it above "
                                     "the first [table] of the file",
                                     member.key, name));
  };
  for (const Member& member : root.table()->members) {
    if (member.key == "choice" || member.key == "curve") continue;  // their keys are the user's
    check(member.node, "[" + member.key + "]");
    if (const Node::List* list = member.node.list())
      for (const Node& entry : *list) check(entry, "[[" + member.key + "]]");
  }
}

/// Whatever names a file has the key `file`.
std::vector<std::filesystem::path> files_of(const Node& root, const std::filesystem::path& file) {
  std::vector<std::filesystem::path> files;
  const auto take = [&](const Node& node) {
    if (node.name == "file" && node.text() != nullptr)
      files.push_back(read_path(node, file.parent_path()));
  };
  for (const Member& member : root.table()->members)
    if (member.key != "choice") for_each_node(member.node, take);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  files.insert(files.begin(), file);
  return files;
}

bool sets_the_duration(const Override& change) {
  return change.path == std::vector<std::string>{"duration"};
}

}  // namespace

const KeyTable& scenario_keys() {
  static const KeyTable kTable = [] {
    KeyTable table{"scenario", settings_keys()};
    const auto add = [&](std::string_view name, const KeyType& type, std::string_view meaning) {
      table.keys.push_back({name, type, kNone, meaning});
    };
    add("choice", {form::Map{"name of a choice", {{form::Text{"word"}}}}},
        "the variant of this file that holds: entries with `when` go by it");
    add("curve", {form::Map{"name of a curve", {{form::Table{curve_keys}}}}},
        "curves that several entries name, as `[curve.NAME]`");
    table.keys.push_back({"body",
                          {conditional_entries_of({form::Table{body_keys}})},
                          kRequired,
                          "tissues and bones"});
    add("attach", {conditional_entries_of({form::Table{attach_keys}})},
        "tissue nodes that a bone carries");
    add("support", {conditional_entries_of({form::Table{support_keys}})},
        "tissue nodes on rollers, or drawn along");
    add("sheet", {conditional_entries_of({form::Table{sheet_keys}})},
        "thin sheets of fibres on the surface of a tissue: aponeuroses, fasciae, capsules");
    add("muscle", {conditional_entries_of({form::Table{muscle_keys}})}, "muscles");
    add("muscle_table", {conditional_entries_of({form::Table{muscle_table_keys}})},
        "muscles of a table");
    add("excitations", {form::Table{excitations_keys}},
        "excitations of muscles from a table, in place of their own");
    add("ligament", {conditional_entries_of({form::Table{ligament_keys}})}, "ligaments");
    add("bolus", {conditional_entries_of({form::Table{bolus_keys}})}, "food that is crushed");
    add("load", {conditional_entries_of({form::VariantTable{load_variants}})},
        "what acts from outside");
    table.keys.push_back(
        {"contact",
         {form::Either{{{form::Boolean{}}, {conditional_entries_of({form::Table{contact_keys}})}}}},
         otherwise("every pair"),
         "`false`: nothing touches; entries: only these pairs do"});
    add("probe", {conditional_entries_of({form::VariantTable{probe_variants}})},
        "columns of `history.csv`");
    return table;
  }();
  return kTable;
}

Scenario read_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
  Node root = read_toml(file);
  std::vector<Override> changes;
  std::ranges::transform(overrides, std::back_inserter(changes), read_override);
  for (const Override& change : changes)
    if (sets_a_choice(change)) apply_override(root, change);
  std::set<std::string> named = named_curves(root);  // by entries that do not hold, too
  const Choices choices = apply_choices(root);
  for (const Override& change : changes)
    if (!sets_a_choice(change)) apply_override(root, change);
  const TableReader document(root, scenario_keys(), "scenario");
  refuse_settings_below_tables(root);
  Scenario scenario;
  scenario.choices = choices.words;
  scenario.file = file;
  scenario.name = file.stem().string();
  const std::filesystem::path folder = file.parent_path();
  Mistakes in_itself;
  in_itself.in([&] { read_settings(document, scenario); });
  in_itself.in([&] { scenario.bodies = read_bodies(document, folder); });
  in_itself.tell();
  if (scenario.output.contact_surfaces) check_names_of_contact_surfaces(scenario.bodies);
  if (scenario.analysis == Scenario::Analysis::Static)
    for (const Body& body : scenario.bodies)
      if (!body.velocity.isZero(0) || !body.angular_velocity.isZero(0))
        throw InputError(body.where, fmt::format("body `{}` has a velocity at the start, but the "
                                                 "analysis is static: there is no motion in it",
                                                 body.name));
  const Context context{folder, scenario.bodies, check_curves(document), choices.left_out};
  const Node* const excitations = document.find("excitations");
  std::vector<std::size_t> from_table;
  Mistakes on_bodies;  // what names them
  on_bodies.in([&] { scenario.attachments = read_attachments(document, context); });
  on_bodies.in([&] { scenario.supports = read_supports(document, context); });
  on_bodies.in([&] { scenario.sheets = read_sheets(document, context); });
  on_bodies.in([&] {
    scenario.muscles = read_muscles(document, context);
    from_table = replace_excitations(excitations, context, scenario.muscles);
  });
  on_bodies.in([&] { scenario.ligaments = read_ligaments(document, context, scenario.muscles); });
  on_bodies.in([&] {
    scenario.boluses = read_boluses(document, context, scenario.muscles, scenario.ligaments);
  });
  on_bodies.in([&] { scenario.loads = read_loads(document, context, scenario.supports); });
  on_bodies.in([&] { read_contacts(document, context, scenario); });
  on_bodies.tell();
  if (scenario.analysis == Scenario::Analysis::Dynamic) check_motions_of_masses(scenario);
  scenario.probes = read_probes(document, context, scenario);
  scenario.files = files_of(root, file);
  scenario.settings_json = settings_as_json(scenario);
  scenario.content = plain_text(root);
  named.merge(named_curves(root));
  scenario.doubts = unnamed_curve_doubts(root, named);
  if (std::ranges::none_of(changes, sets_the_duration)) {  // who shortens a run knows it
    for (std::string& doubt : cut_off_doubts(root, scenario.duration))
      scenario.doubts.push_back(std::move(doubt));
    std::string doubt =
        late_excitation_doubt(excitations, scenario.muscles, from_table, scenario.duration);
    if (!doubt.empty()) scenario.doubts.push_back(std::move(doubt));
  }
  return scenario;
}

int body_index(const Scenario& scenario, const std::string& name) {
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b)
    if (scenario.bodies[b].name == name) return static_cast<int>(b);
  throw InputError(fmt::format("no body `{}`", name));
}

}  // namespace articular::sim
