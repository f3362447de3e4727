#include "tools/manual/command_tree.hpp"

#include <CLI/CLI.hpp>

namespace articular::tools {
namespace {

/// Of a switch that turns something off, CLI11 adds "{false}" to the name that it prints.
std::vector<std::string> names_of(const CLI::Option& option) {
  if (option.get_positional()) return {option.get_name(true)};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// CLI11 adds what the value is checked for: "N:INT in [1 - 256]".
std::string value_of(const CLI::Option& option) {
  if (option.get_type_size() == 0) return {};
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

std::string description_of(const CLI::Option& option) {
  const std::string preset = option.get_default_str();
  return option.get_description() + (preset.empty() ? "" : " [" + preset + "]");
}

Argument argument(const CLI::Option& option) {
  return {names_of(option), value_of(option), description_of(option), option.get_required(),
          option.get_items_expected_max() >= CLI::detail::expected_max_vector_size};
}

}  // namespace

Command command_tree(const CLI::App& app) {
  Command command{app.get_name(), app.get_description(), app.get_footer(), {}, {}, {}};
  if (const CLI::App* const above = app.get_parent();
      above != nullptr && above->get_footer() == command.footer)
    command.footer.clear();
  for (const CLI::Option* const option : app.get_options())
    (option->get_positional() ? command.positionals : command.options).push_back(argument(*option));
  for (const CLI::App* const subcommand : app.get_subcommands({}))
    command.commands.push_back(command_tree(*subcommand));
  return command;
}

}  // namespace articular::tools
