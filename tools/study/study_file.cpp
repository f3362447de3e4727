#include "tools/study/study_file.hpp"

#include <algorithm>

#include "sim/scenario/toml_reader.hpp"
#include "tools/study/braces.hpp"
#include "tools/study/parameter_path.hpp"
#include "tools/study/population_file.hpp"

namespace articular::tools {
namespace {

using sim::Key;
using sim::KeyTable;
using sim::Node;
using sim::TableReader;
namespace form = sim::form;

constexpr int kMostRepeats = 1000;
constexpr std::size_t kMostReferences = 3;

/// As a name of a case: `0.5 ms`, `[8, 2, 2]`.
std::string short_name(const Node& node) {
  return node.text() != nullptr ? *node.text() : toml_text(node);
}

const KeyTable& choice_keys() {
  static const KeyTable kTable =
      with_settings("[[knob.choice]] of a study",
                    {{"name", {form::Text{"name"}}, sim::kRequired, "of the choice"}});
  return kTable;
}

const KeyTable& knob_keys() {
  static const KeyTable kTable{
      "[[knob]] of a study",
      {{"name", {form::Text{"name"}}, sim::kRequired, "of what is varied"},
       {"path", {form::Text{"path of a value"}}, sim::otherwise("or `choice`"), "what is varied"},
       {"values",
        {sim::list_of({form::Anything{}})},
        sim::otherwise("required with `path`"),
        "a case for each"},
       {"choice",
        {sim::entries_of({form::Table{choice_keys}})},
        sim::otherwise("or `path`"),
        "a case for each, of several settings at once"}}};
  return kTable;
}

const KeyTable& case_keys() {
  static const KeyTable kTable = with_settings(
      "[[case]] of a study", {{"name", {form::Text{"name"}}, sim::kRequired, "of the case"}});
  return kTable;
}

const KeyTable& output_keys() {
  static const KeyTable kTable{
      "[[output]] of a study",
      {{"column", {form::Text{"column of history.csv"}}, sim::kRequired, "with its unit"},
       {"name", {form::Text{"name"}}, sim::otherwise("the column"), "of the output"},
       {"value",
        {form::Choice{{{"last", StudyValue::Last},
                       {"change", StudyValue::Change},
                       {"largest", StudyValue::Largest},
                       {"smallest", StudyValue::Smallest},
                       {"mean", StudyValue::Mean},
                       {"history", StudyValue::History}}}},
        sim::standard("last"),
        "what of the column is compared; `change`: from the first row to the last"},
       {"scale",
        {form::Number{sim::kPositive}},
        sim::otherwise("the right value, or its range"),
        "what counts as an error of 1, in the column's unit"},
       {"exact",
        {form::Number{sim::kAny}},
        sim::otherwise("by `[[reference]]`"),
        "the right value, in the column's unit"}}};
  return kTable;
}

const KeyTable& reference_keys() {
  static const KeyTable kTable = with_settings(
      "[[reference]] of a study", {{"size",
                                    {form::Number{sim::kPositive}},
                                    sim::otherwise("required of several"),
                                    "of step or element, relative to the other references"}});
  return kTable;
}

template <class Entry>
void check_new(const Node& node, const char* what, const std::string& name,
               const std::vector<Entry>& so_far) {
  if (std::any_of(so_far.begin(), so_far.end(), [&](const Entry& e) { return e.name == name; }))
    sim::fail(node, fmt::format("a second {} is called `{}`", what, name));
}

StudyKnob read_knob(const Node& node) {
  const TableReader table(node, knob_keys(), "[[knob]]");
  StudyKnob knob;
  knob.name = sim::read_text(table.at("name"));
  if (&table.exactly_one({"path", "choice"}) == table.find("path")) {
    knob.path = sim::read_text(table.at("path"));
    for (const Node& value : sim::read_list(table.at("values"), "a list of values")) {
      check_new(value, "value", short_name(value), knob.choices);
      knob.choices.push_back({short_name(value), {{knob.path + "=" + toml_text(value)}, {}, {}}});
    }
    return knob;
  }
  table.refuse({"values"}, "they go with `path`");
  for (const Node& entry : sim::read_list(table.at("choice"), "[[knob.choice]] tables")) {
    const TableReader choice(entry, choice_keys(), "[[knob.choice]]");
    const std::string name = sim::read_text(choice.at("name"));
    check_new(choice.at("name"), "choice", name, knob.choices);
    knob.choices.push_back({name, read_settings(choice)});
  }
  return knob;
}

StudyOutput read_output(const Node& node) {
  const TableReader table(node, output_keys(), "[[output]]");
  StudyOutput output;
  output.column = sim::read_text(table.at("column"));
  output.name = output.column;
  table.read("name", output.name);
  table.read("value", output.value);
  table.read("scale", output.scale);
  table.read("exact", output.exact);
  if (output.exact && output.value == StudyValue::History)
    sim::fail(table.at("exact"), "a history has no single right value; expected a [[reference]]");
  if (output.exact == 0 && !output.scale)
    sim::fail(table.at("exact"), "expected a `scale` too: an error relative to 0 says nothing");
  return output;
}

std::vector<StudyReference> read_references(const TableReader& document) {
  std::vector<StudyReference> references;
  const Node::List& list = sim::entries(document, "reference");
  for (const Node& node : list) {
    const TableReader table(node, reference_keys(), "[[reference]]");
    StudyReference reference;
    if (list.size() > 1)
      reference.size = sim::read_real(table.at("size"), reference_keys().find("size")->type);
    else
      table.refuse({"size"}, "sizes of several references are compared");
    reference.settings = read_settings(table);
    for (const StudyReference& other : references)
      if (other.size == reference.size)
        sim::fail(table.at("size"), "two references have this size; expected different ones");
    if (references.size() == kMostReferences)
      sim::fail(node, "expected at most three references: Richardson's extrapolation takes three");
    references.push_back(std::move(reference));
  }
  std::sort(references.begin(), references.end(),
            [](const StudyReference& a, const StudyReference& b) { return a.size < b.size; });
  return references;
}

void check_references(const Node& root, const Study& study) {
  if (study.is_sweep()) {
    for (std::size_t o = 0; o < study.outputs.size(); ++o)
      if (study.outputs[o].value == StudyValue::History || study.outputs[o].scale)
        sim::fail((*root.find("output")->list())[o],
                  "a `scale`, or the difference from a history, needs a [[reference]], and the "
                  "study has none");
    return;
  }
  const bool all_exact = std::all_of(study.outputs.begin(), study.outputs.end(),
                                     [](const StudyOutput& output) { return output.exact; });
  if (all_exact && !study.references.empty())
    sim::fail(*root.find("reference"), "every output has an `exact` value: no reference is needed");
  if (!all_exact && study.references.empty())
    throw sim::InputError(root.where,
                          "what is right is known of some outputs only; expected [[reference]] "
                          "(one converged run, or three of different `size` to extrapolate from), "
                          "or `exact` in every [[output]], or in none");
}

/// Every name in braces is a parameter, and every parameter changes something.
void check_population(const TableReader& document, const Study& study) {
  const std::vector<PopulationParameter>& parameters = study.population->parameters;
  std::vector<std::string> names, units, used;
  for (const PopulationParameter& parameter : parameters) {
    names.push_back(parameter.name);
    units.push_back(parameter.unit);
  }
  const auto look = [&](const std::vector<std::string>& texts, const char* key) {
    for (const std::string& text : texts) {
      for (const std::string& name : names_in_braces(text)) {
        if (std::find(names.begin(), names.end(), name) == names.end())
          sim::fail(document.at(key),
                    fmt::format("no [[parameter]] `{}`{}", name, sim::suggestion(name, names)));
        used.push_back(name);
      }
      const std::string wrong = wrong_unit(text, names, units);
      if (!wrong.empty()) sim::fail(document.at(key), wrong);
    }
  };
  look(study.settings.overrides, "set");
  look(study.settings.prepare, "prepare");
  look(study.command, "command");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const PopulationParameter& parameter = parameters[i];
    const Node& node = (*document.find("parameter")->list())[i];
    if (!study.command.empty() && !parameter.path.empty())
      sim::fail(*node.find("path"), "a `command` has no values with paths; expected {" +
                                        parameter.name + "} in one of its words");
    if (parameter.path.empty() && std::find(used.begin(), used.end(), parameter.name) == used.end())
      sim::fail(node, fmt::format("parameter `{0}` changes nothing; expected its `path`, or "
                                  "{{{0}}} in `set`, `prepare` or `command`",
                                  parameter.name));
  }
  for (std::size_t o = 0; o < study.outputs.size(); ++o)
    if (study.outputs[o].value == StudyValue::History || study.outputs[o].scale ||
        study.outputs[o].exact)
      sim::fail((*document.find("output")->list())[o],
                "`exact`, `scale` and the difference from a history compare with what is right, "
                "and a [population] is compared with nothing");
}

}  // namespace

