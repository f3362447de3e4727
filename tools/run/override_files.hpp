#pragma once

#include <string>
#include <vector>

namespace articular::tools {

/// What --set was told, with the lines of FILE in place of @FILE: PATH=VALUE each; empty lines and
/// those that begin with # are left out.
/// @throws sim::InputError  where a file can't be read or a line has no =, with its place
std::vector<std::string> with_override_files(const std::vector<std::string>& overrides);

}  // namespace articular::tools
