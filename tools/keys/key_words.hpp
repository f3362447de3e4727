#pragma once

#include <string>

#include "sim/scenario/key_table.hpp"

/// What a table of keys says, in words for people.
namespace articular::tools {

/// "time", "list of 3: whole number", "`\"fast\"`, `\"balanced\"`"; other sections in angle
/// brackets:
/// "<curve>".
std::string type_words(const sim::KeyType& type);

/// "s", or "" where there is no unit.
std::string unit_words(const sim::KeyType& type);

/// "> 0", "1 to 1000", or "" for any.
std::string range_words(const sim::KeyType& type);

/// "`\"10 ms\"`", "by `accuracy`"; "" where it is an error or nothing.
std::string absence_words(const sim::Absence& absence);

}  // namespace articular::tools
