#include "sim/scenario/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace articular::sim {
namespace {

bool is_number(const Node& node) {
  return std::holds_alternative<std::int64_t>(node.value) ||
         std::holds_alternative<double>(node.value);
}

}  // namespace

std::string found(const Node& node) {
  struct Describe {
    std::string operator()(const std::string& text) const { return in_quotes(text); }
    std::string operator()(std::int64_t number) const {
      return fmt::format("the number {}", number);
    }
    std::string operator()(double number) const { return fmt::format("the number {}", number); }
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(const TomlDate&) const { return "a date or time of day"; }
    std::string operator()(const Node::List& list) const {
      return fmt::format("a list of {}", list.size());
    }
    std::string operator()(const TomlTable&) const { return "a table"; }
  };
  return std::visit(Describe{}, node.value);
}

void fail(const Node& node, const std::string& message) {
  throw InputError(node.where, fmt::format("`{}`: {}", one_line(node.name), one_line(message)));
}

void check_range(const Node& node, double value, const Range& range) {
  const bool inside = range.excludes_ends ? value > range.min && value < range.max
                                          : value >= range.min && value <= range.max;
  if (inside && std::isfinite(value)) return;
  const std::string subject =
      range.subject.empty() ? fmt::format("`{}`", one_line(node.name)) : std::string(range.subject);
  const double* bare = std::get_if<double>(&node.value);
  const std::string shown = bare != nullptr ? fmt::format("{}", *bare)
                            : std::holds_alternative<std::int64_t>(node.value)
                                ? fmt::format("{}", std::get<std::int64_t>(node.value))
                                : found(node);
  throw InputError(node.where,
                   fmt::format("{} {}, found {}", subject,
                               std::isfinite(value) ? range.rule : "must be finite", shown));
}

std::string read_text(const Node& node) {
  if (node.text() == nullptr) fail(node, "expected text in quotes, found " + found(node));
  if (node.text()->empty()) fail(node, "expected text, found an empty string");
  return *node.text();
}

bool read_boolean(const Node& node) {
  if (const bool* value = std::get_if<bool>(&node.value)) return *value;
  fail(node, "expected true or false, found " + found(node));
}

double read_number(const Node& node, const Range& range) {
  double value = 0;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value))
    value = static_cast<double>(*integer);
  else if (const auto* number = std::get_if<double>(&node.value))
    value = *number;
  else
    fail(node, "expected a number without unit or quotes, found " + found(node));
  check_range(node, value, range);
  return value;
}

int read_integer(const Node& node, int min, int max) {
  const auto* value = std::get_if<std::int64_t>(&node.value);
  if (value == nullptr || *value < min || *value > max)
    fail(node,
         fmt::format("expected a whole number from {} to {}, found {}", min, max, found(node)));
  return static_cast<int>(*value);
}

double read_quantity(const Node& node, const QuantityKind& kind, const Range& range) {
  if (is_number(node))
    fail(node, fmt::format("expected a quantity with its unit, such as {}, found {}",
                           in_quotes(kind.example), found(node)));
  if (node.text() == nullptr)
    fail(node, fmt::format("expected {} such as {}, found {}", kind.noun, in_quotes(kind.example),
                           found(node)));
  double value = 0;
  try {
    value = parse_quantity(*node.text(), kind);
  } catch (const std::invalid_argument& error) {
    fail(node, error.what());
  }
  check_range(node, value, range);
  return value;
}

Eigen::Vector3d read_vector(const Node& node, const QuantityKind& kind) {
  if (node.text() == nullptr)
    fail(node,
         fmt::format("expected {} as three numbers and one unit in quotes, such as {}, found {}",
                     kind.noun, in_quotes(kind.vector_example), found(node)));
  try {
    return parse_vector(*node.text(), kind);
  } catch (const std::invalid_argument& error) {
    fail(node, error.what());
  }
}

