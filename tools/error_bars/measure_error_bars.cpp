#include "tools/error_bars/measure_error_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/base/atomic_file.hpp"
#include "sim/base/available_memory.hpp"
#include "sim/base/error.hpp"
#include "sim/output/results_folder.hpp"
#include "tools/error_bars/coarser_mesh.hpp"
#include "tools/error_bars/error_bar_report.hpp"
#include "tools/study/study_run.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

/// What summary.json says of the run.
struct MainRun {
  std::string summary;  // its text
  std::string inputs;   // a hash
  double peak_megabytes = 0;
  bool anything_touches = false;
};

MainRun read_main_run(const fs::path& directory) {
  MainRun run;
  run.summary = text_of(directory / "summary.json");
  const nlohmann::json json = nlohmann::json::parse(run.summary);
  run.inputs = json.at("inputs");
  run.peak_megabytes = json.at("peak_memory_MB");
  run.anything_touches = json.at("counts").at("reported_pairs") > 0;
  return run;
}

/// As many coarser runs side by side as there are threads for, and memory: none takes more than
/// the run itself.
int side_by_side(int threads, double megabytes_each, std::size_t runs) {
  constexpr double kShareOfMemory = 0.8, kMegabyte = 1 << 20;  // as in summary.json
  const double fit = kShareOfMemory * sim::available_memory_without_swap() /
                     (kMegabyte * std::max(1.0, megabytes_each));
  const double most = std::clamp<double>(static_cast<double>(runs), 1, threads);
  return static_cast<int>(std::clamp(fit, 1.0, most));
}

/// Coarser runs that are there are of these inputs and no others.
bool is_of(const std::string& inputs, const fs::path& folder) {
  return text_of(folder / "inputs") == inputs;
}

/// The folder of the coarser runs. Those of other inputs are removed.
/// @return whether none is there that counts
bool open_folder(const fs::path& folder, const std::string& inputs, bool goes_on) {
  if (fs::is_symlink(folder))
    throw sim::InputError({folder.string()},
                          "is a symbolic link; results are not written through one: remove it");
  const bool fresh = !(goes_on && is_of(inputs, folder));
  if (fresh)
    for (const char* const ours : {"cases", "prepared"}) fs::remove_all(folder / ours);
  fs::create_directories(folder);
  sim::write_text_file(folder / "inputs", inputs);
  return fresh;
}

std::vector<CoarserRun*> runs_to_do(std::vector<Direction>& directions) {
  std::vector<CoarserRun*> runs;
  for (Direction& direction : directions)
    for (CoarserRun& run : direction.runs)
      if (run.failure.empty()) runs.push_back(&run);
  return runs;
}

/// The runs as cases of a study.
std::vector<StudyCase> cases_of(const std::vector<CoarserRun*>& runs,
                                const std::vector<std::string>& overrides, int threads,
                                bool reproducible) {
  std::vector<StudyCase> cases;
  for (const CoarserRun* run : runs) {
    StudyCase c{run->name, run->name, {overrides, threads, {}}};
    std::replace(c.folder.begin(), c.folder.end(), ' ', '_');
    c.settings.reproducible = reproducible;
    c.settings = c.settings + StudySettings{run->overrides, {}, {}};
    cases.push_back(std::move(c));
  }
  return cases;
}

RunHistory quoted_history(const fs::path& results) {
  RunHistory history = read_history(results / "history.csv");
  add_force_sizes(history);
  return history;
}

/// Steps of mean length, relative to those of the run: they are cut at events.
double step_size(const RunHistory& history, const RunHistory& own) {
  return static_cast<double>(own.columns[0].size() - 1) /
         static_cast<double>(std::max<std::size_t>(2, history.columns[0].size()) - 1);
}

/// A run that took no longer steps than the one before says nothing.
void drop_equal_steps(Direction& steps) {
  double before = 1;
  std::erase_if(steps.runs, [&](const CoarserRun& run) {
    if (!run.failure.empty()) return false;
    const bool is_equal = run.size < 1.05 * before;
    before = std::max(before, run.size);
    return is_equal;
  });
  if (steps.runs.empty() && steps.left_out.empty())
    steps.left_out = "events cut the steps, which are no longer in the coarser runs";
}

}  // namespace

std::string measure_error_bars(const sim::Scenario& scenario, const ErrorBarSettings& settings) {
  const sim::ResultsFolder lock(settings.directory);
  const MainRun main = read_main_run(settings.directory);
  const fs::path folder = fs::absolute(settings.directory / "error-bars");
  const bool fresh = open_folder(folder, main.inputs, settings.goes_on);

  std::vector<Direction> directions{
      coarser_meshes(scenario, settings.overrides, folder / "prepared", fresh, settings.mesh_ratio),
      coarser_steps(scenario), softer_contact(scenario, main.anything_touches),
      looser_iteration(scenario)};
  const std::vector<CoarserRun*> runs = runs_to_do(directions);

  Study study;
  study.file = study.scenario = scenario.file;
  const int jobs = side_by_side(settings.threads, main.peak_megabytes, runs.size());
  const std::vector<StudyCase> cases = cases_of(
      runs, settings.overrides, std::max(1, settings.threads / jobs), scenario.reproducible);
  if (!settings.quiet) fmt::print(stderr, "articular: error bars: {} coarser runs\n", runs.size());
  const std::vector<CaseRecord> records =
      run_cases(study, cases, {folder, jobs, fresh, settings.quiet});

  const RunHistory own = quoted_history(settings.directory);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!records[i].succeeded()) {
      runs[i]->failure = records[i].outcome();
      if (!records[i].message.empty()) runs[i]->failure += ": " + records[i].message;
      continue;
    }
    runs[i]->history = quoted_history(results_of(folder, cases[i]));
    if (runs[i]->size == 0) runs[i]->size = step_size(runs[i]->history, own);
  }
  drop_equal_steps(directions[1]);
  const std::vector<ErrorBar> bars = error_bars(own, directions);
  sim::write_text_file(settings.directory / "error_bars.csv", error_bars_csv(directions, bars));
  sim::write_text_file(settings.directory / "summary.json",
                       summary_with_error_bars(main.summary, directions, bars));
  return error_bars_text(directions, bars);
}

}  // namespace articular::tools
