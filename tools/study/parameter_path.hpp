#pragma once

#include <fmt/format.h>

#include <string>

#include "sim/base/error.hpp"

namespace articular::tools {

/// Of two that change one value the later would win, and the other would seem to have no effect.
/// @param so_far  knobs or parameters with `name` and `path`, which may be empty
/// @throws InputError  if one of them has this path
template <class Entries>
void check_new_path(const sim::Location& where, const std::string& path, const Entries& so_far) {
  if (path.empty()) return;
  for (const auto& other : so_far)
    if (other.path == path)
      throw sim::InputError(where, fmt::format("`{}` changes `{}` too; expected one of them to "
                                               "change it",
                                               other.name, path));
}

}  // namespace articular::tools