const KeyTable& study_keys() {
  static const KeyTable kTable = [] {
    KeyTable table = with_settings(
        "study", {{"title", {form::Text{"text"}}, sim::otherwise("file name"), "for reports"},
                  {"scenario",
                   {form::Text{"path"}},
                   sim::otherwise("or `command`"),
                   "the base, from the study's folder"},
                  {"command",
                   {sim::list_of({form::Text{"text"}})},
                   sim::otherwise("or `scenario`"),
                   "of a population: a program that writes history.csv where it is started"},
                  {"repeats",
                   {form::Integer{1, kMostRepeats}},
                   sim::standard(1.0),
                   "runs of each case; times are medians"},
                  {"combine",
                   {form::Choice{{{"each", false}, {"all", true}}}},
                   sim::standard("each"),
                   "each choice of each knob alone, or every combination of choices"},
                  {"time_limit",
                   {form::Quantity{sim::kTime, sim::kPositive}},
                   sim::kNone,
                   "a run that takes longer is stopped"}});
    const auto add = [&](std::string_view name, const KeyTable& (*keys)(), sim::Absence absence,
                         std::string_view meaning) {
      table.keys.push_back({name, {sim::entries_of({form::Table{keys}})}, absence, meaning});
    };
    add("knob", knob_keys, sim::kNone, "what is varied");
    add("case", case_keys, sim::kNone, "a case beside those of the knobs");
    add("output", output_keys, sim::kRequired, "what is compared");
    table.keys.push_back({"population",
                          {form::Table{population_keys}},
                          sim::kNone,
                          "cases are drawn at random, and nothing says what is right"});
    add("parameter", population_parameter_keys, sim::kNone, "what is drawn for a population");
    add("correlation", population_correlation_keys, sim::kNone, "of two parameters");
    add("reference", reference_keys, sim::otherwise("or `exact` of every output; neither: a sweep"),
        "what is right: a converged run, or three to extrapolate from");
    return table;
  }();
  return kTable;
}

