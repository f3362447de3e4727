// Title, times, presets, integrator, detection and output of a scenario, and the record of them.
#include <Eigen/LU>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/scenario/preset.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

using Accuracy = Scenario::Accuracy;

constexpr std::pair<std::string_view, Integrator::Scheme> kSchemes[] = {
    {"implicit-euler", Integrator::Scheme::ImplicitEuler},
    {"tr-bdf2", Integrator::Scheme::TrBdf2},
    {"dirk-3", Integrator::Scheme::Dirk3},
    {"explicit", Integrator::Scheme::Explicit}};

constexpr std::pair<std::string_view, Scenario::Response> kResponses[] = {
    {"pointwise", Scenario::Response::Pointwise}, {"averaged", Scenario::Response::Averaged}};
constexpr std::pair<std::string_view, Integrator::Solver> kSolvers[] = {
    {"auto", Integrator::Solver::Auto},
    {"cholesky", Integrator::Solver::Cholesky},
    {"conjugate-gradients", Integrator::Solver::ConjugateGradients},
    {"multigrid", Integrator::Solver::Multigrid}};
constexpr std::pair<std::string_view, Accuracy> kAccuracies[] = {
    {"fast", Accuracy::Fast}, {"balanced", Accuracy::Balanced}, {"accurate", Accuracy::Accurate}};
constexpr std::pair<std::string_view, double> kLengthUnits[] = {
    {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}};

constexpr int kMostIterations = 1000;

form::Choice length_units() {
  form::Choice units;
  for (int i = 0; const auto& [name, metres] : kLengthUnits) units.words.emplace_back(name, i++);
  return units;
}

void read_integrator(const Node& node, Scenario::Analysis analysis, Integrator& integrator) {
  const TableReader table(node, integrator_keys(), "[integrator]");
  table.read("scheme", integrator.scheme);
  if (analysis == Scenario::Analysis::Static)
    table.refuse({"scheme", "position_tolerance", "element_tolerance"},
                 "a static analysis has no time integration: it goes on until the forces balance");
  table.read("solver", integrator.solver);
  table.read("step", integrator.step);
  table.read("position_tolerance", integrator.position_tolerance);
  if (integrator.position_tolerance)
    table.refuse({"element_tolerance"}, "`position_tolerance` is given");
  table.read("element_tolerance", integrator.element_tolerance);
  table.read("max_iterations", integrator.max_iterations);
}

