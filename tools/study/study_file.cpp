#include "tools/study/study_file.hpp"

#include <algorithm>

#include "sim/scenario/toml_reader.hpp"

namespace articular::tools {
namespace {

using sim::Node;
using sim::TableReader;

constexpr int kMostRepeats = 1000;
constexpr std::size_t kMostReferences = 3;

/// As a name of a case: `0.5 ms`, `[8, 2, 2]`.
std::string short_name(const Node& node) {
  return node.text() != nullptr ? *node.text() : toml_text(node);
}

template <class Entry>
void check_new(const Node& node, const char* what, const std::string& name,
               const std::vector<Entry>& so_far) {
  if (std::any_of(so_far.begin(), so_far.end(), [&](const Entry& e) { return e.name == name; }))
    sim::fail(node, fmt::format("a second {} is called `{}`", what, name));
}

StudyKnob read_knob(const Node& node) {
  const TableReader table(node, "[[knob]]", {"name", "path", "values", "choice"});
  StudyKnob knob;
  knob.name = sim::read_text(table.at("name"));
  if (&table.exactly_one({"path", "choice"}) == table.find("path")) {
    const std::string path = sim::read_text(table.at("path"));
    for (const Node& value : sim::read_list(table.at("values"), "a list of values")) {
      check_new(value, "value", short_name(value), knob.choices);
      knob.choices.push_back({short_name(value), {{path + "=" + toml_text(value)}, {}, {}}});
    }
    return knob;
  }
  table.refuse({"values"}, "they go with `path`");
  for (const Node& entry : sim::read_list(table.at("choice"), "[[knob.choice]] tables")) {
    const TableReader choice(entry, "[[knob.choice]]", {"name", "set", "threads", "prepare"});
    const std::string name = sim::read_text(choice.at("name"));
    check_new(choice.at("name"), "choice", name, knob.choices);
    knob.choices.push_back({name, read_settings(choice)});
  }
  return knob;
}

StudyOutput read_output(const Node& node) {
  const TableReader table(node, "[[output]]", {"name", "column", "value", "scale", "exact"});
  StudyOutput output;
  output.column = sim::read_text(table.at("column"));
  output.name = output.column;
  table.may("name", output.name, sim::read_text);
  table.may("value", output.value, [](const Node& n) {
    return sim::read_choice<StudyValue>(n, {{"last", StudyValue::Last},
                                            {"change", StudyValue::Change},
                                            {"largest", StudyValue::Largest},
                                            {"smallest", StudyValue::Smallest},
                                            {"mean", StudyValue::Mean},
                                            {"history", StudyValue::History}});
  });
  table.may("scale", output.scale, sim::as_number(sim::kPositive));
  table.may("exact", output.exact, sim::as_number(sim::kAny));
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
    const TableReader table(node, "[[reference]]", {"size", "set", "threads", "prepare"});
    StudyReference reference;
    if (list.size() > 1)
      reference.size = sim::read_number(table.at("size"), sim::kPositive);
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
  const bool all_exact = std::all_of(study.outputs.begin(), study.outputs.end(),
                                     [](const StudyOutput& output) { return output.exact; });
  if (all_exact && !study.references.empty())
    sim::fail(*root.find("reference"), "every output has an `exact` value: no reference is needed");
  if (!all_exact && study.references.empty())
    throw sim::InputError(root.where,
                          "a study needs to know what is right; expected [[reference]] (one "
                          "converged run, or three of different `size` to extrapolate from), or "
                          "`exact` in every [[output]]");
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  const Node root = sim::read_toml(file);
  const TableReader document(root, "study",
                             {"title", "scenario", "set", "threads", "prepare", "repeats",
                              "combine", "time_limit", "knob", "case", "output", "reference"});
  Study study;
  study.file = file;
  study.name = file.stem().string();
  study.title = study.name;
  document.may("title", study.title, sim::read_text);
  study.scenario = file.parent_path() / sim::read_text(document.at("scenario"));
  study.settings = read_settings(document);
  document.may("repeats", study.repeats,
               [](const Node& n) { return sim::read_integer(n, 1, kMostRepeats); });
  document.may("combine", study.every_combination, [](const Node& n) {
    return sim::read_choice<bool>(n, {{"each", false}, {"all", true}});
  });
  document.may("time_limit", study.time_limit, sim::as_quantity(sim::kTime, sim::kPositive));
  for (const Node& node : sim::entries(document, "knob")) {
    StudyKnob knob = read_knob(node);
    check_new(*node.find("name"), "knob", knob.name, study.knobs);
    study.knobs.push_back(std::move(knob));
  }
  for (const Node& node : sim::entries(document, "case")) {
    const TableReader table(node, "[[case]]", {"name", "set", "threads", "prepare"});
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
  check_references(root, study);
  return study;
}

}  // namespace articular::tools
