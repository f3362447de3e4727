#include "tools/fit/fit_file.hpp"

#include <algorithm>

#include "tools/fit/parameter_text.hpp"
#include "tools/study/history_columns.hpp"
#include "tools/study/number_with_unit.hpp"
#include "tools/study/parameter_path.hpp"

namespace articular::tools {
namespace {

using sim::KeyTable;
using sim::Node;
using sim::TableReader;
namespace form = sim::form;

constexpr const char* kOnlyRun = "run";
constexpr double kStepPerSpread = 0.05;

const KeyTable& parameter_keys() {
  static const KeyTable kTable{
      "[[parameter]] of a fit",
      {{"name", {form::Text{"name"}}, sim::kRequired, "letters, digits and `_`"},
       {"path",
        {form::Text{"path of a value"}},
        sim::otherwise("or `{name}` in a `set`"),
        "the value that it is"},
       {"start", number_with_unit(), sim::kRequired, "where the fit starts"},
       {"known", number_with_unit(), sim::otherwise("as `start`"),
        "what is known of it without the measurements, with `spread`"},
       {"spread", number_with_unit(), sim::otherwise("or `difference_step`"),
        "standard deviation of what is known of it"},
       {"lowest", number_with_unit(), sim::kNone, "lower bound"},
       {"highest", number_with_unit(), sim::kNone, "upper bound"},
       {"difference_step", number_with_unit(), sim::otherwise("a twentieth of `spread`"),
        "by how much it is changed to see what follows"}}};
  return kTable;
}

FitParameter read_parameter(const Node& node) {
  const TableReader table(node, parameter_keys(), "[[parameter]]");
  FitParameter parameter;
  parameter.name = sim::read_text(table.at("name"));
  if (!is_parameter_name(parameter.name))
    sim::fail(table.at("name"), "expected a name of letters, digits and _, such as `acl_strain`");
  table.read("path", parameter.path);
  const NumberWithUnit start = read_with_unit(table.at("start"));
  parameter.start = start.number;
  parameter.unit = start.unit;
  const auto read = [&](const Node& n) { return in_unit(n, parameter.unit, "start"); };
  const auto read_positive = [&](const Node& n) {
    const double value = in_unit(n, parameter.unit, "start");
    if (!(value > 0)) sim::fail(n, "must be positive, found " + sim::found(n));
    return value;
  };
  table.read("spread", parameter.spread, read_positive);
  table.read("known", parameter.known, read);
  if (parameter.known && !parameter.spread)
    sim::fail(table.at("known"), "expected `spread` with it: how well it is known");
  table.read("lowest", parameter.lowest, read);
  table.read("highest", parameter.highest, read);
  if (parameter.spread) parameter.step = kStepPerSpread * *parameter.spread;
  table.read("difference_step", parameter.step, read_positive);
  if (!(parameter.step > 0))
    sim::fail(node,
              "expected `spread` (standard deviation of what is known of it without the "
              "measurements) or `difference_step` (by how much it is changed to see what follows)");
  if (!(parameter.highest - parameter.lowest > 2 * parameter.step))
    sim::fail(node, "expected `lowest` and `highest` to be more than two difference steps apart");
  if (parameter.start < parameter.lowest || parameter.start > parameter.highest)
    sim::fail(table.at("start"), "must lie between `lowest` and `highest`");
  return parameter;
}

const KeyTable& run_keys() {
  static const KeyTable kTable = with_settings(
      "[[run]] of a fit", {{"name", {form::Text{"name"}}, sim::kRequired, "of the run"}});
  return kTable;
}

std::vector<FitRun> read_runs(const TableReader& document) {
  const StudySettings common = read_settings(document);
  std::vector<FitRun> runs;
  for (const Node& node : sim::entries(document, "run")) {
    const TableReader table(node, run_keys(), "[[run]]");
    FitRun run{sim::read_text(table.at("name")), common + read_settings(table)};
    for (const FitRun& other : runs)
      if (other.name == run.name)
        sim::fail(table.at("name"), fmt::format("a second run is called `{}`", run.name));
    runs.push_back(std::move(run));
  }
  if (runs.empty()) runs.push_back({kOnlyRun, common});
  return runs;
}

std::size_t read_run_name(const Node& node, const std::vector<FitRun>& runs) {
  const std::string name = sim::read_text(node);
  std::vector<std::string> names;
  names.reserve(runs.size());
  for (const FitRun& run : runs) names.push_back(run.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    sim::fail(node, fmt::format("no [[run]] `{}`{}", name, sim::suggestion(name, names)));
  return static_cast<std::size_t>(found - names.begin());
}

const KeyTable& measurement_keys() {
  static const KeyTable kTable{
      "[[measurement]] of a fit",
      {{"name", {form::Text{"name"}}, sim::kRequired, "of what was measured"},
       {"run", {form::Text{"name of a run"}}, sim::otherwise("the only one"), "which run shows it"},
       {"column", history_columns(), sim::kRequired, "with its unit; of a list the sum"},
       {"at", {form::Quantity{sim::kTime, sim::kNotNegative}}, sim::kRequired, "when"},
       {"minus",
        {form::Quantity{sim::kTime, sim::kNotNegative}},
        sim::kNone,
        "less the value at this time"},
       {"value",
        {form::Number{sim::kAny}},
        sim::otherwise("or `at_most` or `at_least`"),
        "what was measured, in the column's unit"},
       {"at_most", {form::Number{sim::kAny}}, sim::kNone, "in its place: a bound from above"},
       {"at_least", {form::Number{sim::kAny}}, sim::kNone, "in its place: a bound from below"},
       {"spread", {form::Number{sim::kPositive}}, sim::kRequired, "its standard deviation"},
       {"held_out",
        {form::Boolean{}},
        sim::standard(false),
        "`true`: not fitted, but compared with what comes out"},
       {"group",
        {form::Text{"name"}},
        sim::kNone,
        "with `--cross-validate`: what is left out together"}}};
  return kTable;
}

FitMeasurement read_measurement(const Node& node, const std::vector<FitRun>& runs) {
  const TableReader table(node, measurement_keys(), "[[measurement]]");
  FitMeasurement measurement;
  measurement.name = sim::read_text(table.at("name"));
  if (const Node* run = table.find("run"))
    measurement.run = read_run_name(*run, runs);
  else if (runs.size() > 1)
    table.at("run");
  measurement.columns = read_history_columns(table.at("column"));
  table.read("at", measurement.at);
  table.read("minus", measurement.minus);
  const Node& target = table.exactly_one({"value", "at_most", "at_least"});
  measurement.value = sim::read_number(target, sim::kAny);
  if (&target == table.find("at_most")) measurement.target = FitTarget::AtMost;
  if (&target == table.find("at_least")) measurement.target = FitTarget::AtLeast;
  table.read("spread", measurement.spread);
  table.read("held_out", measurement.held_out);
  table.read("group", measurement.group);
  return measurement;
}

template <class Entry>
void check_new_name(const Node& node, const std::string& name, const std::vector<Entry>& so_far) {
  if (std::any_of(so_far.begin(), so_far.end(), [&](const Entry& e) { return e.name == name; }))
    sim::fail(node.find("name") != nullptr ? *node.find("name") : node,
              fmt::format("a second one is called `{}`", name));
}

/// Every parameter changes something, and every name in braces is one.
void check_use(const Node& root, const Fit& fit) {
  std::vector<std::string> used;
  for (const FitRun& run : fit.runs)
    for (const std::string& text : run.settings.overrides)
      for (const std::string& name : names_in_braces(text)) used.push_back(name);
  const std::vector<std::string> names = parameter_names(fit.parameters);
  for (const std::string& name : used)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw sim::InputError(root.where, fmt::format("`set`: no [[parameter]] `{}`{}", name,
                                                    sim::suggestion(name, names)));
  std::vector<std::string> units;
  for (const FitParameter& parameter : fit.parameters) units.push_back(parameter.unit);
  for (const FitRun& run : fit.runs)
    for (const std::string& text : run.settings.overrides)
      if (const std::string wrong = wrong_unit(text, names, units); !wrong.empty())
        throw sim::InputError(root.where, "`set`: " + wrong);
  for (const FitParameter& parameter : fit.parameters)
    if (parameter.path.empty() && std::find(used.begin(), used.end(), parameter.name) == used.end())
      throw sim::InputError(
          root.where, fmt::format("parameter `{0}` changes nothing; expected its `path`, or a "
                                  "`set` with {{{0}}} in a value",
                                  parameter.name));
}

}  // namespace

const KeyTable& fit_keys() {
  static const KeyTable kTable = [] {
    KeyTable table = with_settings(
        "fit",
        {{"title", {form::Text{"text"}}, sim::otherwise("file name"), "for reports"},
         {"scenario", {form::Text{"path"}}, sim::kRequired, "the scene, from the fit's folder"},
         {"time_limit",
          {form::Quantity{sim::kTime, sim::kPositive}},
          sim::kNone,
          "a run that takes longer is stopped"}});
    const auto add = [&](std::string_view name, const KeyTable& (*keys)(), sim::Absence absence,
                         std::string_view meaning) {
      table.keys.push_back({name, {sim::entries_of({form::Table{keys}})}, absence, meaning});
    };
    add("parameter", parameter_keys, sim::kRequired, "what is fitted");
    add("run", run_keys, sim::otherwise("one run"), "runs of the scene, each with its settings");
    add("measurement", measurement_keys, sim::kRequired, "what was measured");
    return table;
  }();
  return kTable;
}

Fit read_fit(const std::filesystem::path& file) {
  const Node root = sim::read_toml(file);
  const TableReader document(root, fit_keys(), "fit");
  Fit fit;
  fit.file = file;
  fit.name = file.stem().string();
  fit.title = fit.name;
  document.read("title", fit.title);
  fit.scenario = file.parent_path() / sim::read_text(document.at("scenario"));
  document.read("time_limit", fit.time_limit);
  fit.runs = read_runs(document);
  for (const Node& node : sim::read_list(document.at("parameter"), "[[parameter]] tables")) {
    FitParameter parameter = read_parameter(node);
    check_new_name(node, parameter.name, fit.parameters);
    check_new_path(node.where, parameter.path, fit.parameters);
    fit.parameters.push_back(std::move(parameter));
  }
  for (const Node& node : sim::read_list(document.at("measurement"), "[[measurement]] tables")) {
    FitMeasurement measurement = read_measurement(node, fit.runs);
    check_new_name(node, measurement.name, fit.measurements);
    fit.measurements.push_back(std::move(measurement));
  }
  if (std::all_of(fit.measurements.begin(), fit.measurements.end(),
                  [](const FitMeasurement& m) { return m.held_out; }))
    sim::fail(document.at("measurement"), "all are held out: expected one to fit");
  check_use(root, fit);
  return fit;
}

}  // namespace articular::tools