bool Study::is_sweep() const {
  return references.empty() && std::none_of(outputs.begin(), outputs.end(),
                                            [](const StudyOutput& output) { return output.exact; });
}

Study read_study(const std::filesystem::path& file) {
  const Node root = sim::read_toml(file);
  const TableReader document(root, study_keys(), "study");
  Study study;
  study.file = file;
  study.name = file.stem().string();
  study.title = study.name;
  document.read("title", study.title);
  if (&document.exactly_one({"scenario", "command"}) == document.find("scenario"))
    study.scenario = file.parent_path() / sim::read_text(document.at("scenario"));
  else
    for (const Node& word : sim::read_list(document.at("command"), "a list of texts"))
      study.command.push_back(sim::read_text(word));
  study.settings = read_settings(document);
  document.read("repeats", study.repeats);
  document.read("combine", study.every_combination);
  document.read("time_limit", study.time_limit);
  for (const Node& node : sim::entries(document, "knob")) {
    StudyKnob knob = read_knob(node);
    check_new(*node.find("name"), "knob", knob.name, study.knobs);
    check_new_path(node.where, knob.path, study.knobs);
    study.knobs.push_back(std::move(knob));
  }
  for (const Node& node : sim::entries(document, "case")) {
    const TableReader table(node, case_keys(), "[[case]]");
    const std::string name = sim::read_text(table.at("name"));
    check_new(table.at("name"), "case", name, study.extras);
    study.extras.push_back({name, read_settings(table)});
  }
  sim::read_list(document.at("output"), "[[output]] tables");
  for (const Node& node : sim::entries(document, "output")) {
    StudyOutput output = read_output(node);
    check_new(node, "output", output.name, study.outputs);
    study.outputs.push_back(std::move(output));
  }
  study.references = read_references(document);
  if (document.find("population") == nullptr) {
    document.refuse({"parameter", "correlation", "command"}, "they go with [population]");
    check_references(root, study);
    return study;
  }
  document.refuse({"knob", "case", "reference", "repeats", "combine"},
                  "a [population] is drawn, and nothing is compared with it");
  if (!study.command.empty())
    document.refuse({"set", "threads", "prepare"}, "they go with `scenario`");
  study.population = read_population(document, file.parent_path());
  check_population(document, study);
  return study;
}

}  // namespace articular::tools
