#include "tools/shipped/scenarios_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::tools {
namespace {

void list() {
  const std::vector<ShippedScenario> scenarios = shipped_scenarios();
  std::size_t width = 0;
  for (const ShippedScenario& scenario : scenarios) width = std::max(width, scenario.name.size());
  for (const ShippedScenario& scenario : scenarios)
    fmt::print("{:<{}}  {:<10}  {}\n", scenario.name, width, scenario.kind, scenario.title);
}

}  // namespace

void add_scenarios_command(CLI::App& app, int& exit_code) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("scenarios", "List the scenarios and studies that are shipped");
  command->add_option("name", *name, "Print the path of this one's file instead");
  command->footer(
      "A line each: name, kind (dynamic, static or study), title. Commands take the name where\n"
      "they take a SCENARIO and there is no file of that path:\n"
      "    articular run mandible/opening\n"
      "    articular study mandible/clench-study\n"
      "Results go to the working folder. ARTICULAR_SCENARIOS names another folder of scenarios.");
  command->callback([name, &exit_code] {
    if (name->empty())
      list();
    else
      fmt::print("{}\n", find_file(*name).string());
    exit_code = 0;
  });
}

}  // namespace articular::tools
