#include <fmt/format.h>

#include "tools/manual/completed_value.hpp"
#include "tools/manual/shell_completion.hpp"

namespace articular::tools {
namespace {

std::string in_zsh_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// `_arguments` and `_describe` take colons and brackets for their own.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  return fmt::format("{}", fmt::join(parts, between));
}

/// Files, or what a command lists.
constexpr const char* kNames = R"zsh(_articular_names() {  # PATTERN COMMAND
  local names=(${(f)"$(eval $2)"})
  _alternative "files:file:_files -g \"$1\"" "names:name:($names)"
}

)zsh";

/// One ending in parentheses zsh would take for qualifiers.
std::string file_pattern(const std::vector<std::string>& endings) {
  return endings.size() == 1 ? "*" + endings.front() : "*(" + joined(endings, "|") + ")";
}

std::string action(const CompletedValue& value) {
  if (!value.words.empty()) return "(" + joined(value.words, " ") + ")";
  if (!value.listing.empty())  // after a blank, with these arguments and no others
    return fmt::format(" _articular_names \"{}\" \"{}\"", file_pattern(value.endings),
                       value.listing);
  if (!value.endings.empty()) return "_files -g \"" + file_pattern(value.endings) + "\"";
  if (value.files) return "_files";
  return value.folders ? "_files -/" : " ";
}

std::vector<std::string> option_specs(const Argument& option) {
  std::vector<std::string> specs;
  for (const std::string& name : option.names) {
    std::string spec =
        option.repeatable ? "*" + name : "(" + joined(option.names, " ") + ")" + name;
    if (!option.value.empty() && name.starts_with("--")) spec += "=";
    spec += "[" + escaped(option.description) + "]";
    if (!option.value.empty())
      spec += ":" + escaped(option.value) + ":" + action(completed_value(option));
    specs.push_back(spec);
  }
  return specs;
}

std::string positional_spec(const Argument& positional, std::size_t index) {
  const std::string place = positional.repeatable ? "*" : std::to_string(index + 1);
  return place + (positional.required ? ":" : "::") + escaped(positional.names.front()) + ":" +
         action(completed_value(positional));
}

/// What chooses among subcommands and goes on with the function of the one that is there.
std::string choice(const Command& command, const std::string& function) {
  std::string lines =
      "  case $state in\n    subcommand)\n      local -a subcommands\n      subcommands=(\n";
  for (const Command& one : command.commands)
    lines += "        " + in_zsh_quotes(one.name + ":" + escaped(one.description)) + "\n";
  lines +=
      "      )\n      _describe subcommand subcommands && status_=0\n      ;;\n"
      "    arguments)\n      case $words[1] in\n";
  for (const Command& one : command.commands)
    lines += fmt::format("        {0}) {1}_{0} && status_=0 ;;\n", one.name, function);
  return lines + "      esac\n      ;;\n  esac\n";
}

/// One function for each command.
std::string functions(const Command& command, const std::string& function) {
  std::string specs;
  for (const Argument& option : command.options)
    for (const std::string& spec : option_specs(option)) specs += " \\\n    " + in_zsh_quotes(spec);
  for (std::size_t i = 0; i < command.positionals.size(); ++i)
    specs += " \\\n    " + in_zsh_quotes(positional_spec(command.positionals[i], i));
  if (!command.commands.empty()) specs += " \\\n    '1: :->subcommand' \\\n    '*:: :->arguments'";
  std::string text =
      function +
      "() {\n  local curcontext=$curcontext context state state_descr line status_=1\n"
      "  typeset -A opt_args\n  _arguments -C" +
      specs + " && status_=0\n";
  if (!command.commands.empty()) text += choice(command, function);
  text += "  return $status_\n}\n\n";
  for (const Command& below : command.commands)
    text += functions(below, function + "_" + below.name);
  return text;
}

}  // namespace

std::string zsh_completion(const Command& program) {
  return "#compdef articular\n"
         "# Completion of articular for zsh, as `articular manual zsh` prints it.\n\n" +
         std::string(kNames) + functions(program, "_articular") +
         "if [ \"$funcstack[1]\" = _articular ]; then  # from a folder in $fpath\n"
         "  _articular \"$@\"\nelse\n  compdef _articular articular\nfi\n";
}

}  // namespace articular::tools
