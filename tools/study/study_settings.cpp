#include "tools/study/study_settings.hpp"

namespace articular::tools {
namespace {

constexpr int kMostCaseThreads = 256;

std::vector<std::string> read_texts(const sim::Node& node) {
  std::vector<std::string> texts;
  for (const sim::Node& element : sim::read_list(node, "a list of texts"))
    texts.push_back(sim::read_text(element));
  return texts;
}

}  // namespace

StudySettings operator+(StudySettings settings, const StudySettings& more) {
  settings.overrides.insert(settings.overrides.end(), more.overrides.begin(), more.overrides.end());
  if (more.threads) settings.threads = more.threads;
  if (!more.prepare.empty()) settings.prepare = more.prepare;
  settings.reproducible |= more.reproducible;
  return settings;
}

StudySettings read_settings(const sim::TableReader& table) {
  StudySettings settings;
  if (const sim::Node* set = table.find("set")) {
    if (set->table() == nullptr)
      sim::fail(*set, "expected a table of paths and values, { \"integrator.step\" = \"1 ms\" }");
    for (const sim::Member& member : set->table()->members)
      settings.overrides.push_back(member.key + "=" + toml_text(member.node));
  }
  table.read("threads", settings.threads);
  table.read("prepare", settings.prepare, read_texts);
  return settings;
}

sim::KeyTable with_settings(std::string_view name, std::vector<sim::Key> keys) {
  keys.push_back({"set",
                  {sim::form::Map{"path of a value", {{sim::form::Anything{}}}}},
                  sim::kNone,
                  "values that it changes, as `articular run --set PATH=VALUE`"});
  keys.push_back({"threads",
                  {sim::form::Integer{1, kMostCaseThreads}},
                  sim::otherwise("1"),
                  "as of `articular run`"});
  keys.push_back({"prepare",
                  {sim::list_of({sim::form::Text{"text"}})},
                  sim::kNone,
                  "arguments of an `articular` command that makes meshes"});
  return {name, std::move(keys)};
}

std::string toml_text(const sim::Node& node) {
  if (const std::string* text = node.text()) {
    std::string quoted = "\"";
    for (const char c : *text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
    return quoted + '"';
  }
  if (const auto* integer = std::get_if<std::int64_t>(&node.value))
    return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&node.value)) return fmt::format("{}", *number);
  if (const auto* boolean = std::get_if<bool>(&node.value)) return *boolean ? "true" : "false";
  std::vector<std::string> parts;
  if (const sim::Node::List* list = node.list()) {
    for (const sim::Node& element : *list) parts.push_back(toml_text(element));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const sim::TomlTable* table = node.table()) {
    for (const sim::Member& member : table->members)
      parts.push_back(fmt::format("\"{}\" = {}", member.key, toml_text(member.node)));
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  sim::fail(node, "a date is no value of a scenario");
}

}  // namespace articular::tools
