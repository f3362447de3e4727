#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/scenario/quantity.hpp"
#include "sim/scenario/range.hpp"

/// The keys of scenario files as data. TableReader goes by these tables: it knows no other keys, it
/// takes kinds of values, ranges, words and defaults from them. `articular keys` prints them. So
/// what is printed is what is read.
namespace articular::sim {

struct KeyTable;
struct KeyType;

/// A word that a value may be, and the enumerator that it means.
struct Word {
  template <class E>
  Word(std::string_view word, E enumerator) : text(word), value(static_cast<int>(enumerator)) {}
  std::string_view text;
  int value;
};

/// What a value may be.
namespace form {

struct Text {
  std::string_view noun;  // "name of a body"
};
struct Boolean {};
struct Number {
  Range range;
};
struct Integer {
  int min, max;
};
struct Quantity {
  QuantityKind kind;
  Range range;
};
/// Three numbers and a unit in one text.
struct Vector {
  QuantityKind kind;
};
/// Three plain numbers, of which the length does not count.
struct Direction {};
struct Choice {
  std::vector<Word> words;
};
struct Table {
  const KeyTable& (*keys)();
};
/// A table whose keys depend on the word that its key `tag` has.
struct Variants {
  std::string_view name;    // "[[load]]"
  std::string_view tag;     // "kind"
  std::string_view reason;  // "the load is of kind": why a key of another variant is refused
  std::vector<std::pair<std::string_view, const KeyTable& (*)()>> by_word;
};
struct VariantTable {
  const Variants& (*variants)();
};
/// A list of one type.
struct List {
  std::vector<KeyType> of;   // one
  std::size_t count = 0;     // 0: any, but not none
  bool are_entries = false;  // written as [[key]]
  bool have_when = false;    // which may have the key `when` beside those of their table
};
/// A table of one type, by names that are the user's.
struct Map {
  std::string_view by;      // "name of a choice"
  std::vector<KeyType> of;  // one
};
struct Either {
  std::vector<KeyType> of;
};
/// Any value of TOML.
struct Anything {};

}  // namespace form

struct KeyType {
  std::variant<form::Text, form::Boolean, form::Number, form::Integer, form::Quantity, form::Vector,
               form::Direction, form::Choice, form::Table, form::VariantTable, form::List,
               form::Map, form::Either, form::Anything>
      variant;
};

/// What holds where a key is not given.
struct Absence {
  bool is_error = false;
  /// What is read in its place, as the file would have it.
  std::variant<std::monostate, double, bool, std::string_view, std::array<double, 3>> value = {};
  std::string_view words = "";  // where it depends on more: "by `accuracy`"
};

inline constexpr Absence kRequired{.is_error = true};
inline constexpr Absence kNone{};
inline Absence standard(double number) { return {.value = number}; }
inline Absence standard(bool is_so) { return {.value = is_so}; }
inline Absence standard(const char* text) { return {.value = std::string_view(text)}; }
inline Absence standard(const std::array<double, 3>& direction) { return {.value = direction}; }
inline Absence otherwise(const char* words) { return {.words = words}; }

struct Key {
  std::string_view name;
  KeyType type;
  Absence absence;
  std::string_view meaning;
};

struct KeyTable {
  std::string_view name;  // "[integrator]", "[[body]]", "material"
  std::vector<Key> keys;

  /// nullptr: it has no such key.
  const Key* find(std::string_view key) const;
  std::vector<std::string> names() const;
};

/// The words of enumerators, `{"tr-bdf2", Scheme::TrBdf2}` and so on.
template <class Pairs>
form::Choice choice_of(const Pairs& pairs) {
  form::Choice choice;
  for (const auto& [word, enumerator] : pairs) choice.words.emplace_back(word, enumerator);
  return choice;
}

inline form::List list_of(KeyType type, std::size_t count = 0) {
  return {.of = {std::move(type)}, .count = count};
}
inline form::List conditional_entries_of(KeyType type) {
  return {.of = {std::move(type)}, .are_entries = true, .have_when = true};
}
inline form::List entries_of(KeyType type) {
  return {.of = {std::move(type)}, .are_entries = true};
}

}  // namespace articular::sim
