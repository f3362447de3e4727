#include "sim/scenario/toml_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <optional>
#include <system_error>

#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "sim/scenario/toml_key_depth.hpp"

namespace articular::sim {
namespace {

constexpr int kMostParts = 100;  // of a dotted key with those around it

/// Copies the parser's tree. With `fixed` set, every node stands there instead of where it was
/// parsed.
class Copier {
 public:
  Copier(std::string file, std::optional<Location> fixed)
      : file_(std::move(file)), fixed_(std::move(fixed)) {}

  Node copy(const toml::node& from, const std::string& name) const {
    Node node;
    node.name = name;
    node.where = location(from.source());
    if (const auto* text = from.as_string())
      node.value = text->get();
    else if (const auto* integer = from.as_integer())
      node.value = std::int64_t{integer->get()};
    else if (const auto* number = from.as_floating_point())
      node.value = number->get();
    else if (const auto* boolean = from.as_boolean())
      node.value = boolean->get();
    else if (const auto* list = from.as_array())
      node.value = copy(*list, name);
    else if (const auto* table = from.as_table())
      node.value = copy(*table);
    else
      node.value = TomlDate{};
    return node;
  }

 private:
  Location location(const toml::source_region& source) const {
    if (fixed_) return *fixed_;
    return {file_, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
  }

  Node::List copy(const toml::array& from, const std::string& name) const {
    Node::List list;
    for (const toml::node& element : from)
      list.push_back(copy(element, fmt::format("{}[{}]", name, list.size())));
    return list;
  }

  TomlTable copy(const toml::table& from) const {
    TomlTable table;
    for (const auto& [key, element] : from) {
      const std::string name(key.str());
      table.members.push_back({name, location(key.source()), copy(element, name)});
    }
    return table;
  }

  std::string file_;
  std::optional<Location> fixed_;
};

std::string read_text(const std::filesystem::path& file) {
  const Location where{file.string()};
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError(where, "expected a scenario file, found a folder");
  return file_bytes(file);
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  if (const TomlTable* members = table())
    for (const Member& member : members->members)
      if (member.key == key) return &member.node;
  return nullptr;
}

Node* Node::find(std::string_view key) {
  return const_cast<Node*>(static_cast<const Node*>(this)->find(key));
}

Node read_toml(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  if (const KeyDepth key = deepest_key(text); key.parts > kMostParts)
    throw InputError(
        {file.string(), key.line},
        fmt::format("a key has {} parts, those of the keys around it counted; expected {} at most",
                    key.parts, kMostParts));
  try {
    const toml::table table = toml::parse(text);
    return Copier(file.string(), std::nullopt).copy(table, "the scenario");
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw InputError({file.string(), static_cast<int>(at.line), static_cast<int>(at.column)},
                     "not valid TOML: " + one_line(error.description()));
  }
}

std::string plain_text(const Node& node) {
  if (const std::string* text = node.text()) return fmt::format("{}\"{}\"", text->size(), *text);
  if (const auto* integer = std::get_if<std::int64_t>(&node.value))
    return fmt::format("{}", *integer);
  if (const auto* number = std::get_if<double>(&node.value)) return fmt::format("{}", *number);
  if (const auto* boolean = std::get_if<bool>(&node.value)) return *boolean ? "true" : "false";
  std::string result;
  if (const Node::List* list = node.list()) {
    for (const Node& element : *list) result += plain_text(element) + ",";
    return "[" + result + "]";
  }
  if (const TomlTable* table = node.table()) {
    for (const Member& member : table->members)
      result +=
          fmt::format("{}\"{}\"=", member.key.size(), member.key) + plain_text(member.node) + ",";
    return "{" + result + "}";
  }
  return "date";
}

Node parse_toml_value(std::string_view text, const std::string& name, const Location& where) {
  Node node{std::string(text), name, where};
  if (deepest_key(text).parts > kMostParts) return node;
  try {
    const toml::table table = toml::parse("v = " + std::string(text));
    if (table.size() == 1) node = Copier("", where).copy(*table.get("v"), name);
  } catch (const toml::parse_error&) {
    // Not TOML: the string it is.
  }
  return node;
}

}  // namespace articular::sim
