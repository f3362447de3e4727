#include "sim/run/run.hpp"
#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/scenario/quantity.hpp"
#include "sim/step/overlap_report.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <functional>
#include <memory>

#include "tools/error_bars/measure_error_bars.hpp"
#include "tools/process/interruption.hpp"
#include "tools/run/commands.hpp"
#include "tools/run/override_files.hpp"
#include "tools/run/portable_start.hpp"
#include "tools/run/progress.hpp"
#include "tools/shipped/shipped_scenarios.hpp"
#include "tools/study/study_prepare.hpp"
#include "tools/target_error/reach_target.hpp"

namespace articular::tools {
namespace {

constexpr int kMostThreads = 256;

struct RunArguments {
  std::filesystem::path scenario, out;
  std::vector<std::string> overrides;
  int threads = 1;
  bool resume = false, overwrite = false, quiet = false, error_bars = false;
  bool reproducible = false;
  std::string target_error, of;
  double budget = 3600;  // [s]
  double mesh_ratio = 0;
};

void print(const sim::Model& model, const sim::OverlapResolution& resolution) {
  const auto name = [&](int body) { return model.bodies[static_cast<std::size_t>(body)].name; };
  for (const sim::ResolvedOverlap& overlap : resolution.overlaps) {
    const sim::ContactModel contact = model.contacts[overlap.contact];
    fmt::print(stderr, "articular: start: `{}` and `{}` overlapped by {:.3g} mm, now {:.2g} mm\n",
               name(contact.a), name(contact.b), 1e3 * overlap.before, 1e3 * overlap.after);
  }
  fmt::print(stderr,
             "articular: start: to push them apart nodes were moved by up to {:.3g} mm "
             "({} solutions)\n",
             1e3 * resolution.largest_motion, resolution.solutions);
}

std::filesystem::path results_folder(const sim::Scenario& scenario, const RunArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return scenario.output.directory.value_or(std::filesystem::path("out") / scenario.name);
}

int run_once(const sim::Scenario& scenario, const RunArguments& arguments,
             const std::function<bool()>& is_to_stop = interruption_asked) {
  sim::Model model = sim::build_model(scenario);
  sim::warn_of_overlaps(scenario, model);
  for (const std::string& warning : model.warnings)
    fmt::print(stderr, "articular: warning: {}\n", warning);

  sim::RunOptions options;
  options.directory = results_folder(scenario, arguments);
  options.resume = arguments.resume;
  options.overwrite = arguments.overwrite;
  Progress progress(scenario, arguments.quiet);
  options.is_to_stop = is_to_stop;
  options.after_step = [&](const sim::State& state, double) {
    progress.update(state);
    return is_to_stop();
  };
  options.after_iteration = [&](double t, const sim::NewtonIteration& iteration) {
    progress.update(t, iteration);
    return is_to_stop();
  };
  options.after_overlap_resolution = [&](const sim::OverlapResolution& resolution) {
    if (!arguments.quiet) print(model, resolution);
  };
  options.warn = [&](const std::string& warning) {
    progress.finish();
    fmt::print(stderr, "articular: warning: {}\n", warning);
  };
  options.note = [&](const std::string& note) {
    progress.finish();
    fmt::print(stderr, "articular: note: {}\n", note);
  };
  listen_for_interruption();
  std::signal(SIGPIPE, SIG_IGN);  // the write that it is about fails and says why
  sim::RunOutcome outcome = sim::RunOutcome::Finished;
  try {
    outcome = sim::run(scenario, model, options);
  } catch (...) {
    progress.finish();
    throw;
  }
  progress.finish();
  for (const std::string& name :
       {scenario.name + ".pvd", std::string("history.csv"), std::string("summary.json")})
    if (std::filesystem::exists(options.directory / name))  // interrupted before the first frame
      fmt::print("{}\n", (options.directory / name).string());
  if (outcome == sim::RunOutcome::Finished) return 0;
  if (interruption_asked()) fmt::print(stderr, "articular: interrupted; go on with --resume\n");
  return kInterruptedExitCode;
}

int print_error_bars(const sim::Scenario& scenario, const RunArguments& arguments) {
  const std::filesystem::path directory = results_folder(scenario, arguments);
  try {
    const std::string table =
        measure_error_bars(scenario, {directory, arguments.overrides, arguments.mesh_ratio,
                                      arguments.threads, arguments.resume, arguments.quiet});
    fmt::print("{}\n\n{}", (directory / "error_bars.csv").string(), table);
    return 0;
  } catch (const StudyInterrupted&) {
    fmt::print(stderr,
               "articular: interrupted in the coarser runs of the error bars; the results of the "
               "run are whole, and --resume goes on with what is missing\n");
    return kInterruptedExitCode;
  }
}

sim::Scenario read_scenario(const RunArguments& arguments) {
  sim::Scenario scenario =
      sim::read_scenario(find_file_for("run", arguments.scenario), arguments.overrides);
  scenario.threads = arguments.threads;
  scenario.reproducible = arguments.reproducible;
  return scenario;
}

int run_to_target(const sim::Scenario& scenario, const RunArguments& arguments) {
  TargetSettings settings;
  settings.error = arguments.target_error;
  settings.of = arguments.of;
  settings.budget = arguments.budget;
  settings.directory = results_folder(scenario, arguments);
  settings.overrides = arguments.overrides;
  settings.threads = arguments.threads;
  settings.quiet = arguments.quiet;
  settings.run = [&](const std::vector<std::string>& overrides, bool goes_on,
                     const std::function<bool()>& is_to_stop) {
    RunArguments chosen = arguments;
    chosen.overrides.insert(chosen.overrides.end(), overrides.begin(), overrides.end());
    chosen.out = settings.directory;
    chosen.resume = arguments.resume && goes_on;
    return run_once(read_scenario(chosen), chosen, is_to_stop);
  };
  listen_for_interruption();
  try {
    const TargetOutcome outcome = reach_target(scenario, settings);
    if (!outcome.text.empty()) fmt::print("\n{}", outcome.text);
    if (!outcome.refusal.empty()) throw sim::SimulationError(outcome.refusal);
    return outcome.exit_code;
  } catch (const StudyInterrupted&) {
    fmt::print(stderr,
               "articular: interrupted in the coarser runs; those that are done are kept, and the "
               "same command goes on with what is missing\n");
    return kInterruptedExitCode;
  }
}

int run_scenario(const RunArguments& arguments) {
  if (arguments.reproducible) use_portable_arithmetic();
  const sim::Scenario scenario = read_scenario(arguments);
  if (!arguments.target_error.empty()) return run_to_target(scenario, arguments);
  const int exit_code = run_once(scenario, arguments);
  return exit_code == 0 && arguments.error_bars ? print_error_bars(scenario, arguments) : exit_code;
}

double budget_of(const std::string& text) {
  double seconds = 0;
  try {
    seconds = sim::parse_quantity(text, sim::kTime);
  } catch (const std::invalid_argument& problem) {
    throw sim::InputError(fmt::format("--budget: {}", problem.what()));
  }
  if (!(seconds > 0)) throw sim::InputError("--budget: expected more than no time, \"10 min\"");
  return seconds;
}

CLI::Option* add_target_options(CLI::App& command, RunArguments& arguments) {
  CLI::Option* target = command.add_option(
      "--target-error", arguments.target_error,
      "Choose element size, step, contact and tolerance so that the discretisation error of --of "
      "stays below: a share such as 2%, or an amount such as '0.05 mm'");
  target->type_name("ERROR");
  CLI::Option* of = command.add_option(
      "--of", arguments.of,
      "With --target-error: a result, tip.position.z, at the end of the run; or at its extreme, "
      "plate.force:largest, plate.force:smallest");
  of->type_name("RESULT")->needs(target);
  target->needs(of);
  command
      .add_option_function<std::string>(
          "--budget", [&arguments](const std::string& text) { arguments.budget = budget_of(text); },
          "With --target-error: time for all runs together, '10 min' [1 h]")
      ->type_name("TIME")
      ->needs(target);
  return target;
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Run a scenario and write its results");
  command
      ->add_option("scenario", arguments->scenario,
                   "Scenario file (.toml), or the name of a shipped one: see `articular scenarios`")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "Folder of the results (default: output.directory, else out/NAME)")
      ->type_name("DIR");
  command
      ->add_option("--set", arguments->overrides,
                   "Override a value by its path, e.g. --set duration='0.1 s' "
                   "--set body.disc_left.material.c10='1 MPa'; @FILE: those in its lines")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command
      ->add_option(
          "--threads", arguments->threads,
          "Of element loops, linear solvers and contact search; results have the same bits with "
          "any number [1]")
      ->check(CLI::Range(1, kMostThreads));
  command->add_flag("--resume", arguments->resume,
                    "Go on from the folder's last checkpoint, if there is one");
  command->add_flag("--overwrite", arguments->overwrite,
                    "Replace results of another scenario in the folder");
  CLI::Option* error_bars =
      command->add_flag("--error-bars", arguments->error_bars,
                        "Run again coarser in mesh, step, contact and tolerance, and estimate the "
                        "discretisation error of every probe: two to six times the time");
  command
      ->add_option("--mesh-ratio", arguments->mesh_ratio,
                   "Of element sizes from mesh to mesh, for error bars. A small one where coarse "
                   "meshes find no equilibrium [1.5, or what divides the cells best]")
      ->check(CLI::Range(1.1, 2.0))
      ->needs(error_bars);
  add_target_options(*command, *arguments)->excludes(error_bars);
  command->add_flag("--reproducible", arguments->reproducible,
                    "The same bits on every x86-64 processor, by kernels that all have: slower. "
                    "Goes on with --resume in the same way only");
  command->add_flag("--quiet", arguments->quiet, "No progress on stderr");
  command->footer(
      "Writes DIR/NAME.pvd (open it in ParaView), DIR/frames/, DIR/history.csv (probes over "
      "time),\n"
      "DIR/summary.json (settings, counts, wall time by phase, energy balance) and "
      "DIR/checkpoint/.\n"
      "Prints the names of these files; with --error-bars also DIR/error_bars.csv and its table. "
      "The\n"
      "coarser runs stay in DIR/error-bars/; --threads are shared among them. With --target-error "
      "the\n"
      "coarser runs stay in DIR/target-error/.");
  command->callback([arguments, &exit_code] {
    arguments->overrides = with_override_files(arguments->overrides);
    exit_code = run_scenario(*arguments);
  });
}

}  // namespace articular::tools
