#include "tools/target_error/pilot_runs.hpp"

#include <algorithm>

#include "tools/error_bars/error_bars.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

StudyCase case_of(const PilotFolder& place, const PilotRun& run) {
  StudyCase c{run.name, run.name, {place.overrides, place.threads, {}}};
  std::replace(c.folder.begin(), c.folder.end(), ' ', '_');
  c.settings.reproducible = place.reproducible;
  c.settings = c.settings + StudySettings{run.overrides, {}, {}};
  return c;
}

}  // namespace

RunHistory quoted_history(const fs::path& results) {
  RunHistory history = read_history(results / "history.csv");
  add_force_sizes(history);
  return history;
}

fs::path results_of(const PilotFolder& place, const PilotRun& run) {
  return results_of(place.folder, case_of(place, run));
}

void run_pilot(const PilotFolder& place, double time_limit, PilotRun& run) {
  Study study;
  study.file = study.scenario = place.scenario;
  study.time_limit = time_limit;
  const StudyCase c = case_of(place, run);
  const CaseRecord record = run_cases(study, {c}, {place.folder, 1, false, place.quiet}).front();
  const fs::path results = results_of(place.folder, c);
  run.seconds = record.wall();
  if (record.succeeded()) {
    run.history = quoted_history(results);
    return;
  }
  run.failure = record.outcome();
  if (!record.message.empty()) run.failure += ": " + record.message;
  fs::remove(results.parent_path() / "case.json");  // with more time it may succeed
}

}  // namespace articular::tools
