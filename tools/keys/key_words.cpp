#include "tools/keys/key_words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace articular::tools {
namespace {

namespace form = sim::form;

/// "stress" for "a stress".
std::string_view without_article(std::string_view noun) {
  for (const std::string_view article : {"a ", "an "})
    if (noun.starts_with(article)) return noun.substr(article.size());
  return noun;
}

/// "kPa" of "15 kPa".
std::string unit_of(const sim::QuantityKind& kind) {
  return std::string(kind.example.substr(kind.example.find(' ') + 1));
}

std::string words_of_range(const sim::Range& range) {
  const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
  if (!has_min && !has_max) return "";
  if (!has_max) return fmt::format("{} {}", range.excludes_ends ? ">" : "≥", range.min);
  std::string_view rule = range.rule;  // "must lie between 0 and 180 deg"
  for (const std::string_view start : {"must ", "lie "})
    if (rule.starts_with(start)) rule.remove_prefix(start.size());
  return std::string(rule);
}

struct TypeWords {
  std::string operator()(const form::Text& text) const { return std::string(text.noun); }
  std::string operator()(const form::Boolean&) const { return "`true`, `false`"; }
  std::string operator()(const form::Number&) const { return "number"; }
  std::string operator()(const form::Integer&) const { return "whole number"; }
  std::string operator()(const form::Quantity& quantity) const {
    return std::string(without_article(quantity.kind.noun));
  }
  std::string operator()(const form::Vector& vector) const {
    return fmt::format("vector, {}", without_article(vector.kind.noun));
  }
  std::string operator()(const form::Direction&) const { return "direction `[x, y, z]`"; }
  std::string operator()(const form::Choice& choice) const {
    std::string words;
    for (const sim::Word& word : choice.words)
      words += fmt::format("{}`\"{}\"`", words.empty() ? "" : ", ", word.text);
    return words;
  }
  std::string operator()(const form::Table& table) const { return table_name(table.keys().name); }
  std::string operator()(const form::VariantTable& table) const {
    return table_name(table.variants().name);
  }
  std::string operator()(const form::List& list) const {
    const std::string of = type_words(list.of.front());
    if (list.are_entries) return of + " entries";
    return list.count > 0 ? fmt::format("list of {}: {}", list.count, of) : "list: " + of;
  }
  std::string operator()(const form::Map& map) const {
    return fmt::format("table: {} = {}", map.by, type_words(map.of.front()));
  }
  std::string operator()(const form::Either& either) const {
    std::string words;
    for (const sim::KeyType& type : either.of)
      words += (words.empty() ? "" : "; or ") + type_words(type);
    return words;
  }
  std::string operator()(const form::Anything&) const { return "any value"; }

  static std::string table_name(std::string_view name) { return fmt::format("<{}>", name); }
};

struct UnitWords {
  std::string operator()(const form::Quantity& quantity) const { return unit_of(quantity.kind); }
  std::string operator()(const form::Vector& vector) const { return unit_of(vector.kind); }
  std::string operator()(const form::List& list) const { return unit_words(list.of.front()); }
  template <class Other>
  std::string operator()(const Other&) const {
    return "";
  }
};

struct RangeWords {
  std::string operator()(const form::Number& number) const { return words_of_range(number.range); }
  std::string operator()(const form::Quantity& quantity) const {
    return words_of_range(quantity.range);
  }
  std::string operator()(const form::Integer& integer) const {
    return fmt::format("{} to {}", integer.min, integer.max);
  }
  std::string operator()(const form::List& list) const { return range_words(list.of.front()); }
  template <class Other>
  std::string operator()(const Other&) const {
    return "";
  }
};

}  // namespace

std::string type_words(const sim::KeyType& type) { return std::visit(TypeWords{}, type.variant); }

std::string unit_words(const sim::KeyType& type) { return std::visit(UnitWords{}, type.variant); }

std::string range_words(const sim::KeyType& type) { return std::visit(RangeWords{}, type.variant); }

std::string absence_words(const sim::Absence& absence) {
  if (const auto* number = std::get_if<double>(&absence.value)) return fmt::format("`{}`", *number);
  if (const auto* is_so = std::get_if<bool>(&absence.value)) return *is_so ? "`true`" : "`false`";
  if (const auto* text = std::get_if<std::string_view>(&absence.value))
    return fmt::format("`\"{}\"`", *text);
  if (const auto* direction = std::get_if<std::array<double, 3>>(&absence.value))
    return fmt::format("`[{}, {}, {}]`", (*direction)[0], (*direction)[1], (*direction)[2]);
  return std::string(absence.words);
}

}  // namespace articular::tools
