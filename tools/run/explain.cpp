#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/assembly/solver_setup.hpp"
#include "sim/build/build_model.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/model/model.hpp"
#include "sim/output/output_size.hpp"
#include "sim/scenario/preset.hpp"
#include "tools/run/commands.hpp"
#include "tools/run/override_files.hpp"
#include "tools/run/term_costs.hpp"
#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::tools {
namespace {

/// Of more pairs of bodies one of each kind is listed.
constexpr std::int64_t kMostPairs = 1000;

using Json = nlohmann::ordered_json;

/// ", 1 of them driven", if any of a bone's held freedoms is.
std::string driven_freedoms(const sim::RigidBody& rigid) {
  if (!rigid.motion) return {};
  std::array<bool, 6> driven{};
  const auto look_at = [&](const std::vector<sim::Vec3>& values, std::size_t first) {
    for (const sim::Vec3& value : values) {
      const sim::Vec3 part = rigid.hold->axes.transpose() * value;
      for (std::size_t i = 0; i < 3; ++i)
        driven[first + i] |= std::abs(part[static_cast<Eigen::Index>(i)]) > 1e-12 * value.norm();
    }
  };
  look_at(rigid.motion->translation, 0);
  look_at(rigid.motion->rotation, 3);
  return fmt::format(", {} of them driven", std::count(driven.begin(), driven.end(), true));
}

Json explain_body(const sim::Model& model, const sim::BodyModel& body) {
  Json json = {{"name", body.name}};
  if (body.tissue >= 0) {
    const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
    const auto free = std::count_if(tissue.nodes.begin(), tissue.nodes.end(),
                                    [](const sim::NodeRef& node) { return node.rigid < 0; });
    const bool smoothed = tissue.elements.smoothed() != nullptr;
    json["modelled_as"] =
        fmt::format("tissue, {}{}{}{}", smoothed ? "smoothed" : "plain",
                    tissue.fibres.cols() > 0 ? ", fibres" : "",
                    tissue.sheets.empty() ? "" : ", sheets", tissue.relaxation ? ", relaxing" : "");
    json["tetrahedra"] = tissue.elements.num_elements();
    json["nodes"] = tissue.nodes.size();
    json["unknowns"] = 3 * free - sim::num_held_freedoms(model, tissue);
  } else {
    const sim::RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
    const auto held =
        rigid.hold ? std::count(rigid.hold->held.begin(), rigid.hold->held.end(), true) : 0;
    json["modelled_as"] =
        held > 0 ? fmt::format("rigid bone, {} of 6 freedoms held{}", held, driven_freedoms(rigid))
        : rigid.unknown ? "rigid bone"
        : rigid.motion  ? "driven bone (motion prescribed)"
                        : "fixed bone";
    json["unknowns"] = rigid.unknown ? 6 - held : 0;
    if (rigid.unknown) json["mass_kg"] = rigid.mass.mass;
  }
  if (body.collider) {
    json["collision_tetrahedra"] = body.collider->tets.cols();
    json["surface_triangles"] = body.collider->surface.faces.cols();
  } else {
    json["collision_tetrahedra"] = 0;
  }
  return json;
}

Json linear_solver(const sim::Model& model, sim::Integrator::Scheme scheme) {
  if (!sim::needs_linear_solver(model, scheme)) return nullptr;
  const fem::SolverChoice& choice = model.linear_solver;
  return {{"name", sim::name_of(choice.kind)}, {"reason", choice.reason}};
}

template <class Items, class Has>
bool any(const Items& items, Has&& has) {
  return std::any_of(items.begin(), items.end(), std::forward<Has>(has));
}

/// What a scene does not have, and therefore does not pay for; then what we do not model at all.
Json left_out(const sim::Model& model) {
  Json items = Json::array();
  if (model.is_static)
    items.push_back("inertia, dampers: the analysis is static (masses but for weight)");
  for (const sim::BodyModel& body : model.bodies) {
    if (body.rigid >= 0 && !model.rigid_bodies[static_cast<std::size_t>(body.rigid)].unknown)
      items.push_back(fmt::format("unknowns of `{}`: it is {}", body.name,
                                  model.rigid_bodies[static_cast<std::size_t>(body.rigid)].motion
                                      ? "driven"
                                      : "fixed; its collision mesh is placed once"));
  }
  if (model.contacts.empty()) {
    items.push_back("contact: no pair of bodies can meet, so no tree is built");
  } else {
    for (const sim::BodyModel& body : model.bodies)
      if (!body.collider)
        items.push_back(fmt::format("contact of `{}`: it is in no contact pair", body.name));
    if (!model.contacts.any([](const sim::ContactModel& c) { return c.a == c.b; }))
      items.push_back("self-contact: no tissue is tested against itself");
    if (!model.contacts.any([](const sim::ContactModel& c) { return c.law.friction > 0; }))
      items.push_back("friction: the scene names none");
    if (!model.contacts.any([](const sim::ContactModel& c) { return c.law.damping > 0; }))
      items.push_back("damping in contact: the scene names none");
  }
  if (!any(model.tissues,
           [](const sim::Tissue& t) { return t.dashpots || t.mass_damping > 0 || t.relaxation; }))
    items.push_back("dampers and relaxation of tissue: the scene names none");
  if (!any(model.tissues, [](const sim::Tissue& t) { return !t.sheets.empty(); }))
    items.push_back("sheets on tissue: the scene has none");
  if (model.muscles.empty()) items.push_back("muscles: the scene has none");
  if (model.ligaments.empty()) items.push_back("ligaments: the scene has none");
  if (model.forces.empty() && model.moments.empty() && model.surface_loads.empty())
    items.push_back("forces: the scene has none");
  if (model.gravity.empty()) items.push_back("gravity: the scene has none");
  if (!model.is_static &&
      any(model.tissues, [](const sim::Tissue& t) { return t.muscle >= 0 && !t.fibre_drag; }))
    items.push_back("force-velocity of fibres in a tissue whose law gives no `max_velocity`");
  items.push_back("fluid flow in cartilage (poroelasticity)");
  items.push_back("wrapping of muscles over tissue (over bone with `wrap`)");
  items.push_back("deformation of bone");
  return items;
}

Json costs_as_json(const SceneCosts& costs, int unknowns, double model_bytes) {
  Json terms = Json::array();
  for (const TermCost& cost : costs.terms) {
    Json term = {{"term", cost.term}};
    if (cost.unknowns > 0) {
      term["unknowns"] = cost.unknowns;
      term["share_of_unknowns"] = static_cast<double>(cost.unknowns) / unknowns;
    }
    if (cost.force_seconds > 0) term["evaluation_s"] = cost.force_seconds;
    if (cost.matrix_seconds > 0) term["matrix_s"] = cost.matrix_seconds;
    terms.push_back(term);
  }
  Json json = {{"terms", terms},
               {"detection_s", costs.detection_seconds},
               {"iteration_s",
                {{"total", costs.iteration_seconds()},
                 {"forces", costs.evaluation_seconds},
                 {"assembly", costs.assembly_seconds},
                 {"factor", costs.factor_seconds},
                 {"solve", costs.solve_seconds}}},
               {"memory_MB",
                {{"meshes_and_model", model_bytes / 1e6},
                 {"detection", costs.detection_bytes / 1e6},
                 {"forces_and_matrices", costs.matrix_bytes / 1e6},
                 {"linear_solver", costs.solver_bytes / 1e6}}}};
  if (costs.longest_explicit_step) json["longest_explicit_step_s"] = *costs.longest_explicit_step;
  return json;
}

/// What the scenario's `accuracy` promises; its own settings may have changed that. Nothing in a
/// static analysis, which has no such preset.
Json promise(const sim::Scenario& scenario) {
  if (scenario.analysis == sim::Scenario::Analysis::Static) return nullptr;
  return sim::preset(scenario.accuracy).promise +
         " (scenarios/mandible/RESULTS.md), as far as the scenario's own keys leave it";
}

Json explain(const sim::Scenario& scenario, const sim::Model& model) {
  Json bodies = Json::array(), pairs = Json::array();
  for (const sim::BodyModel& body : model.bodies) bodies.push_back(explain_body(model, body));
  const bool lists_pairs = model.contacts.size() <= kMostPairs;
  for (const sim::ContactId id : lists_pairs ? model.contacts.all() : model.contacts.kinds()) {
    const sim::ContactModel contact = model.contacts[id];
    pairs.push_back({{"a", model.bodies[static_cast<std::size_t>(contact.a)].name},
                     {"b", model.bodies[static_cast<std::size_t>(contact.b)].name},
                     {"stiffness_Pa_per_m", contact.mean_stiffness}});
  }
  return {{"title", scenario.title},
          {"bodies", bodies},
          {"num_contact_pairs", model.contacts.size()},
          {"contact_pairs", pairs},
          {"muscles", model.muscles.size()},
          {"ligaments", model.ligaments.size()},
          {"boluses", model.boluses.size()},
          {"loads", model.forces.size() + model.moments.size() + model.surface_loads.size()},
          {"gravity", !model.gravity.empty()},
          {"unknown_velocities", 3 * model.layout.num_unknown_blocks()},
          {"muscle_activations", model.layout.num_muscles},
          {"linear_solver", linear_solver(model, scenario.integrator.scheme)},
          {"promise", promise(scenario)},
          {"settings", Json::parse(scenario.settings_json)},
          {"left_out", left_out(model)},
          {"warnings", model.warnings}};
}

void print_costs(const Json& costs) {
  const auto ms = [](const Json& seconds) { return 1e3 * seconds.get<double>(); };
  fmt::print("\nTerms, evaluated where things are at the start (ms; matrix: its part in one):\n");
  fmt::print("  {:<58} {:>8} {:>6} {:>9} {:>9}\n", "", "unknowns", "share", "once", "matrix");
  for (const Json& term : costs["terms"]) {
    const bool has_unknowns = term.contains("unknowns");
    fmt::print(
        "  {:<58} {:>8} {:>6} {:>9} {:>9}\n", term["term"].get<std::string>(),
        has_unknowns ? fmt::format("{}", term["unknowns"].get<int>()) : "",
        has_unknowns ? fmt::format("{:.0f} %", 100 * term["share_of_unknowns"].get<double>()) : "",
        term.contains("evaluation_s") ? fmt::format("{:.3f}", ms(term["evaluation_s"])) : "",
        term.contains("matrix_s") ? fmt::format("{:.3f}", ms(term["matrix_s"])) : "");
  }
  const Json& iteration = costs["iteration_s"];
  fmt::print(
      "\nA Newton iteration there: {:.2f} ms (all forces {:.2f}, matrix {:.2f}, factor {:.2f}, "
      "solution {:.2f}); a search for contacts: {:.2f} ms\n",
      ms(iteration["total"]), ms(iteration["forces"]), ms(iteration["assembly"]),
      ms(iteration["factor"]), ms(iteration["solve"]), ms(costs["detection_s"]));
  if (costs.contains("longest_explicit_step_s"))
    fmt::print(
        "The scheme `explicit` would be stable there up to steps of {:.3g} ms, of five evaluations "
        "of all forces each\n",
        ms(costs["longest_explicit_step_s"]));
  const Json& memory = costs["memory_MB"];
  fmt::print(
      "Memory: meshes and model {:.1f} MB, detection {:.1f}, forces and matrices {:.1f}, linear "
      "solver {:.1f}; with the program itself about {:.0f} MB\n",
      memory["meshes_and_model"].get<double>(), memory["detection"].get<double>(),
      memory["forces_and_matrices"].get<double>(), memory["linear_solver"].get<double>(),
      costs["estimated_memory_MB"].get<double>());
}

void print(const Json& json) {
  fmt::print("{}\n\nModelled:\n", json["title"].get<std::string>());
  for (const Json& body : json["bodies"])
    fmt::print("  {:<18} {:<32} {:>7} unknowns  {:>7} collision tetrahedra\n",
               body["name"].get<std::string>(), body["modelled_as"].get<std::string>(),
               body["unknowns"].get<long>(), body["collision_tetrahedra"].get<long>());
  const int boluses = json["boluses"].get<int>();
  fmt::print("  {} muscles, {} ligaments, {}{} forces, {}\n", json["muscles"].get<int>(),
             json["ligaments"].get<int>(),
             boluses > 0 ? fmt::format("{} {}, ", boluses, boluses > 1 ? "boluses" : "bolus") : "",
             json["loads"].get<int>(), json["gravity"].get<bool>() ? "gravity" : "no gravity");
  const auto listed = std::ssize(json["contact_pairs"]),
             pairs = json["num_contact_pairs"].get<std::ptrdiff_t>();
  if (pairs > 0)
    fmt::print("\nContact pairs (stiffness chosen from the tissue{}):\n",
               listed < pairs ? fmt::format("; of {} one of each kind", pairs) : "");
  for (const Json& pair : json["contact_pairs"])
    fmt::print("  {} - {}: {:.3g} Pa/m\n", pair["a"].get<std::string>(),
               pair["b"].get<std::string>(), pair["stiffness_Pa_per_m"].get<double>());
  if (json.contains("costs")) print_costs(json["costs"]);
  fmt::print("\nOutput: {:.0f} frames, at most {:.3g} MB with the history\n",
             json["output"]["frames"].get<double>(), json["output"]["at_most_MB"].get<double>());
  fmt::print("\nLeft out:\n");
  for (const Json& item : json["left_out"]) fmt::print("  {}\n", item.get<std::string>());
  fmt::print("\n{} unknown velocities, {} muscle activations\n",
             json["unknown_velocities"].get<int>(), json["muscle_activations"].get<int>());
  if (const Json& solver = json["linear_solver"]; !solver.is_null())
    fmt::print("Linear solver: {} ({})\n", solver["name"].get<std::string>(),
               solver["reason"].get<std::string>());
  fmt::print(
      "Contact parameters set by the scenario (slip_velocity): "
      "{}\n",
      json["settings"]["contact_parameters_set"].get<int>());
  if (const Json& promise = json["promise"]; !promise.is_null()) {
    fmt::print("Accuracy: {}\n", promise.get<std::string>());
    fmt::print("  It stands for these keys, each of which the scenario may set:\n");
    for (const auto& [key, value] : json["settings"]["accuracy_stands_for"].items())
      fmt::print("  {} = {}\n", key, value.dump());
  }
  fmt::print("Settings: {}\n", json["settings"].dump());
  for (const Json& warning : json["warnings"])
    fmt::print("warning: {}\n", warning.get<std::string>());
}

}  // namespace

