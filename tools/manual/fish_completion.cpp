#include <fmt/format.h>

#include "tools/manual/completed_value.hpp"
#include "tools/manual/shell_completion.hpp"

namespace articular::tools {
namespace {

std::string in_fish_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

std::string fish_list(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : " ") + word;
  return list;
}

/// Flags of `complete`: an argument follows (-r), with files (-F) or without (-f), and words (-a).
std::string fish_offer(const CompletedValue& value) {
  if (value.files) return " -F";
  std::string words;
  if (!value.words.empty())
    words = fish_list(value.words);
  else if (!value.endings.empty())  // with folders
    words = "(__fish_complete_suffix " + fish_list(value.endings) + ")";
  else if (value.folders)
    words = "(__fish_complete_directories)";
  if (!value.listing.empty()) words += " (" + value.listing + ")";
  return words.empty() ? " -f" : " -f -a " + in_fish_quotes(words);
}

std::string fish_option(const Argument& option) {
  std::string flags;
  for (const std::string& name : option.names)
    flags += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.value.empty()) flags += " -r" + fish_offer(completed_value(option));
  return flags + " -d " + in_fish_quotes(option.description);
}

/// @param is_here  condition: that the command line is at this command or below it
std::string fish_lines(const Command& command, const std::string& is_here) {
  std::vector<std::string> names;
  std::string below;
  for (const Command& one : command.commands) {
    names.push_back(one.name);
    below += fish_lines(one, (is_here.empty() ? "" : is_here + "; and ") +
                                 "__fish_seen_subcommand_from " + one.name);
  }
  std::string condition = is_here;
  if (is_here.empty())
    condition = "__fish_use_subcommand";
  else if (!names.empty())
    condition += "; and not __fish_seen_subcommand_from " + fish_list(names);
  const std::string start = "complete -c articular -n " + in_fish_quotes(condition);
  std::string lines;
  for (const Command& one : command.commands)
    lines += fmt::format("{} -a {} -d {}\n", start, one.name, in_fish_quotes(one.description));
  for (const Argument& option : command.options) lines += start + fish_option(option) + "\n";
  if (const CompletedValue value = completed_positional(command); !value.empty())
    lines += start + fish_offer(value) + "\n";
  return lines + below;
}

}  // namespace

std::string fish_completion(const Command& program) {
  return "# Completion of articular for fish, as `articular manual fish` prints it.\n"
         "complete -c articular -f\n" +
         fish_lines(program, "");
}

}  // namespace articular::tools
