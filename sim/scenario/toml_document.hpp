#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/base/error.hpp"

/// A TOML text as a plain tree that knows where each value stands (the parser behind it is used in
/// toml_document.cpp only).
namespace articular::sim {

struct Member;

/// A table's members, sorted by key.
struct TomlTable {
  std::vector<Member> members;
};

/// A date or a time of day: valid TOML that no scenario uses.
struct TomlDate {};

/// A value of the document.
struct Node {
  using List = std::vector<Node>;
  std::variant<std::string, std::int64_t, double, bool, TomlDate, List, TomlTable> value;
  std::string name;  // its key, or "key[2]" for an element of a list, for messages
  Location where;

  const std::string* text() const { return std::get_if<std::string>(&value); }
  const List* list() const { return std::get_if<List>(&value); }
  List* list() { return std::get_if<List>(&value); }
  const TomlTable* table() const { return std::get_if<TomlTable>(&value); }
  TomlTable* table() { return std::get_if<TomlTable>(&value); }
  /// The member of a table, or nullptr if there is none or this is no table.
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
};

struct Member {
  std::string key;
  Location key_where;
  Node node;
};

/// Reads a TOML file.
/// @throws InputError  if it cannot be read or is not valid TOML
Node read_toml(const std::filesystem::path& file);

/// The values of a tree as one text, without comments, layout and places: equal for equal
/// documents.
std::string plain_text(const Node& node);

/// A value as it would stand behind `key = `; text that is no TOML value is taken as a string, so
/// that `0.1 s` needs no quotes. Every node of it gets the name and location given.
Node parse_toml_value(std::string_view text, const std::string& name, const Location& where);

}  // namespace articular::sim
