#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/key_table.hpp"

namespace articular::tools {

/// A table of keys as a reader looks it up, or all variants of one: [[load]] of each kind.
struct KeySection {
  std::string name;                          // "[integrator]", "material"
  std::vector<const sim::KeyTable*> tables;  // one, or the variants
  const sim::form::Variants* variants = {};  // nullptr: no variants
  bool have_when = false;                    // entries that may have `when`
};

/// The table and all that can be reached from it: each once, before what it leads to.
std::vector<KeySection> key_sections(const sim::KeyTable& root);

/// A key of a section.
struct KeyRow {
  sim::Key key;
  std::vector<std::string_view> with;  // words of the variants that have it; empty: all
};

/// The keys of a section. What variants have alike is one row.
std::vector<KeyRow> key_rows(const KeySection& section);

/// Names of the sections that a value of the type leads to.
std::vector<std::string> sections_of(const sim::KeyType& type);

/// "integrator" for "[integrator]".
std::string without_brackets(std::string_view name);

}  // namespace articular::tools
