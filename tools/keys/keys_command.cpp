#include "tools/keys/keys_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "tools/fit/fit_file.hpp"
#include "tools/keys/key_reference.hpp"
#include "tools/keys/key_schema.hpp"
#include "tools/study/study_file.hpp"
#include "tools/track/track_file.hpp"

namespace articular::tools {
namespace {

struct KeysArguments {
  std::string name;
  bool markdown = false;
  std::string schema_of;
};

std::vector<KeyDocument> documents() {
  return {{"Scenario files", "What they mean together, with examples: [README.md](README.md).",
           key_sections(sim::scenario_keys())},
          {"Study files", "How to use them: [articular study](../tools/study/README.md).",
           key_sections(study_keys())},
          {"Fit files", "How to use them: [articular fit](../tools/fit/README.md).",
           key_sections(fit_keys())},
          {"Track files", "How to use them: [articular track](../tools/track/README.md).",
           key_sections(track_keys())}};
}

std::vector<KeySection> all_sections() {
  std::vector<KeySection> sections;
  for (KeyDocument& document : documents())
    std::move(document.sections.begin(), document.sections.end(), std::back_inserter(sections));
  return sections;
}

/// "output" is both [output] and "[[output]] of a study", which "study" is too.
bool is_called(const KeySection& section, const std::string& name) {
  const std::string own = without_brackets(section.name);
  return own == name || own.starts_with(name + " of a ") || own.ends_with(" of a " + name);
}

std::vector<std::string> parts_of(std::string_view path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// Of "body.material.element" the table of `element`: sections that the key before it leads to.
std::vector<KeySection> sections_at(const std::vector<std::string>& path,
                                    const std::vector<KeySection>& all) {
  std::vector<KeySection> here = {all.front()};  // the scenario itself
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    std::vector<std::string> names;
    for (const KeySection& section : here)
      for (const KeyRow& row : key_rows(section))
        if (row.key.name == path[i])
          for (std::string& name : sections_of(row.key.type)) names.push_back(std::move(name));
    here.clear();
    for (const KeySection& section : all)
      if (std::find(names.begin(), names.end(), section.name) != names.end() ||
          (i == 0 && names.empty() && is_called(section, path[0])))
        here.push_back(section);
  }
  return here;
}

bool has(const KeySection& section, std::string_view key) {
  const std::vector<KeyRow> rows = key_rows(section);
  return std::any_of(rows.begin(), rows.end(),
                     [&](const KeyRow& row) { return row.key.name == key; });
}

[[noreturn]] void fail_unknown(const std::string& name, const std::vector<KeySection>& all) {
  std::vector<std::string> known;
  for (const KeySection& section : all) {
    known.push_back(without_brackets(section.name));
    for (const KeyRow& row : key_rows(section)) known.emplace_back(row.key.name);
  }
  const std::string near = sim::nearest_name(parts_of(name).back(), known);
  throw sim::InputError(fmt::format("no table and no key is called {}; {}", sim::in_ticks(name),
                                    near.empty()
                                        ? "`articular keys` lists all"
                                        : fmt::format("did you mean {}?", sim::in_ticks(near))));
}

/// A key of a section, and the tables that its values are.
std::string key_as_text(const KeySection& section, const std::string& key,
                        const std::vector<KeySection>& all) {
  std::vector<std::string> names;
  for (const KeyRow& row : key_rows(section))
    if (row.key.name == key)
      for (std::string& name : sections_of(row.key.type)) names.push_back(std::move(name));
  std::string text = keys_as_text(section, key) + "\n";
  for (const KeySection& table : all)
    if (std::find(names.begin(), names.end(), table.name) != names.end())
      text += keys_as_text(table) + "\n";
  return text;
}

/// The tables of a name, else the key at a path, else all keys of a name.
std::string look_up(const std::string& name) {
  const std::vector<KeySection> all = all_sections();
  std::string text;
  for (const KeySection& section : all)
    if (is_called(section, name)) text += keys_as_text(section) + "\n";
  if (!text.empty()) return text;
  const std::vector<std::string> path = parts_of(name);
  for (const KeySection& section : path.size() == 1 ? all : sections_at(path, all))
    if (has(section, path.back())) text += key_as_text(section, path.back(), all);
  if (text.empty()) fail_unknown(name, all);
  return text;
}

std::string overview() {
  std::string text;
  for (const KeySection& section : all_sections()) text += keys_in_short(section);
  return text + "\n* is required. `articular keys NAME` tells more of a table or a key.\n";
}

std::string answer(const KeysArguments& arguments) {
  if (arguments.schema_of == "scenario")
    return json_schema(sim::scenario_keys(), "A scenario of articular");
  if (arguments.schema_of == "study") return json_schema(study_keys(), "A study of articular");
  if (arguments.schema_of == "fit") return json_schema(fit_keys(), "A fit of articular");
  if (arguments.schema_of == "track") return json_schema(track_keys(), "A track of articular");
  if (arguments.markdown) return keys_as_markdown(documents());
  return arguments.name.empty() ? overview() : look_up(arguments.name);
}

}  // namespace

void add_keys_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<KeysArguments>();
  CLI::App* command = app.add_subcommand(
      "keys",
      "Say what scenario, study, fit and track files may hold: all keys, with type, "
      "unit, range, default and meaning");
  CLI::Option* name = command->add_option(
      "name", arguments->name,
      "A table (integrator, body, material), a key (young_modulus), or the path of one "
      "(body.material.element)");
  CLI::Option* markdown =
      command->add_flag("--markdown", arguments->markdown, "All of it as a page in Markdown");
  command
      ->add_option("--json-schema", arguments->schema_of,
                   "A JSON schema for editors, of files of this kind [scenario]")
      ->type_name("scenario|study|fit|track")
      ->expected(0, 1)
      ->default_str("scenario")
      ->check(CLI::IsMember({"scenario", "study", "fit", "track"}))
      ->excludes(name)
      ->excludes(markdown);
  markdown->excludes(name);
  command->footer(
      "Without a name: each table and its keys in short. The program reads files by the same\n"
      "tables, so what this prints is what it takes.\n"
      "    articular keys integrator.step\n"
      "    articular keys --json-schema > scenario.schema.json");
  command->callback([arguments, &exit_code] {
    fmt::print("{}", answer(*arguments));
    exit_code = 0;
  });
}

}  // namespace articular::tools
