// Title, times, presets, integrator, detection and output of a scenario, and the record of them.
#include <Eigen/LU>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/scenario/preset.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

using Accuracy = Scenario::Accuracy;

constexpr std::pair<std::string_view, Integrator::Scheme> kSchemes[] = {
    {"implicit-euler", Integrator::Scheme::ImplicitEuler},
    {"tr-bdf2", Integrator::Scheme::TrBdf2},
    {"dirk-3", Integrator::Scheme::Dirk3},
    {"explicit", Integrator::Scheme::Explicit}};

constexpr const char* kResponses[] = {"pointwise", "averaged"};
constexpr const char* kSolvers[] = {"auto", "cholesky", "conjugate-gradients", "multigrid"};

void read_integrator(const Node& node, Scenario::Analysis analysis, Integrator& integrator) {
  constexpr int kMostIterations = 1000;
  const TableReader table(
      node, "[integrator]",
      {"scheme", "step", "solver", "position_tolerance", "element_tolerance", "max_iterations"});
  table.may("scheme", integrator.scheme, [](const Node& n) {
    return read_choice<Integrator::Scheme>(n, {kSchemes[0], kSchemes[1], kSchemes[2], kSchemes[3]});
  });
  if (analysis == Scenario::Analysis::Static)
    table.refuse({"scheme", "position_tolerance", "element_tolerance"},
                 "a static analysis has no time integration: it goes on until the forces balance");
  table.may("solver", integrator.solver, [](const Node& n) {
    return read_choice<Integrator::Solver>(
        n, {{"auto", Integrator::Solver::Auto},
            {"cholesky", Integrator::Solver::Cholesky},
            {"conjugate-gradients", Integrator::Solver::ConjugateGradients},
            {"multigrid", Integrator::Solver::Multigrid}});
  });
  table.may("step", integrator.step, as_quantity(kTime, kPositive));
  table.may("position_tolerance", integrator.position_tolerance, as_quantity(kLength, kPositive));
  if (integrator.position_tolerance)
    table.refuse({"element_tolerance"}, "`position_tolerance` is given");
  table.may("element_tolerance", integrator.element_tolerance, as_number(kPositive));
  table.may("max_iterations", integrator.max_iterations,
            [](const Node& n) { return read_integer(n, 1, kMostIterations); });
}

void read_detection(const Node& node, Detection& detection) {
  const TableReader table(node, "[detection]", {"tree"});
  table.may("tree", detection.tree, [](const Node& n) {
    return read_choice<Detection::Tree>(
        n, {{"blocks", Detection::Tree::Blocks}, {"buckets", Detection::Tree::Buckets}});
  });
}

/// A scenario from somewhere else says where results go only within the working folder.
std::filesystem::path read_directory(const Node& node) {
  std::filesystem::path directory = read_text(node);
  if (directory.is_absolute() ||
      std::find(directory.begin(), directory.end(), "..") != directory.end())
    fail(node, fmt::format("expected a folder within the working folder, found {}; give another "
                           "one as --out",
                           found(node)));
  return directory;
}

/// What +x, +y and +z are in the body: one of each pair, in any order, and right-handed.
std::vector<std::string> read_directions(const Node& node) {
  enum Across { kSide, kDepth, kHeight };  // and the sign of left, posterior, superior
  constexpr int kAnySide = 0;              // medial is left or right, by what is modelled
  std::vector<std::string> words;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();  // rows: side, depth, height; columns: x, y, z
  bool given[] = {false, false, false};
  int side = 1;
  for (const Node& entry : read_list(node, "a list of three directions", 3)) {
    const auto [axis, sign] =
        read_choice<std::pair<Across, int>>(entry, {{"left", {kSide, 1}},
                                                    {"right", {kSide, -1}},
                                                    {"medial", {kSide, kAnySide}},
                                                    {"lateral", {kSide, kAnySide}},
                                                    {"posterior", {kDepth, 1}},
                                                    {"anterior", {kDepth, -1}},
                                                    {"superior", {kHeight, 1}},
                                                    {"inferior", {kHeight, -1}}});
    if (given[axis])
      fail(node, "expected one direction to a side, one to the front or back, and one up or down");
    given[axis] = true;
    if (axis == kSide) side = sign;
    axes(axis, static_cast<int>(words.size())) = sign == kAnySide ? 1 : sign;
    words.push_back(*entry.text());
  }
  if (side != kAnySide && axes.determinant() < 0)
    fail(node,
         "expected a body that is no mirror image: with these directions left and right are "
         "exchanged");
  return words;
}

