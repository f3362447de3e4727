#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/linear_solver.hpp"
#include "sim/model.hpp"
#include "tools/commands.hpp"

namespace articular::tools {
namespace {

using Json = nlohmann::ordered_json;

Json explain_body(const sim::Model& model, const sim::BodyModel& body) {
  Json json = {{"name", body.name}};
  if (body.tissue >= 0) {
    const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
    const auto free = std::count_if(tissue.nodes.begin(), tissue.nodes.end(),
                                    [](const sim::NodeRef& node) { return node.bone < 0; });
    const bool smoothed = tissue.elements.smoothed() != nullptr;
    json["modelled_as"] = fmt::format("tissue, {}{}{}", smoothed ? "smoothed" : "plain",
                                      tissue.fibres.cols() > 0 ? ", fibres" : "",
                                      tissue.relaxation ? ", relaxing" : "");
    json["tetrahedra"] = tissue.elements.num_elements();
    json["nodes"] = tissue.nodes.size();
    json["unknowns"] = 3 * free;
  } else {
    const sim::Bone& bone = model.bones[static_cast<std::size_t>(body.bone)];
    const auto held =
        bone.hold ? std::count(bone.hold->held.begin(), bone.hold->held.end(), true) : 0;
    json["modelled_as"] = held > 0       ? fmt::format("rigid bone, {} of 6 freedoms held", held)
                          : bone.unknown ? "rigid bone"
                          : bone.motion  ? "driven bone (motion prescribed)"
                                         : "fixed bone";
    json["unknowns"] = bone.unknown ? 6 - held : 0;
    if (bone.unknown) json["mass_kg"] = bone.mass.mass;
  }
  if (body.collider) {
    json["collision_tetrahedra"] = body.collider->tets.cols();
    json["surface_triangles"] = body.collider->surface.faces.cols();
  } else {
    json["collision_tetrahedra"] = 0;
  }
  return json;
}

/// Blocks of the system matrix and of its Cholesky factor, roughly: 20 nodes around each, and a
/// factor fill that grows with the cube root of the size.
double memory_estimate(const sim::Model& model) {
  double bytes = 0;
  for (const sim::Tissue& tissue : model.tissues) {
    const auto nodes = static_cast<double>(tissue.X.cols());
    const double blocks = 15 * nodes;
    bytes += 72 * blocks * 3 + 300.0 * tissue.elements.num_elements();
    bytes += 72 * blocks * 0.3 * std::cbrt(nodes);
  }
  for (const sim::BodyModel& body : model.bodies)
    if (body.collider) bytes += 400.0 * static_cast<double>(body.collider->tets.cols()) + 7e6;
  return bytes;
}

Json linear_solver(const sim::Model& model) {
  if (!sim::needs_linear_solver(model)) return nullptr;
  const fem::SolverChoice choice = sim::choose_linear_solver(model);
  return {{"name", sim::name_of(choice.kind)}, {"reason", choice.reason}};
}

Json explain(const sim::Model& model) {
  Json bodies = Json::array(), pairs = Json::array(), left_out = Json::array();
  for (const sim::BodyModel& body : model.bodies) bodies.push_back(explain_body(model, body));
  bool any_self = false, any_friction = false;
  for (const sim::ContactModel& contact : model.contacts) {
    any_self = any_self || contact.a == contact.b;
    any_friction = any_friction || contact.law.friction > 0;
    pairs.push_back({{"a", model.bodies[static_cast<std::size_t>(contact.a)].name},
                     {"b", model.bodies[static_cast<std::size_t>(contact.b)].name},
                     {"stiffness_Pa_per_m", contact.mean_stiffness}});
  }
  if (model.contacts.empty())
    left_out.push_back("contact: no pair of bodies can meet, so no tree is built");
  else if (!any_self)
    left_out.push_back("self-contact: no tissue is tested against itself");
  for (const sim::BodyModel& body : model.bodies)
    if (!body.collider && !model.contacts.empty())
      left_out.push_back(fmt::format("contact of `{}`: it is in no contact pair", body.name));
  if (model.lines.empty() && model.muscles.empty())
    left_out.push_back("muscles and ligaments: the scene has none");
  if (model.gravity.isZero()) left_out.push_back("gravity: the scene has none");
  left_out.push_back("fluid flow in cartilage (poroelasticity)");
  left_out.push_back("wrapping of muscles over bone (straight between via points)");
  left_out.push_back("deformation of bone");
  if (!any_friction) left_out.push_back("friction: the scene names none");
  return {{"title", model.scenario.title},
          {"bodies", bodies},
          {"contact_pairs", pairs},
          {"muscles", model.muscles.size()},
          {"ligaments", model.ligaments.size()},
          {"unknown_velocities", 3 * model.layout.num_unknown_blocks()},
          {"muscle_activations", model.layout.num_muscles},
          {"linear_solver", linear_solver(model)},
          {"estimated_memory_MB", memory_estimate(model) / 1e6},
          {"settings", Json::parse(model.scenario.settings_json)},
          {"left_out", left_out},
          {"warnings", model.warnings}};
}

void print(const Json& json) {
  fmt::print("{}\n\nModelled:\n", json["title"].get<std::string>());
  for (const Json& body : json["bodies"])
    fmt::print("  {:<18} {:<32} {:>7} unknowns  {:>7} collision tetrahedra\n",
               body["name"].get<std::string>(), body["modelled_as"].get<std::string>(),
               body["unknowns"].get<long>(), body["collision_tetrahedra"].get<long>());
  fmt::print("  {} muscles, {} ligaments\n", json["muscles"].get<int>(),
             json["ligaments"].get<int>());
  if (!json["contact_pairs"].empty())
    fmt::print("\nContact pairs (stiffness chosen from the tissue):\n");
  for (const Json& pair : json["contact_pairs"])
    fmt::print("  {} - {}: {:.3g} Pa/m\n", pair["a"].get<std::string>(),
               pair["b"].get<std::string>(), pair["stiffness_Pa_per_m"].get<double>());
  fmt::print("\nLeft out:\n");
  for (const Json& item : json["left_out"]) fmt::print("  {}\n", item.get<std::string>());
  fmt::print("\n{} unknown velocities, {} muscle activations; about {:.0f} MB\n",
             json["unknown_velocities"].get<int>(), json["muscle_activations"].get<int>(),
             json["estimated_memory_MB"].get<double>());
  if (const Json& solver = json["linear_solver"]; !solver.is_null())
    fmt::print("Linear solver: {} ({})\n", solver["name"].get<std::string>(),
               solver["reason"].get<std::string>());
  fmt::print("Settings: {}\n", json["settings"].dump());
  for (const Json& warning : json["warnings"])
    fmt::print("warning: {}\n", warning.get<std::string>());
}

}  // namespace

void add_explain_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::filesystem::path scenario;
    std::vector<std::string> overrides;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "explain", "Say what of a scenario is modelled, what is left out, and what it will need");
  command->add_option("scenario", arguments->scenario, "Scenario file (.toml)")->required();
  command->add_option("--set", arguments->overrides, "Override a value, as in run")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "Machine-readable");
  command->callback([arguments, &exit_code] {
    const Json json =
        explain(sim::build_model(sim::read_scenario(arguments->scenario, arguments->overrides)));
    if (arguments->json)
      fmt::print("{}\n", json.dump(2));
    else
      print(json);
    exit_code = 0;
  });
}

}  // namespace articular::tools
