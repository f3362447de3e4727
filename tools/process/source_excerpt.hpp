#pragma once

#include <string>
#include <string_view>

namespace articular::tools {

/// The line of a file that an error message "file:line:column: ..." points at, with a caret under
/// the place:
///
///     12 | youngs_modulus = "15 kPa"
///        | ^
///
/// Without a column there is no caret. Of a long line only what is around the place is shown.
/// @return  lines that end, or "" where the message points at no line of a text file
std::string source_excerpt(std::string_view message);

}  // namespace articular::tools
