#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The words of messages about what a user wrote.
namespace articular::sim {

/// The text without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The text in double quotes on one line: control characters are escaped, long texts are cut.
std::string in_quotes(std::string_view text);

/// The text on one line: control characters become spaces.
std::string one_line(std::string_view text);

/// A name in backquotes on one line.
std::string in_ticks(std::string_view name);

/// The name nearest to a mistyped one (edit distance, letter case counts half), or "" if none is
/// near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& names);

/// What to append to "unknown key `duraton`": "; did you mean `duration`?", or, if no name is near,
/// a list of the names that exist.
std::string suggestion(std::string_view name, const std::vector<std::string>& names);

}  // namespace articular::sim
