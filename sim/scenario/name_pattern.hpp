#pragma once

#include <string_view>

namespace articular::sim {

/// Whether a `*`, which no name has, stands for any characters in it: "cube *".
bool is_pattern(std::string_view name);

/// Whether a body is meant: by its own name, or by a pattern, of which all but `*` is as written.
bool fits(std::string_view pattern, std::string_view name);

}  // namespace articular::sim
