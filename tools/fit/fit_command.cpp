#include "tools/fit/fit_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/base/atomic_file.hpp"
#include "tools/fit/cross_validation.hpp"
#include "tools/fit/fit_report.hpp"
#include "tools/fit/missed_target.hpp"
#include "tools/process/interruption.hpp"
#include "tools/shipped/shipped_scenarios.hpp"
#include "tools/study/study_prepare.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFitJobs = 256, kMostFitIterations = 1000;
/// The fit ended before it converged: what is written is the best so far.
constexpr int kNotConverged = 3;

struct FitArguments {
  fs::path fit;
  StudyRunOptions options;
  int most_iterations = 20;
  bool cross_validate = false;
};

std::vector<LeftOut> groups_left_out(const Fit& fit, const FitResult& whole,
                                     const FitArguments& arguments,
                                     const StudyRunOptions& options) {
  if (!arguments.cross_validate) return {};
  std::vector<LeftOut> groups = cross_validate(fit, whole, arguments.most_iterations, options);
  for (const LeftOut& g : groups)
    if (!g.converged)
      fmt::print(stderr, "articular: warning: without group `{}` the fit did not converge\n",
                 g.group);
  return groups;
}

int run_fit(const FitArguments& arguments) {
  const Fit fit = read_fit(find_file_for("fit", arguments.fit));
  StudyRunOptions options = arguments.options;
  if (options.directory.empty()) options.directory = fs::path("out") / fit.name;
  if (arguments.cross_validate) check_groups(fit);
  sim::make_folders(options.directory);
  if (options.fresh) fs::remove_all(options.directory / "cases");
  options.fresh = false;  // within a fit the same run is asked for more than once
  listen_for_interruption();
  FitResult result;
  std::vector<LeftOut> groups;
  try {
    result = fit_parameters(fit, arguments.most_iterations, options);
    groups = groups_left_out(fit, result, arguments, options);
  } catch (const StudyInterrupted&) {
    fmt::print(stderr, "articular: interrupted; the same command goes on with what is missing\n");
    return kInterruptedExitCode;
  }
  std::vector<std::pair<const char*, std::string>> files = {
      {"fit.md", fit_text(fit, result)},
      {"measurements.csv", measurements_csv(fit, result)},
      {"parameters.csv", parameters_csv(fit, result)},
      {"fitted.txt", fitted_overrides(fit, result)}};
  if (arguments.cross_validate) {
    files[0].second += cross_validation_text(groups);
    files.emplace_back("cross_validation.csv", cross_validation_csv(groups));
  }
  for (const auto& [name, text] : files) {
    sim::write_text_file(options.directory / name, text);
    fmt::print("{}\n", (options.directory / name).string());
  }
  warn_of_missed(missed_measurements(fit, result));
  if (result.converged) return 0;
  fmt::print(stderr, "articular: not converged after {} iterations: {}\n", result.iterations,
             result.message);
  return kNotConverged;
}

const char* const kFitHelp =
    R"(Finds numbers of a scenario that nobody can measure, such as slack of ligaments, from what was
measured: laxity, forces, ways. FIT.toml names the scenario, the parameters with what is known of
them, and the measurements with their spreads; some can be held out. Runs the scenario again and
again (about one run for each parameter and iteration), and writes DIR/fit.md (measurements before
and after, parameters with their widths and what determines them), DIR/measurements.csv,
DIR/parameters.csv, and DIR/fitted.txt for `articular run SCENARIO --set @DIR/fitted.txt`. With
--cross-validate each `group` of measurements is left out in turn, and how far the fit to the others
is off there stands in DIR/fit.md and DIR/cross_validation.csv. Started again, it goes on with what
has run. The format of FIT.toml and an example: tools/fit/README.md.)";

}  // namespace

void add_fit_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<FitArguments>();
  CLI::App& command =
      *app.add_subcommand("fit", "Parameters of a scenario, found from measurements");
  command
      .add_option("fit", arguments->fit,
                  "Fit file (.toml), or the name of a shipped one: see `articular scenarios`")
      ->required();
  command
      .add_option("--out", arguments->options.directory,
                  "Folder of the results (default: out/NAME)")
      ->type_name("DIR");
  command.add_option("--jobs", arguments->options.jobs, "Runs at the same time [1]")
      ->check(CLI::Range(1, kMostFitJobs));
  command
      .add_option("--iterations", arguments->most_iterations,
                  "Ends, not converged, after so many [20]")
      ->check(CLI::Range(1, kMostFitIterations));
  command.add_flag("--cross-validate", arguments->cross_validate,
                   "Also leave out each `group` of measurements, and tell how far off it is then");
  command.add_flag("--fresh", arguments->options.fresh, "Run again what is there already");
  command.add_flag("--quiet", arguments->options.quiet, "No progress on stderr");
  command.footer(kFitHelp);
  command.callback([arguments, &exit_code] { exit_code = run_fit(*arguments); });
}

}  // namespace articular::tools