Eigen::Vector3d read_direction(const Node& node) {
  const Node::List& list = read_list(node, "a direction of three numbers, such as [0, 0, 1]", 3);
  Eigen::Vector3d direction;
  for (std::size_t i = 0; i < 3; ++i)
    direction[static_cast<Eigen::Index>(i)] = read_number(list[i], kAny);
  const double length = direction.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) fail(node, "a direction must have a length");
  return direction / length;
}

const Node::List& read_list(const Node& node, std::string_view what, std::size_t count) {
  const Node::List* list = node.list();
  if (list == nullptr || list->empty() || (count > 0 && list->size() != count))
    fail(node, fmt::format("expected {}, found {}", what, found(node)));
  return *list;
}

namespace {

/// The form that a reader asks for; a key of another one is a bug.
template <class Form>
const Form& form_of(const KeyType& type) {
  if (const Form* found_form = std::get_if<Form>(&type.variant)) return *found_form;
  throw std::logic_error("a key is read as what its table does not say");
}

void check_is_table(const Node& node, const std::vector<std::string>& names) {
  if (node.table() == nullptr)
    fail(node,
         fmt::format("expected a table of {}, found {}", fmt::join(names, ", "), found(node)));
}

void refuse_unknown_keys(const Node& node, const std::vector<std::string>& names,
                         const std::string& what) {
  for (const Member& member : node.table()->members)
    if (std::find(names.begin(), names.end(), member.key) == names.end())
      throw InputError(member.key_where,
                       fmt::format("{}: unknown key `{}`{}", what, one_line(member.key),
                                   suggestion(member.key, names)));
}

/// The keys of all variants.
std::vector<std::string> names_of(const form::Variants& variants) {
  std::vector<std::string> all;
  for (const auto& [word, keys] : variants.by_word)
    for (std::string& name : keys().names())
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(std::move(name));
  return all;
}

const KeyTable& chosen_variant(const Node& node, const form::Variants& variants,
                               const std::string& what) {
  if (node.table() == nullptr) fail(node, "expected a table, found " + found(node));
  const Node* tag = node.find(variants.tag);
  if (tag == nullptr) {
    refuse_unknown_keys(node, names_of(variants), what);  // it may be misspelt
    throw InputError(node.where, fmt::format("{}: `{}` is missing", what, variants.tag));
  }
  form::Choice words;
  for (int i = 0; const auto& [word, keys] : variants.by_word) words.words.emplace_back(word, i++);
  const int chosen = read_word(*tag, {words});
  const KeyTable& table = variants.by_word[static_cast<std::size_t>(chosen)].second();
  for (const Member& member : node.table()->members) {
    if (table.find(member.key) != nullptr) continue;
    for (const auto& [word, other] : variants.by_word)
      if (other().find(member.key) != nullptr)
        throw InputError(member.key_where, fmt::format("{}: `{}` does not belong here: {} {}", what,
                                                       member.key, variants.reason, found(*tag)));
  }
  return table;
}

}  // namespace

double read_real(const Node& node, const KeyType& type) {
  if (const auto* number = std::get_if<form::Number>(&type.variant))
    return read_number(node, number->range);
  const auto& quantity = form_of<form::Quantity>(type);
  return read_quantity(node, quantity.kind, quantity.range);
}

int read_integer(const Node& node, const KeyType& type) {
  const auto& integer = form_of<form::Integer>(type);
  return read_integer(node, integer.min, integer.max);
}

bool read_boolean(const Node& node, const KeyType& type) {
  if (std::holds_alternative<form::Choice>(type.variant)) return read_word(node, type) != 0;
  (void)form_of<form::Boolean>(type);
  return read_boolean(node);
}

std::string read_text(const Node& node, const KeyType& type) {
  (void)form_of<form::Text>(type);
  return read_text(node);
}

Eigen::Vector3d read_vector(const Node& node, const KeyType& type) {
  if (std::holds_alternative<form::Direction>(type.variant)) return read_direction(node);
  return read_vector(node, form_of<form::Vector>(type).kind);
}

