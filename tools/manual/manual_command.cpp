#include "tools/manual/manual_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/base/version.hpp"
#include "tools/manual/man_page.hpp"
#include "tools/manual/shell_completion.hpp"

namespace articular::tools {
namespace {

std::string manual(const Command& program, const std::string& format) {
  if (format == "man") return man_page(program, sim::kVersion, sim::kReleaseDate);
  if (format == "bash") return bash_completion(program);
  if (format == "zsh") return zsh_completion(program);
  if (format == "fish") return fish_completion(program);
  throw sim::InputError("unknown format " + sim::in_ticks(format) +
                        ": expected man, bash, zsh or fish");
}

}  // namespace

void add_manual_command(CLI::App& app, int& exit_code) {
  const auto format = std::make_shared<std::string>("man");
  CLI::App& command = *app.add_subcommand(
      "manual", "Print this help as a manual page, or what a shell needs to complete arguments");
  command.add_option("format", *format, "What to print [man]")->type_name("man|bash|zsh|fish");
  command.footer(
      "Try: articular manual | man -l -\n"
      "     source <(articular manual bash)\n"
      "An installed articular needs neither: `man articular` shows the page, and bash, zsh and "
      "fish\n"
      "find their completions by themselves.");
  command.callback([&app, format, &exit_code] {
    fmt::print("{}", manual(command_tree(app), *format));
    exit_code = 0;
  });
}

}  // namespace articular::tools
