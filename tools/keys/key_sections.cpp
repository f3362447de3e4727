#include "tools/keys/key_sections.hpp"

#include <algorithm>

#include "sim/scenario/scenario_keys.hpp"
#include "tools/keys/key_words.hpp"

namespace articular::tools {
namespace {

namespace form = sim::form;
using sim::Key;
using sim::KeyTable;
using sim::KeyType;

/// Calls for each table and each set of variants that a value of the type can be.
template <class OnTable, class OnVariants>
void for_each_table(const KeyType& type, bool have_when, const OnTable& on_table,
                    const OnVariants& on_variants) {
  const auto go_on = [&](const std::vector<KeyType>& types, bool when) {
    for (const KeyType& inner : types) for_each_table(inner, when, on_table, on_variants);
  };
  if (const auto* table = std::get_if<form::Table>(&type.variant))
    on_table(table->keys(), have_when);
  if (const auto* variants = std::get_if<form::VariantTable>(&type.variant))
    on_variants(variants->variants(), have_when);
  if (const auto* list = std::get_if<form::List>(&type.variant)) go_on(list->of, list->have_when);
  if (const auto* map = std::get_if<form::Map>(&type.variant)) go_on(map->of, have_when);
  if (const auto* either = std::get_if<form::Either>(&type.variant)) go_on(either->of, have_when);
}

class Collector {
 public:
  void add(const KeyTable& table, bool have_when) {
    if (!is_new(table.name)) return;
    sections.push_back({std::string(table.name), {&table}, nullptr, have_when});
    follow(table);
  }

  void add(const form::Variants& variants, bool have_when) {
    if (!is_new(variants.name)) return;
    KeySection section{std::string(variants.name), {}, &variants, have_when};
    for (const auto& [word, keys] : variants.by_word) section.tables.push_back(&keys());
    sections.push_back(section);
    for (const KeyTable* table : section.tables) follow(*table);
  }

  std::vector<KeySection> sections;

 private:
  bool is_new(std::string_view name) const {
    return std::none_of(sections.begin(), sections.end(),
                        [&](const KeySection& section) { return section.name == name; });
  }

  void follow(const KeyTable& table) {
    const auto add_it = [this](const auto& found, bool have_when) { add(found, have_when); };
    for (const Key& key : table.keys) for_each_table(key.type, false, add_it, add_it);
  }
};

bool are_alike(const Key& a, const Key& b) {
  return a.name == b.name && a.meaning == b.meaning && type_words(a.type) == type_words(b.type) &&
         range_words(a.type) == range_words(b.type) &&
         absence_words(a.absence) == absence_words(b.absence) &&
         a.absence.is_error == b.absence.is_error;
}

/// The tag, as a choice of all words.
Key tag_of(const form::Variants& variants) {
  form::Choice words;
  for (int i = 0; const auto& [word, keys] : variants.by_word) words.words.emplace_back(word, i++);
  return {variants.tag, {words}, sim::kRequired, "decides which keys there are beside it"};
}

}  // namespace

std::vector<KeySection> key_sections(const KeyTable& root) {
  Collector collector;
  collector.add(root, false);
  return collector.sections;
}

std::vector<KeyRow> key_rows(const KeySection& section) {
  std::vector<KeyRow> rows;
  for (std::size_t i = 0; i < section.tables.size(); ++i)
    for (const Key& key : section.tables[i]->keys) {
      const bool is_tag = section.variants != nullptr && key.name == section.variants->tag;
      const auto known = std::find_if(rows.begin(), rows.end(), [&](const KeyRow& row) {
        return is_tag ? row.key.name == key.name : are_alike(row.key, key);
      });
      KeyRow& row = known != rows.end()
                        ? *known
                        : rows.emplace_back(KeyRow{is_tag ? tag_of(*section.variants) : key, {}});
      if (section.variants != nullptr) row.with.push_back(section.variants->by_word[i].first);
    }
  for (KeyRow& row : rows)
    if (row.with.size() == section.tables.size()) row.with.clear();
  if (section.have_when) rows.push_back({sim::when_key(), {}});
  return rows;
}

std::vector<std::string> sections_of(const KeyType& type) {
  std::vector<std::string> names;
  const auto add = [&](const auto& found, bool) { names.emplace_back(found.name); };
  for_each_table(type, false, add, add);
  return names;
}

std::string without_brackets(std::string_view name) {
  std::string bare;
  for (const char c : name)
    if (c != '[' && c != ']' && c != '`') bare += c;
  return bare;
}

}  // namespace articular::tools