int read_word(const Node& node, const KeyType& type) {
  const std::vector<Word>& words = form_of<form::Choice>(type).words;
  std::vector<std::string> names;
  std::string list;
  for (const Word& word : words) {
    if (node.text() != nullptr && *node.text() == word.text) return word.value;
    list += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", word.text);
    names.emplace_back(word.text);
  }
  const std::string near = node.text() != nullptr ? nearest_name(*node.text(), names) : "";
  fail(node,
       fmt::format("expected {}{}, found {}{}", names.size() > 1 ? "one of " : "", list,
                   found(node), near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

TableReader::TableReader(const Node& node, const KeyTable& keys, std::string what)
    : node_(node), keys_(keys), what_(std::move(what)) {
  check_is_table(node, keys.names());
  refuse_unknown_keys(node, keys.names(), what_);
}

TableReader::TableReader(const Node& node, const form::Variants& variants, const std::string& what)
    : TableReader(node, chosen_variant(node, variants, what), what) {}

const Node* TableReader::find(std::string_view key) const {
  if (!knows(key))
    throw std::logic_error(fmt::format("{} has no key `{}` in its table", what_, key));
  return node_.find(key);
}

std::optional<Node> TableReader::standard_value(std::string_view key) const {
  const Absence& absence = keys_.find(key)->absence;
  if (absence.is_error)
    throw InputError(node_.where, fmt::format("{}: `{}` is missing", what_, key));
  Node node{0.0, std::string(key), node_.where};
  if (const auto* number = std::get_if<double>(&absence.value)) {
    const bool is_whole = std::holds_alternative<form::Integer>(keys_.find(key)->type.variant);
    if (is_whole)
      node.value = static_cast<std::int64_t>(*number);
    else
      node.value = *number;
  } else if (const auto* is_so = std::get_if<bool>(&absence.value)) {
    node.value = *is_so;
  } else if (const auto* text = std::get_if<std::string_view>(&absence.value)) {
    node.value = std::string(*text);
  } else if (const auto* direction = std::get_if<std::array<double, 3>>(&absence.value)) {
    Node::List parts;
    for (const double part : *direction) parts.push_back({part, node.name, node.where});
    node.value = std::move(parts);
  } else {
    return std::nullopt;
  }
  return node;
}

const Node& TableReader::at(std::string_view key) const {
  if (const Node* value = find(key)) return *value;
  throw InputError(node_.where, fmt::format("{}: `{}` is missing", what_, key));
}

void TableReader::refuse(std::initializer_list<std::string_view> keys,
                         std::string_view reason) const {
  for (const Member& member : node_.table()->members)
    if (std::find(keys.begin(), keys.end(), member.key) != keys.end())
      throw InputError(member.key_where,
                       fmt::format("{}: `{}` does not belong here: {}", what_, member.key, reason));
}

const Node& TableReader::exactly_one(std::initializer_list<std::string_view> keys) const {
  if (const Node* value = at_most_one(keys)) return *value;
  throw InputError(node_.where, fmt::format("{}: expected `{}`, found none of them", what_,
                                            fmt::join(keys, "` or `")));
}

const Node* TableReader::at_most_one(std::initializer_list<std::string_view> keys) const {
  const Node* first = nullptr;
  for (const Member& member : node_.table()->members) {
    if (std::find(keys.begin(), keys.end(), member.key) == keys.end()) continue;
    if (first != nullptr)
      throw InputError(member.key_where, fmt::format("{}: `{}` and `{}` exclude each other", what_,
                                                     first->name, member.key));
    first = &member.node;
  }
  return first;
}

const Node::List& entries(const TableReader& document, std::string_view key) {
  static const Node::List kNone;
  const Node* node = document.find(key);
  if (node == nullptr) return kNone;
  if (node->list() == nullptr)
    fail(*node,
         fmt::format("expected entries that start with [[{}]], found {}", key, found(*node)));
  return *node->list();
}

}  // namespace articular::sim
