#pragma once

#include <string>
#include <vector>

#include "tools/manual/command_tree.hpp"

namespace articular::tools {

/// What a shell can offer for a value.
struct CompletedValue {
  std::vector<std::string> words;    // the values that there are
  std::vector<std::string> endings;  // of files: ".toml"
  bool files = false;                // files of any kind
  bool folders = false;
  std::string listing;  // command that prints names, a line each, which serve for a file as well

  bool empty() const {
    return words.empty() && endings.empty() && !files && !folders && listing.empty();
  }
};

/// From what the help says of the value:
///
///   value "sat|gjk"                             these words
///   value with DIR in it                        folders
///   description "... a table (.csv)"            files with the endings that it names
///   value with FILE in it, and no such ending   any file
///   description "... see `articular scenarios`" what this lists: studies if that is asked for
///   value "KEY=VALUE", as of --set             accuracy=fast and so on, which need no scenario
CompletedValue completed_value(const Argument& argument);

/// Of all positionals of a command: a shell does not count them.
CompletedValue completed_positional(const Command& command);

}  // namespace articular::tools
