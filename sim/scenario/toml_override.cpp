#include "sim/scenario/toml_override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/base/message_text.hpp"

namespace articular::sim {
namespace {

/// "a."b.c".d" -> a, b.c, d
std::vector<std::string> split_path(std::string_view path, const Location& where) {
  std::vector<std::string> parts(1);
  bool inside = false;
  for (const char c : path) {
    if (c == '"')
      inside = !inside;
    else if (c == '.' && !inside)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (const std::string& part : parts)
    if (part.empty())
      throw InputError(where, "expected PATH=VALUE with a path such as `integrator.step`");
  return parts;
}

/// The entry of a list by name or number.
Node& list_entry(Node& list, const std::string& key, const Location& where) {
  std::vector<std::string> names;
  for (Node& entry : *list.list()) {
    const Node* name = entry.find("name");
    if (name == nullptr || name->text() == nullptr) continue;
    if (*name->text() == key) return entry;
    names.push_back(*name->text());
  }
  const std::size_t count = list.list()->size();
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  const bool is_number = error == std::errc() && end == key.data() + key.size();
  if (is_number && number < count) return (*list.list())[number];
  if (is_number || names.empty())
    throw InputError(where, fmt::format("no {} `{}`; there {} {}, numbered from 0", list.name,
                                        one_line(key), count == 1 ? "is" : "are", count));
  throw InputError(where,
                   fmt::format("no {} `{}`{}", list.name, one_line(key), suggestion(key, names)));
}

Node& add_member(Node& table, const std::string& key, const Location& where) {
  std::vector<Member>& members = table.table()->members;
  const auto after =
      std::upper_bound(members.begin(), members.end(), key,
                       [](const std::string& a, const Member& b) { return a < b.key; });
  return members.insert(after, {key, where, Node{TomlTable{}, key, where}})->node;
}

/// The child of a node, which is made if it is a member of a table that was absent.
Node& child(Node& node, const std::string& key, bool is_root, bool is_last, const Location& where) {
  if (node.list() != nullptr) return list_entry(node, key, where);
  if (node.table() == nullptr)
    throw InputError(where, fmt::format("`{}` is a single value, it has no part `{}`",
                                        one_line(node.name), one_line(key)));
  if (Node* member = node.find(key)) return *member;
  const bool is_entry_list =
      is_root && std::find(kEntryLists.begin(), kEntryLists.end(), key) != kEntryLists.end();
  if (is_entry_list && !is_last)
    throw InputError(where, fmt::format("the scenario has no [[{}]]", key));
  return add_member(node, key, where);
}

}  // namespace

Override read_override(std::string_view text) {
  const Location where{"--set " + one_line(text)};
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    throw InputError(where, "expected PATH=VALUE, such as `duration=0.1 s`");
  return {split_path(trimmed(text.substr(0, equals)), where),
          std::string(trimmed(text.substr(equals + 1))), where};
}

void apply_override(Node& document, const Override& change) {
  const std::vector<std::string>& path = change.path;
  Node* node = &document;
  for (std::size_t i = 0; i < path.size(); ++i)
    node = &child(*node, path[i], i == 0, i + 1 == path.size(), change.where);
  *node = parse_toml_value(change.value, node->name, change.where);
}

}  // namespace articular::sim
