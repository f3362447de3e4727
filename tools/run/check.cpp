#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/build/build_model.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/step/overlap_report.hpp"
#include "sim/step/stepper.hpp"
#include "tools/run/commands.hpp"
#include "tools/run/contact_doctor.hpp"
#include "tools/run/contact_table.hpp"
#include "tools/run/override_files.hpp"
#include "tools/run/scene_table.hpp"
#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::tools {
namespace {

constexpr int kCannotGoOn = 3;  // of exit codes

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    std::filesystem::path scenario;
    std::vector<std::string> overrides;
    bool contact = false, diagnose = false;
    double seconds = 60;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("check",
                                         "Read a scenario and its meshes, and say what is wrong "
                                         "with them: what is not valid, and bodies "
                                         "that overlap at the start");
  command
      ->add_option("scenario", arguments->scenario,
                   "Scenario file (.toml), or the name of a shipped one: see `articular scenarios`")
      ->required();
  command->add_option("--set", arguments->overrides, "Override a value, as in run")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command->add_flag("--contact", arguments->contact,
                    "Say of each pair that may touch how stiff contact is, which side is the "
                    "non-mortar side and how near the bodies are; what is tied and may touch too; "
                    "flat and coarse surface elements");
  command->add_flag("--diagnose", arguments->diagnose,
                    "Run until a step fails, without writing anything, then try that step without "
                    "contact, with each pair alone and with all but one: which makes it fail?");
  command
      ->add_option("--seconds", arguments->seconds,
                   "Of --diagnose: wall time until the failure, and again for all trials [60]")
      ->check(CLI::PositiveNumber);
  command->footer(fmt::format(
      "Writes nothing, and runs nothing but for --diagnose. Exit code 0: `run` will start; 2: it "
      "would not; 3: bodies overlap so that `run` could not set them apart, or a step failed.\n"
      "Files of tissue: {}. Surfaces of bones also: .stl, .obj, .ply, .vtp.",
      sim::kTissueEndings));
  command->callback([arguments, &exit_code] {
    const sim::Scenario scenario = sim::read_scenario(find_file_for("run", arguments->scenario),
                                                      with_override_files(arguments->overrides));
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
    for (const sim::OverlapReport& overlap : sim::overlap_reports(scenario, model, start.y))
      fmt::print("warning: {}\n", overlap.words);
    if (arguments->contact) fmt::print("{}\n", contact_table(model));
    if (arguments->diagnose && diagnose(scenario, model, arguments->seconds)) {
      exit_code = kCannotGoOn;
      return;
    }
    fmt::print("{}: ok\n", arguments->scenario.string());
    exit_code = 0;
  });
}

}  // namespace articular::tools
