#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/output/frame_writer.hpp"
#include "tools/process/interruption.hpp"
#include "tools/shipped/shipped_scenarios.hpp"
#include "tools/study/case_warnings.hpp"
#include "tools/study/population_run.hpp"
#include "tools/study/study_command.hpp"
#include "tools/study/study_report.hpp"
#include "tools/study/study_sweep.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMostJobs = 256;
// [s] A worker is heard of every two seconds; a day is longer than any hiccup of a file server.
constexpr double kLeastSilence = 5, kMostSilence = 86400;

struct StudyArguments {
  fs::path study;
  StudyRunOptions options;
  bool cpu_time = false;
};

/// The front as a picture; without gnuplot its commands are there all the same.
void draw(const std::string& commands, const fs::path& directory, const fs::path& picture) {
  const fs::path script = directory / "pareto.gnuplot";
  sim::write_text_file(script, commands);
  if (commands.empty()) return;
  std::string why;
  try {
    const ProgramUse use = run_measured({"gnuplot", script.string()}, {}, directory / "gnuplot.log",
                                        {}, interruption_asked);
    if (use.end == ProgramUse::End::Exited && use.code == 0) {
      fmt::print("{}\n", picture.string());
      return;
    }
    why = "gnuplot failed, see " + (directory / "gnuplot.log").string();
  } catch (const sim::SystemError&) {
    why = "gnuplot is missing (Debian: gnuplot-nox)";
  }
  fmt::print(stderr, "articular: no picture: {}; its commands are in {}\n", why, script.string());
}

/// Of two references the finer one takes longer. Where it does not, `size` is hardly what was
/// meant, and what is extrapolated from them lies on the wrong side.
void doubt_sizes(const Study& study, const std::vector<StudyCase>& cases,
                 const std::vector<CaseRecord>& records) {
  constexpr double kAtLeast = 0.7;  // of the coarser one's time
  std::vector<double> time(study.references.size());
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (cases[i].reference >= 0 && records[i].succeeded())
      time[static_cast<std::size_t>(cases[i].reference)] = records[i].cpu();
  for (std::size_t k = 0; k + 1 < time.size(); ++k)
    if (time[k] < kAtLeast * time[k + 1])
      fmt::print(stderr,
                 "articular: warning: the reference of size {:g} took {:.2g} s, and that of size "
                 "{:g} took {:.2g} s: is the smaller `size` that of the finer one?\n",
                 study.references[k].size, time[k], study.references[k + 1].size, time[k + 1]);
}

/// Runs what the knobs make of the scenario, and says what each setting costs and buys.
int compare_settings(const Study& study, const StudyRunOptions& options, bool cpu_time) {
  const std::vector<StudyCase> cases = study_cases(study);
  const std::vector<CaseRecord> records = run_cases(study, cases, options);
  const CaseWarnings warnings = case_warnings(cases, records, options.directory);
  const std::string warned = warnings_table(warnings);
  tell_warnings(warnings);
  doubt_sizes(study, cases, records);
  const fs::path table = options.directory / "study.csv", text = options.directory / "study.md",
                 picture = options.directory / "pareto.svg";
  if (study.is_sweep()) {
    const auto values = values_of_cases(study, cases, records, options.directory);
    sim::write_text_file(table, sweep_csv(study, cases, records, values));
    sim::write_text_file(text, sweep_text(study, cases, records, values) + warned);
    fmt::print("{}\n{}\n", text.string(), table.string());
    require_success(records);
    return 0;
  }
  const Assessment assessment =
      assess(study, cases, records, options.directory, cpu_time || options.jobs > 1);
  sim::write_text_file(table, study_csv(study, cases, records, assessment));
  sim::write_text_file(text, study_text(study, cases, records, assessment) + warned);
  fmt::print("{}\n{}\n", text.string(), table.string());
  draw(study_plot(cases, study.title, assessment, picture), options.directory, picture);
  require_success(records);
  return 0;
}

