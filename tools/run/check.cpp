#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/build/build_model.hpp"
#include "sim/contact/initial_overlap.hpp"
#include "sim/step/overlap_resolution.hpp"
#include "sim/step/stepper.hpp"
#include "tools/run/commands.hpp"
#include "tools/run/scene_table.hpp"

namespace articular::tools {
namespace {

std::string names(const sim::Model& model, int a, int b) {
  return fmt::format("`{}` and `{}`", model.bodies[static_cast<std::size_t>(a)].name,
                     model.bodies[static_cast<std::size_t>(b)].name);
}

/// By the surfaces as drawn.
void print(const sim::Model& model, const sim::InitialOverlap& overlap) {
  const sim::Vec3 mm = 1e3 * overlap.place;
  fmt::print(
      "warning: {} overlap at the start by {:.3g} mm, at ({:.3f} {:.3f} {:.3f}) mm; "
      "{} node{} in the other body\n",
      names(model, overlap.a, overlap.b), 1e3 * overlap.depth, mm.x(), mm.y(), mm.z(),
      overlap.num_nodes, overlap.num_nodes == 1 ? " lies" : "s lie");
}

/// By contact, as `run` goes by it.
void print(const sim::Model& model, const sim::OverlapAtStart& overlap) {
  const sim::ContactModel& contact = model.contacts[static_cast<std::size_t>(overlap.contact)];
  const std::string pair =
      contact.a == contact.b
          ? fmt::format("`{}` and itself", model.bodies[static_cast<std::size_t>(contact.a)].name)
          : names(model, contact.a, contact.b);
  fmt::print("warning: contact finds {} {:.3g} mm deep in each other at the start: {}\n", pair,
             1e3 * overlap.depth,
             overlap.is_set_apart
                 ? std::string("`run` sets them apart first")
                 : fmt::format("`run` starts so, pressed together, for it is below 1/100 of an "
                               "element ({:.3g} mm)",
                               1e3 * contact.max_penetration));
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
      "Runs nothing and writes nothing. Exit code 0: `run` will start; 2: it would not; 3: bodies "
      "overlap so that `run` could not set them apart.");
  command->callback([arguments, &exit_code] {
    const sim::Scenario scenario = sim::read_scenario(arguments->scenario, arguments->overrides);
    const sim::Model model = sim::build_model(scenario);
    for (const std::string& warning : model.warnings) fmt::print("warning: {}\n", warning);
    sim::Stepper stepper(model, sim::step_settings(scenario));
    const sim::State start = stepper.initial();
    fmt::print("{}", scene_table(scenario, model, stepper));
    if (const auto loose = stepper.loose())
      fmt::print("\nAt the start{} nothing{} resists: {}\n",
                 model.contacts.empty() ? "" : ", where nothing presses yet,",
                 model.is_static ? "" : " but inertia", loose->words);
    fmt::print("\n");
    for (const sim::InitialOverlap& overlap : sim::initial_overlaps(model)) print(model, overlap);
    for (const sim::OverlapAtStart& overlap : sim::overlaps_at_start(scenario, model, start.y))
      print(model, overlap);
    fmt::print("{}: ok\n", arguments->scenario.string());
    exit_code = 0;
  });
}

}  // namespace articular::tools
