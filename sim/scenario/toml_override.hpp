#pragma once

#include <array>
#include <string>
#include <string_view>

#include "sim/scenario/toml_document.hpp"

namespace articular::sim {

/// The arrays of tables of a scenario: an override names one of their entries, it cannot add one.
inline constexpr std::array<std::string_view, 10> kEntryLists{
    "body",     "attach", "support", "muscle",  "muscle_table",
    "ligament", "bolus",  "load",    "contact", "probe"};

/// Replaces or adds one value of a scenario: "duration=0.1 s", "body.disc_left.density=1 g/cm^3",
/// "load.0.force=0 0 -2 N". Entries of a list are addressed by their `name` or by their number from
/// 0; a part of the path that holds dots is put in double quotes. The new values stand at the
/// location "--set PATH=VALUE", so that later messages about them name the override.
/// @throws InputError  if there is no such place
void apply_override(Node& document, std::string_view override_text);

}  // namespace articular::sim