void add_explain_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::filesystem::path scenario;
    std::vector<std::string> overrides;
    bool json = false, costs = true;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "explain", "Say what of a scenario is modelled, what is left out, and what it will need");
  command
      ->add_option("scenario", arguments->scenario,
                   "Scenario file (.toml), or the name of a shipped one: see `articular scenarios`")
      ->required();
  command->add_option("--set", arguments->overrides, "Override a value, as in run")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command->add_flag("--json", arguments->json, "Machine-readable");
  command->add_flag("!--no-costs", arguments->costs,
                    "Without times and memory, which are measured: each term is evaluated a few "
                    "times where things are at the start");
  command->callback([arguments, &exit_code] {
    const double before = heap_in_use();
    const sim::Scenario scenario = sim::read_scenario(find_file_for("run", arguments->scenario),
                                                      with_override_files(arguments->overrides));
    const sim::Model model = sim::build_model(scenario);
    const double model_bytes = heap_in_use() - before;
    Json json = explain(scenario, model);
    if (arguments->costs) {
      const SceneCosts costs = measure_costs(model, sim::step_settings(scenario));
      json["costs"] = costs_as_json(costs, 3 * model.layout.num_unknown_blocks(), model_bytes);
      json["costs"]["estimated_memory_MB"] = costs.peak_bytes / 1e6;
    }
    const sim::OutputSize output = sim::estimated_output(scenario, model);
    json["output"] = {{"frames", output.num_frames}, {"at_most_MB", output.total_bytes() / 1e6}};
    if (arguments->json)
      fmt::print("{}\n", json.dump(2));
    else
      print(json);
    exit_code = 0;
  });
}

}  // namespace articular::tools