void check_engine(const EngineOptions& engine) {
  const bool take_machines = engine.kind == EngineKind::Ssh || engine.kind == EngineKind::Parallel;
  if (engine.kind == EngineKind::Ssh && engine.machines.empty())
    throw sim::InputError("--engine ssh: expected --machines FILE, a machine a line");
  if (!take_machines && !engine.machines.empty())
    throw sim::InputError("--machines: expected --engine ssh or parallel beside it");
}

int study(const StudyArguments& arguments) {
  const Study study = read_study(find_file_for("study", arguments.study));
  StudyRunOptions options = arguments.options;
  check_engine(options.engine);
  if (options.directory.empty()) options.directory = fs::path("out") / study.name;
  std::error_code error;
  fs::create_directories(options.directory, error);
  if (error)
    throw sim::SystemError(options.directory.string() + ": can't be made: " + error.message());
  try {
    return study.population ? study_population(study, options)
                            : compare_settings(study, options, arguments.cpu_time);
  } catch (const StudyInterrupted&) {
    fmt::print(stderr, "articular: interrupted; the same command goes on with what is missing\n");
    return kInterruptedExitCode;
  }
}

const char* const kStudyHelp =
    R"(Runs a scenario again and again with what STUDY.toml varies (steps, meshes, elements, solvers,
...), and compares each run with what is right: a converged run, an exact value, or an
extrapolation from three runs. Writes DIR/study.md (what is worth its time, what is not, what the
next halving of the error costs), DIR/study.csv (all figures) and DIR/pareto.svg (error against
time). Where the study does not say what is right, it lists the outputs of all cases side by side.
With a [population] it draws parameters or takes anatomies, and writes DIR/population.md, .csv and
.html: who failed and why, distributions, tornado, Sobol indices, pictures of the extremes.
A case that fails is a result like others. Started again, it runs only what is missing or was made
with another program, scenario or arguments; meshes that changed it does not notice (--fresh). The
format of STUDY.toml and an example: tools/study/README.md; its keys: articular keys study)";

}  // namespace

void add_study_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<StudyArguments>();
  CLI::App& command =
      *app.add_subcommand("study", "What settings of a scenario cost, and what they buy");
  command
      .add_option("study", arguments->study,
                  "Study file (.toml), or the name of a shipped one: see `articular scenarios`")
      ->required();
  command
      .add_option("--out", arguments->options.directory,
                  "Folder of the results (default: out/NAME)")
      ->type_name("DIR");
  command
      .add_option(
          "--jobs", arguments->options.jobs,
          "Cases side by side, of an engine its workers; with more than one, times are those of "
          "the processor [1]")
      ->check(CLI::Range(1, kMostJobs))
      ->type_name("N");
  command
      .add_option(
          "--engine", arguments->options.engine.kind,
          "Who runs the cases: this machine, Slurm, GNU parallel, machines by ssh, or whoever "
          "runs `articular work` [local]")
      ->transform(CLI::CheckedTransformer(
                      std::map<std::string, EngineKind>{{"local", EngineKind::Local},
                                                        {"slurm", EngineKind::Slurm},
                                                        {"parallel", EngineKind::Parallel},
                                                        {"ssh", EngineKind::Ssh},
                                                        {"folder", EngineKind::Folder}})
                      .description(""))  // the type says it
      ->type_name("local|slurm|parallel|ssh|folder");
  command
      .add_option("--machines", arguments->options.engine.machines,
                  "For ssh: a file with a line a machine, NAME [WORKERS]; for parallel: its "
                  "--sshloginfile")
      ->type_name("FILE");
  command
      .add_option("--lost-after", arguments->options.engine.silence_limit,
                  "Seconds after which a worker that is not heard of counts as dead [60]")
      ->check(CLI::Range(kLeastSilence, kMostSilence))
      ->type_name("SECONDS");
  command.add_flag("--cpu-time", arguments->cpu_time,
                   "Judge by processor time, which other work on the machine disturbs less");
  command.add_flag("--fresh", arguments->options.fresh, "Run everything again");
  command.add_flag("--quiet", arguments->options.quiet, "No progress on stderr");
  command.footer(kStudyHelp);
  command.callback([arguments, &exit_code] {
    listen_for_interruption();
    exit_code = study(*arguments);
  });
}

}  // namespace articular::tools
