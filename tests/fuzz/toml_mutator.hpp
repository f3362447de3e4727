#pragma once

#include <random>
#include <string>
#include <string_view>

namespace articular::fuzz {

/// A TOML text with one change that an author may make by mistake, or in bad faith: a table or a
/// line that is gone, twice, elsewhere, or from the other text; a key with another's name or value;
/// a value of another type, size or unit; depth. The text is looked at, not parsed: what comes need
/// not be TOML, but mostly is.
/// @param other  a text to take tables, lines and values from
std::string changed_toml(const std::string& text, std::string_view other, std::mt19937& random);

}  // namespace articular::fuzz
