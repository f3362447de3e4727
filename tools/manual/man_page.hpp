#pragma once

#include <string>

#include "tools/manual/command_tree.hpp"

namespace articular::tools {

/// The manual page of a program, section 1, in the macros of man(7).
/// @param version  "0.2.0"
/// @param date     of this version, "2026-11-26"
std::string man_page(const Command& program, const std::string& version, const std::string& date);

}  // namespace articular::tools