void read_output(const Node& node, Output& output) {
  const TableReader table(node, "[output]",
                          {"interval", "length_unit", "directory", "contact_surfaces",
                           "checkpoint_interval", "directions"});
  table.may("interval", output.interval, as_quantity(kTime, kPositive));
  if (const Node* unit = table.find("length_unit")) {
    output.length_unit.metres =
        read_choice<double>(*unit, {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}});
    output.length_unit.name = *unit->text();
  }
  table.may("directory", output.directory, read_directory);
  table.may("contact_surfaces", output.contact_surfaces, read_boolean);
  table.may("checkpoint_interval", output.checkpoint_interval, as_quantity(kTime, kPositive));
  table.may("directions", output.directions, read_directions);
}

nlohmann::ordered_json contact_as_json(const Scenario& scenario) {
  if (!scenario.contact) return false;
  if (scenario.contacts.empty()) return "every pair";
  auto pairs = nlohmann::ordered_json::array();
  for (const ContactPair& pair : scenario.contacts) {
    nlohmann::ordered_json entry{{"bodies", {pair.a, pair.b}}};
    if (pair.friction > 0) entry["friction"] = pair.friction;
    if (pair.slip_velocity) entry["slip_velocity_m_per_s"] = *pair.slip_velocity;
    if (pair.damping > 0) entry["damping_Pa_s_per_m"] = pair.damping;
    pairs.push_back(std::move(entry));
  }
  return pairs;
}

/// What other programs leave to trial and we choose: how many of it the scenario sets all the same.
int contact_parameters_set(const Scenario& scenario) {
  int count = 0;
  for (const ContactPair& pair : scenario.contacts) count += pair.slip_velocity ? 1 : 0;
  return count;
}

/// The keys that the preset stands for, as a scenario writes them.
nlohmann::ordered_json preset_as_json(const Scenario& scenario) {
  const Preset keys = preset(scenario.accuracy);
  nlohmann::ordered_json json{{"integrator.step", fmt::format("{} s", keys.integrator.step)},
                              {"integrator.element_tolerance", keys.integrator.element_tolerance}};
  json["integrator.scheme"] = kSchemes[static_cast<int>(keys.integrator.scheme)].first;
  json["contact_response"] = kResponses[static_cast<int>(keys.contact_response)];
  if (keys.contact_stiffness_factor)
    json["contact_stiffness_factor"] = *keys.contact_stiffness_factor;
  return json;
}

/// What time alone has: the preset's keys, each of which the scenario may give as well.
void read_dynamics(const TableReader& document, Scenario& scenario) {
  document.may("accuracy", scenario.accuracy, [](const Node& n) {
    return read_choice<Accuracy>(n, {{"fast", Accuracy::Fast},
                                     {"balanced", Accuracy::Balanced},
                                     {"accurate", Accuracy::Accurate}});
  });
  const Preset chosen = preset(scenario.accuracy);
  scenario.integrator = chosen.integrator;
  scenario.contact_response = chosen.contact_response;
  document.may("contact_response", scenario.contact_response, [](const Node& n) {
    return read_choice<Scenario::Response>(n, {{"pointwise", Scenario::Response::Pointwise},
                                               {"averaged", Scenario::Response::Averaged}});
  });
  scenario.contact_stiffness_factor = chosen.contact_stiffness_factor;
  document.may("contact_stiffness_factor", scenario.contact_stiffness_factor, as_number(kPositive));
  if (scenario.contact_response != Scenario::Response::Averaged)
    document.refuse({"contact_stiffness_factor"}, "it is of averaged depths");
}

