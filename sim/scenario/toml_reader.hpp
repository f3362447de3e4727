#pragma once

#include <fmt/format.h>

#include <concepts>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/base/message_text.hpp"
#include "sim/scenario/key_table.hpp"
#include "sim/scenario/quantity.hpp"
#include "sim/scenario/toml_document.hpp"

/// Strict reading of a document: each function returns a checked value in SI or throws InputError
/// with the place of the value, its key, what was expected and what was found.
namespace articular::sim {

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

/// Values of a key's type: quantities and plain numbers; yes or no, also as a choice of words; the
/// enumerator of a word; three numbers, with a unit or as a direction.
double read_real(const Node& node, const KeyType& type);
int read_integer(const Node& node, const KeyType& type);
bool read_boolean(const Node& node, const KeyType& type);
std::string read_text(const Node& node, const KeyType& type);
Eigen::Vector3d read_vector(const Node& node, const KeyType& type);
int read_word(const Node& node, const KeyType& type);

/// The one of these that T asks for.
template <class T>
T read_value(const Node& node, const KeyType& type) {
  if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(read_word(node, type));
  } else if constexpr (std::is_same_v<T, double>) {
    return read_real(node, type);
  } else if constexpr (std::is_same_v<T, int>) {
    return read_integer(node, type);
  } else if constexpr (std::is_same_v<T, bool>) {
    return read_boolean(node, type);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return read_text(node, type);
  } else {
    static_assert(std::is_same_v<T, Eigen::Vector3d>);
    return read_vector(node, type);
  }
}

template <class T>
struct WithoutOptional {
  using type = T;
};
template <class T>
struct WithoutOptional<std::optional<T>> {
  using type = T;
};

/// A table of the file, read by its table of keys. To ask for a key that this does not have is a
/// bug.
class TableReader {
 public:
  /// @param what  for messages: "body `skull`"
  /// @throws InputError  if the node is no table or has a key that is not among `keys`
  TableReader(const Node& node, const KeyTable& keys, std::string what);

  /// As its tag says. @throws InputError  also if the tag is missing or none of the words
  TableReader(const Node& node, const form::Variants& variants, const std::string& what);

  const Node& node() const { return node_; }
  const std::string& what() const { return what_; }
  bool knows(std::string_view key) const { return keys_.find(key) != nullptr; }

  /// The value of a key, or nullptr.
  const Node* find(std::string_view key) const;

  /// The value of a key that must be there.
  const Node& at(std::string_view key) const;

  /// Reads the value of a key into `target`, or the default that its table has. Without both
  /// `target` stays. @throws InputError  also if a required key is missing
  template <class T, std::invocable<const Node&> Read>
  void read(std::string_view key, T& target, Read read) const {
    if (const Node* value = find(key))
      target = read(*value);
    else if (const auto standard = standard_value(key))
      target = read(*standard);
  }

  /// The same for a value of the key's own type.
  template <class T>
  void read(std::string_view key, T& target) const {
    read(key, target, [&](const Node& n) {
      return read_value<typename WithoutOptional<T>::type>(n, keys_.find(key)->type);
    });
  }

  /// What read() gives.
  template <class T>
  T get(std::string_view key) const {
    T value{};
    read(key, value);
    return value;
  }

  /// Refuses keys that do not go with the rest of the table, at the key's place.
  void refuse(std::initializer_list<std::string_view> keys, std::string_view reason) const;

  /// The one key of these that is there. @throws InputError  if it is none or several
  const Node& exactly_one(std::initializer_list<std::string_view> keys) const;

  /// As exactly_one(), but nullptr if it is none.
  const Node* at_most_one(std::initializer_list<std::string_view> keys) const;

 private:
  /// A node for the default of a key. @throws InputError  if the key is required
  std::optional<Node> standard_value(std::string_view key) const;

  const Node& node_;
  const KeyTable& keys_;
  std::string what_;
};

/// The entries of an array of tables such as [[body]]; empty if there is none.
const Node::List& entries(const TableReader& document, std::string_view key);

}  // namespace articular::sim
