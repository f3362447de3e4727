#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/model.hpp"
#include "tools/commands.hpp"

namespace articular::tools {

void add_check_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::filesystem::path scenario;
    std::vector<std::string> overrides;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Read a scenario and its meshes, and say what is wrong with them");
  command->add_option("scenario", arguments->scenario, "Scenario file (.toml)")->required();
  command->add_option("--set", arguments->overrides, "Override a value, as in run")
      ->allow_extra_args(false);
  command->footer(
      "Runs nothing and writes nothing. Exit code 0: `run` will start; 2: it would not.");
  command->callback([arguments, &exit_code] {
    const sim::Model model =
        sim::build_model(sim::read_scenario(arguments->scenario, arguments->overrides));
    for (const std::string& warning : model.warnings) fmt::print("warning: {}\n", warning);
    fmt::print("{}: ok\n", arguments->scenario.string());
    exit_code = 0;
  });
}

}  // namespace articular::tools
