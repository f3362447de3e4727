#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/toml_document.hpp"

namespace articular::sim {

/// The arrays of tables of a scenario: an override names one of their entries, it cannot add one.
inline constexpr std::array<std::string_view, 11> kEntryLists{
    "body",     "attach", "support", "muscle",  "muscle_table", "sheet",
    "ligament", "bolus",  "load",    "contact", "probe"};

/// One value that replaces another, or is added: "duration=0.1 s", "body.disc_left.density=1
/// g/cm^3", "load.0.force=0 0 -2 N".
struct Override {
  std::vector<std::string> path;  ///< "body", "disc_left", "density"
  std::string value;              ///< TOML, or a text without its quotes
  Location where;                 ///< "--set PATH=VALUE": later messages about the value name it
};

/// A part of the path that holds dots is put in double quotes.
/// @throws InputError  if it has no "=", or a part of its path is empty
Override read_override(std::string_view text);

/// Entries of a list are addressed by their `name`, or by their number from 0.
/// @throws InputError  if there is no such place
void apply_override(Node& document, const Override& change);

}  // namespace articular::sim