void read_detection(const Node& node, Detection& detection) {
  const TableReader table(node, detection_keys(), "[detection]");
  table.read("tree", detection.tree);
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

/// Of a body: sides, depth, height, and the sign of left, posterior, superior. Medial is left or
/// right, by what is modelled.
constexpr int kSide = 0, kDepth = 1, kHeight = 2, kAnySide = 0;
struct BodyDirection {
  std::string_view word;
  int axis;
  int sign;
};
constexpr BodyDirection kDirections[] = {{"left", kSide, 1},          {"right", kSide, -1},
                                         {"medial", kSide, kAnySide}, {"lateral", kSide, kAnySide},
                                         {"posterior", kDepth, 1},    {"anterior", kDepth, -1},
                                         {"superior", kHeight, 1},    {"inferior", kHeight, -1}};

form::Choice directions() {
  form::Choice words;
  for (int i = 0; const BodyDirection& direction : kDirections)
    words.words.emplace_back(direction.word, i++);
  return words;
}

/// What +x, +y and +z are in the body: one of each pair, in any order, and right-handed.
std::vector<std::string> read_directions(const Node& node) {
  std::vector<std::string> words;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();  // rows: side, depth, height; columns: x, y, z
  bool given[] = {false, false, false};
  int side = 1;
  for (const Node& entry : read_list(node, "a list of three directions", 3)) {
    const auto& [word, axis, sign] = kDirections[read_word(entry, {directions()})];
    if (given[axis])
      fail(node, "expected one direction to a side, one to the front or back, and one up or down");
    given[axis] = true;
    if (axis == kSide) side = sign;
    axes(axis, static_cast<int>(words.size())) = sign == kAnySide ? 1 : sign;
    words.emplace_back(word);
  }
  if (side != kAnySide && axes.determinant() < 0)
    fail(node,
         "expected a body that is no mirror image: with these directions left and right are "
         "exchanged");
  return words;
}

LengthUnit read_length_unit(const Node& node) {
  const int chosen = read_word(node, output_keys().find("length_unit")->type);
  const auto& [name, metres] = kLengthUnits[chosen];
  return {metres, std::string(name)};
}

void read_output(const Node& node, Output& output) {
  const TableReader table(node, output_keys(), "[output]");
  table.read("interval", output.interval);
  table.read("length_unit", output.length_unit, read_length_unit);
  table.read("directory", output.directory, read_directory);
  table.read("frames", output.frames);
  table.read("contact_surfaces", output.contact_surfaces);
  table.read("checkpoint_interval", output.checkpoint_interval);
  table.read("directions", output.directions, read_directions);
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
  json["contact_response"] = kResponses[static_cast<int>(keys.contact_response)].first;
  if (keys.contact_stiffness_factor)
    json["contact_stiffness_factor"] = *keys.contact_stiffness_factor;
  return json;
}

/// What time alone has: the preset's keys, each of which the scenario may give as well.
void read_dynamics(const TableReader& document, Scenario& scenario) {
  document.read("accuracy", scenario.accuracy);
  const Preset chosen = preset(scenario.accuracy);
  scenario.integrator = chosen.integrator;
  scenario.contact_response = chosen.contact_response;
  document.read("contact_response", scenario.contact_response);
  scenario.contact_stiffness_factor = chosen.contact_stiffness_factor;
  document.read("contact_stiffness_factor", scenario.contact_stiffness_factor);
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

const KeyTable& integrator_keys() {
  static const KeyTable kTable{
      "[integrator]",
      {{"step",
        {form::Quantity{kTime, kPositive}},
        otherwise("by `accuracy`; static: a tenth of `duration`"),
        "time step or load step; the longest one for `explicit`"},
       {"scheme",
        {choice_of(kSchemes)},
        otherwise("by `accuracy`"),
        "order 1, 2, 3; `explicit` chooses its steps. Not in statics"},
       {"element_tolerance",
        {form::Number{kPositive}},
        otherwise("by `accuracy`"),
        "Newton's tolerance as part of the finest tissue's mean element size (without tissue: of a "
        "hundredth of the smallest rigid body); not in statics"},
       {"position_tolerance",
        {form::Quantity{kLength, kPositive}},
        kNone,
        "the same as a length, in its place; for `explicit` the error of a step; not in statics"},
       {"max_iterations",
        {form::Integer{1, kMostIterations}},
        standard(20.0),
        "Newton iterations before the step is halved, thirteen times at most"},
       {"solver",
        {choice_of(kSolvers)},
        standard("auto"),
        "linear solver; `summary.json` names the one chosen"}}};
  return kTable;
}

const KeyTable& detection_keys() {
  static const KeyTable kTable{
      "[detection]",
      {{"tree",
        {form::Choice{
            {{"blocks", Detection::Tree::Blocks}, {"buckets", Detection::Tree::Buckets}}}},
        standard("blocks"),
        "the tree that finds pairs; `buckets` is the published algorithm"}}};
  return kTable;
}

const KeyTable& output_keys() {
  static const KeyTable kTable{
      "[output]",
      {{"interval",
        {form::Quantity{kTime, kPositive}},
        otherwise("`\"10 ms\"`; static: the load step"),
        "between frames; a step ends at each of them"},
       {"length_unit", {length_units()}, standard("mm"), "of the results"},
       {"directory",
        {form::Text{"path"}},
        kNone,
        "where results go, within the working folder; `--out` takes any folder"},
       {"frames",
        {form::Boolean{}},
        standard(true),
        "writes meshes and fields over time; `false`: the history and the summary alone"},
       {"contact_surfaces",
        {form::Boolean{}},
        standard(false),
        "also writes `frames/BODY_contact_000123.vtp`"},
       {"checkpoint_interval",
        {form::Quantity{kTime, kPositive}},
        otherwise("10 intervals; static 1"),
        "between restart points"},
       {"directions",
        {list_of({directions()}, 3)},
        kNone,
        "what +x, +y and +z point to in the body, for pictures"}}};
  return kTable;
}

std::vector<Key> settings_keys() {
  return {{"title", {form::Text{"text"}}, otherwise("file name"), "for reports"},
          {"duration", {form::Quantity{kTime, kPositive}}, kRequired, "simulated time"},
          {"analysis",
           {form::Choice{
               {{"dynamic", Scenario::Analysis::Dynamic}, {"static", Scenario::Analysis::Static}}}},
           standard("dynamic"),
           "motion in time, or equilibrium at each load step"},
          {"accuracy",
           {choice_of(kAccuracies)},
           standard("balanced"),
           "a preset: it stands for `contact_response`, `contact_stiffness_factor` and the step, "
           "scheme "
           "and tolerance of `[integrator]`; dynamic only"},
          {"contact_response",
           {choice_of(kResponses)},
           otherwise("by `accuracy`"),
           "how contact counts depths: point by point, or as averages at nodes; dynamic only"},
          {"contact_stiffness_factor",
           {form::Number{kPositive}},
           otherwise("by `accuracy`; else 100, with `explicit` 10"),
           "penalty stiffness relative to the elements; averaged depths only"},
          {"integrator", {form::Table{integrator_keys}}, kNone, "steps in time, or load steps"},
          {"detection", {form::Table{detection_keys}}, kNone, "how pairs in contact are found"},
          {"output", {form::Table{output_keys}}, kNone, "what is written"}};
}

void read_settings(const TableReader& document, Scenario& scenario) {
  scenario.title = scenario.name;
  document.read("title", scenario.title);
  document.read("duration", scenario.duration);
  document.read("analysis", scenario.analysis);
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
  nlohmann::ordered_json json;
  json["title"] = scenario.title;
  for (const auto& [name, word] : scenario.choices) json["choice"][name] = word;
  json["duration_s"] = scenario.duration;
  const bool is_static = scenario.analysis == Scenario::Analysis::Static;
  if (!is_static) {
    json["accuracy"] = kAccuracies[static_cast<int>(scenario.accuracy)].first;
    json["accuracy_stands_for"] = preset_as_json(scenario);
  }
  json["analysis"] = is_static ? "static" : "dynamic";
  json["contact"] = contact_as_json(scenario);
  json["contact_response"] =
      is_static ? "averaged" : kResponses[static_cast<int>(scenario.contact_response)].first;
  if (scenario.contact_stiffness_factor)
    json["contact_stiffness_factor"] = *scenario.contact_stiffness_factor;
  json["contact_parameters_set"] = contact_parameters_set(scenario);
  nlohmann::ordered_json& iteration = json["integrator"];
  if (!is_static) iteration["scheme"] = kSchemes[static_cast<int>(integrator.scheme)].first;
  iteration["step_s"] = integrator.step;
  iteration["solver"] = kSolvers[static_cast<int>(integrator.solver)].first;
  iteration["max_iterations"] = integrator.max_iterations;
  if (!is_static && integrator.position_tolerance)
    iteration["position_tolerance_m"] = *integrator.position_tolerance;
  else if (!is_static)
    iteration["position_tolerance_of_element"] = integrator.element_tolerance;
  json["detection"] = {
      {"tree", scenario.detection.tree == Detection::Tree::Buckets ? "buckets" : "blocks"}};
  json["output"] = {{"interval_s", output.interval},
                    {"length_unit", output.length_unit.name},
                    {"frames", output.frames},
                    {"contact_surfaces", output.contact_surfaces}};
  if (output.directory) json["output"]["directory"] = output.directory->string();
  if (output.checkpoint_interval)
    json["output"]["checkpoint_interval_s"] = *output.checkpoint_interval;
  if (!output.directions.empty()) json["output"]["directions"] = output.directions;
  // Text that is not UTF-8 (a file name may be anything) is replaced rather than refused.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace articular::sim
