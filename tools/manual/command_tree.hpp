#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The command line as plain data: what `--help` prints, for those who write it in other forms.
namespace articular::tools {

struct Argument {
  std::vector<std::string> names;  // "-h", "--help"; of a positional the one that the help has
  std::string value;               // "FILE", "sat|gjk"; empty: a flag
  std::string description;
  bool required = false;
  bool repeatable = false;
};

struct Command {
  std::string name;  // "run"
  std::string description;
  std::string footer;  // empty where it is that of the command above
  std::vector<Argument> positionals, options;
  std::vector<Command> commands;
};

/// All of a program, with its options and subcommands in the order in which they were added.
Command command_tree(const CLI::App& app);

}  // namespace articular::tools
