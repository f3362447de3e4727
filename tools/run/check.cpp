#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/build/build_model.hpp"
#include "sim/contact/initial_overlap.hpp"
#include "tools/run/commands.hpp"

namespace articular::tools {
namespace {

void print(const sim::Model& model, const sim::InitialOverlap& overlap) {
  const auto name = [&](int body) { return model.bodies[static_cast<std::size_t>(body)].name; };
  const sim::Vec3 mm = 1e3 * overlap.place;
  fmt::print(
      "warning: `{}` and `{}` overlap at the start by {:.3g} mm, at ({:.3f} {:.3f} {:.3f}) mm; "
      "{} node{} in the other body\n",
      name(overlap.a), name(overlap.b), 1e3 * overlap.depth, mm.x(), mm.y(), mm.z(),
      overlap.num_nodes, overlap.num_nodes == 1 ? " lies" : "s lie");
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::filesystem::path scenario;
    std::vector<std::string> overrides;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("check",
                                         "Read a scenario and its meshes, and say what is wrong "
                                         "with them: what is not valid, and bodies "
                                         "that overlap at the start");
  command->add_option("scenario", arguments->scenario, "Scenario file (.toml)")->required();
  command->add_option("--set", arguments->overrides, "Override a value, as in run")
      ->allow_extra_args(false);
  command->footer(
      "Runs nothing and writes nothing. Exit code 0: `run` will start; 2: it would not.");
  command->callback([arguments, &exit_code] {
    const sim::Model model =
        sim::build_model(sim::read_scenario(arguments->scenario, arguments->overrides));
    for (const std::string& warning : model.warnings) fmt::print("warning: {}\n", warning);
    for (const sim::InitialOverlap& overlap : sim::initial_overlaps(model)) print(model, overlap);
    fmt::print("{}: ok\n", arguments->scenario.string());
    exit_code = 0;
  });
}

}  // namespace articular::tools