void read_statics(const TableReader& document, Scenario& scenario) {
  constexpr int kLoadSteps = 10;
  document.refuse({"accuracy"}, "it is about motion in time, and the analysis is static");
  document.refuse({"contact_response", "contact_stiffness_factor"},
                  "a static analysis averages depths");
  scenario.integrator.step = scenario.duration / kLoadSteps;
}

}  // namespace

void read_settings(const TableReader& document, Scenario& scenario) {
  scenario.title = scenario.name;
  document.may("title", scenario.title, read_text);
  scenario.duration = read_quantity(document.at("duration"), kTime, kPositive);
  document.may("analysis", scenario.analysis, [](const Node& n) {
    return read_choice<Scenario::Analysis>(
        n, {{"dynamic", Scenario::Analysis::Dynamic}, {"static", Scenario::Analysis::Static}});
  });
  const bool is_static = scenario.analysis == Scenario::Analysis::Static;
  if (is_static)
    read_statics(document, scenario);
  else
    read_dynamics(document, scenario);
  if (const Node* node = document.find("integrator"))
    read_integrator(*node, scenario.analysis, scenario.integrator);
  if (is_static) scenario.output.interval = scenario.integrator.step;
  if (const Node* node = document.find("detection")) read_detection(*node, scenario.detection);
  if (const Node* node = document.find("output")) read_output(*node, scenario.output);
}

std::string settings_as_json(const Scenario& scenario) {
  const Integrator& integrator = scenario.integrator;
  const Output& output = scenario.output;
  constexpr const char* kAccuracies[] = {"fast", "balanced", "accurate"};
  nlohmann::ordered_json json;
  json["title"] = scenario.title;
  for (const auto& [name, word] : scenario.choices) json["choice"][name] = word;
  json["duration_s"] = scenario.duration;
  const bool is_static = scenario.analysis == Scenario::Analysis::Static;
  if (!is_static) {
    json["accuracy"] = kAccuracies[static_cast<int>(scenario.accuracy)];
    json["accuracy_stands_for"] = preset_as_json(scenario);
  }
  json["analysis"] = is_static ? "static" : "dynamic";
  json["contact"] = contact_as_json(scenario);
  json["contact_response"] =
      is_static ? "averaged" : kResponses[static_cast<int>(scenario.contact_response)];
  if (scenario.contact_stiffness_factor)
    json["contact_stiffness_factor"] = *scenario.contact_stiffness_factor;
  json["contact_parameters_set"] = contact_parameters_set(scenario);
  nlohmann::ordered_json& iteration = json["integrator"];
  if (!is_static) iteration["scheme"] = kSchemes[static_cast<int>(integrator.scheme)].first;
  iteration["step_s"] = integrator.step;
  iteration["solver"] = kSolvers[static_cast<int>(integrator.solver)];
  iteration["max_iterations"] = integrator.max_iterations;
  if (!is_static && integrator.position_tolerance)
    iteration["position_tolerance_m"] = *integrator.position_tolerance;
  else if (!is_static)
    iteration["position_tolerance_of_element"] = integrator.element_tolerance;
  json["detection"] = {
      {"tree", scenario.detection.tree == Detection::Tree::Buckets ? "buckets" : "blocks"}};
  json["output"] = {{"interval_s", output.interval},
                    {"length_unit", output.length_unit.name},
                    {"contact_surfaces", output.contact_surfaces}};
  if (output.directory) json["output"]["directory"] = output.directory->string();
  if (output.checkpoint_interval)
    json["output"]["checkpoint_interval_s"] = *output.checkpoint_interval;
  if (!output.directions.empty()) json["output"]["directions"] = output.directions;
  // Text that is not UTF-8 (a file name may be anything) is replaced rather than refused.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace articular::sim
