#pragma once

#include <fmt/format.h>

#include <concepts>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/message_text.hpp"
#include "sim/scenario/quantity.hpp"
#include "sim/scenario/toml_document.hpp"

/// Strict reading of a document: each function returns a checked value in SI or throws InputError
/// with the place of the value, its key, what was expected and what was found.
namespace articular::sim {

/// The numbers that a value may have.
struct Range {
  double min, max;
  bool excludes_ends;
  std::string_view rule;          // "must be positive"
  std::string_view subject = "";  // in place of the key: "Poisson's ratio"
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{-kInfinity, kInfinity, true, "must be finite"};
inline constexpr Range kPositive{0, kInfinity, true, "must be positive"};
inline constexpr Range kNotNegative{0, kInfinity, false, "must not be negative"};
inline constexpr Range kFraction{0, 1, false, "must lie between 0 and 1"};
inline constexpr Range kPoissonRange{-1, 0.5, true, "must lie between -1 and 0.5 (exclusive)",
                                     "Poisson's ratio"};

/// What a node holds, for "found ...": `"15 mm"`, `the number 15`, `a list`.
std::string found(const Node& node);

/// "`key`: message" at the node.
[[noreturn]] void fail(const Node& node, const std::string& message);

void check_range(const Node& node, double value, const Range& range);

std::string read_text(const Node& node);  // not empty
bool read_boolean(const Node& node);
double read_number(const Node& node, const Range& range);
int read_integer(const Node& node, int min, int max);
double read_quantity(const Node& node, const QuantityKind& kind, const Range& range);
Eigen::Vector3d read_vector(const Node& node, const QuantityKind& kind);
Eigen::Vector3d read_direction(const Node& node);  // three bare numbers, returned with length 1

/// A list; `what` describes it: "a list of two bodies". count 0 = any, but not empty.
const Node::List& read_list(const Node& node, std::string_view what, std::size_t count = 0);

/// The names of enumerators.
template <class E>
using Choices = std::initializer_list<std::pair<std::string_view, E>>;

template <class E>
E read_choice(const Node& node, Choices<E> choices) {
  std::vector<std::string> names;
  std::string list;
  for (const auto& [name, value] : choices) {
    if (node.text() != nullptr && *node.text() == name) return value;
    list += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    names.emplace_back(name);
  }
  const std::string near = node.text() != nullptr ? nearest_name(*node.text(), names) : "";
  fail(node,
       fmt::format("expected {}{}, found {}{}", names.size() > 1 ? "one of " : "", list,
                   found(node), near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

/// A table of which every key is known.
class TableReader {
 public:
  /// @param what  for messages: "body `skull`"
  /// @throws InputError  if the node is no table or has another key than these
  TableReader(const Node& node, std::string what, std::initializer_list<std::string_view> keys);

  const Node& node() const { return node_; }
  const std::string& what() const { return what_; }

  /// The value of a key, or nullptr.
  const Node* find(std::string_view key) const { return node_.find(key); }

  /// The value of a key that must be there.
  const Node& at(std::string_view key) const;

  /// Reads the value of a key into `target` if the key is there.
  template <class T, std::invocable<const Node&> Read>
  void may(std::string_view key, T& target, Read read) const {
    if (const Node* value = find(key)) target = read(*value);
  }

  /// Refuses keys that do not go with the rest of the table, at the key's place.
  void refuse(std::initializer_list<std::string_view> keys, std::string_view reason) const;

  /// The one key of these that is there. @throws InputError  if it is none or several
  const Node& exactly_one(std::initializer_list<std::string_view> keys) const;

  /// As exactly_one(), but nullptr if it is none.
  const Node* at_most_one(std::initializer_list<std::string_view> keys) const;

 private:
  const Node& node_;
  std::string what_;
};

// Readers to pass to TableReader::may().
inline auto as_quantity(const QuantityKind& kind, const Range& range) {
  return [&kind, &range](const Node& node) { return read_quantity(node, kind, range); };
}
inline auto as_vector(const QuantityKind& kind) {
  return [&kind](const Node& node) { return read_vector(node, kind); };
}
inline auto as_number(const Range& range) {
  return [&range](const Node& node) { return read_number(node, range); };
}

/// The entries of an array of tables such as [[body]]; empty if there is none.
const Node::List& entries(const TableReader& document, std::string_view key);

}  // namespace articular::sim
