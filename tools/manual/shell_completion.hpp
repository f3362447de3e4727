#pragma once

#include <string>

#include "tools/manual/command_tree.hpp"

/// Scripts with which a shell completes the arguments of a program: subcommands, options, words
/// that a value may be, and files by their endings. Each stands alone.
namespace articular::tools {

std::string bash_completion(const Command& program);
std::string zsh_completion(const Command& program);
std::string fish_completion(const Command& program);

}  // namespace articular::tools
