#include "tools/study/study_run.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <mutex>

#include "parallel/thread_pool.hpp"
#include "sim/base/error.hpp"
#include "sim/scenario/scenario.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/this_program.hpp"
#include "tools/study/study_prepare.hpp"
#include "tools/study/study_record.hpp"
#include "tools/study/study_values.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using End = ProgramUse::End;

fs::path folder_of(const fs::path& directory, const StudyCase& c) {
  return directory / "cases" / c.folder;
}

/// Where the meshes that `prepare` makes lie, one folder for all cases that say the same.
fs::path prepared_folder(const fs::path& directory, const StudySettings& settings) {
  if (settings.prepare.empty()) return directory;
  return directory / "prepared" /
         fmt::format("{:016x}", std::hash<std::string>{}(joined(settings.prepare)));
}

class CaseRunner {
 public:
  CaseRunner(const Study& study, const StudyRunOptions& options)
      : study_(study),
        options_(options),
        directory_(fs::absolute(options.directory)),
        program_(this_program().string()),
        fixed_key_(text_of(study.scenario) + identity(program_)) {}

  /// Reads the scenario as the case has it, so that a mistake costs seconds and not hours.
  void check(const StudyCase& c) const {
    ::setenv(kPrepared, prepared_folder(directory_, c.settings).c_str(), 1);
    try {
      sim::read_scenario(study_.scenario, c.settings.overrides);
    } catch (const sim::InputError& error) {
      throw sim::InputError(
          fmt::format("{} (case `{}` of {})", error.what(), c.name, study_.file.string()));
    }
  }

  /// Makes the meshes of a case, if it asks for some that are not there yet.
  void prepare(const StudyCase& c) {
    if (c.settings.prepare.empty()) return;
    const fs::path folder = prepared_folder(directory_, c.settings);
    const std::string failure = prepare_meshes(folder, c.settings.prepare, false);
    if (!failure.empty())
      throw sim::InputError({study_.file.string()},
                            fmt::format("case `{}`: `prepare` failed {}", c.name, failure));
  }

  CaseRecord finished(const StudyCase& c) const {
    if (options_.fresh) return {};
    return read_record(folder_of(directory_, c) / "case.json", key_of(c));
  }

  /// Runs a case once more.
  void run(const StudyCase& c, CaseRecord& record) const {
    const fs::path folder = folder_of(directory_, c);
    fs::create_directories(folder);
    const fs::path log = folder / "log";
    const std::string prepared = prepared_folder(directory_, c.settings).string();
    const ProgramUse use = run_measured(command_of(c), {std::string(kPrepared) + "=" + prepared},
                                        log, study_.time_limit, interruption_asked);
    if (use.end == End::Interrupted || interruption_asked()) throw StudyInterrupted{};
    record.runs.push_back(use);
    record.message = record.succeeded() ? "" : first_error(log);
    if (record.succeeded()) check_outputs(c);
    write_record(folder / "case.json", key_of(c), record);
  }

 private:
  /// At the first case rather than after the last.
  void check_outputs(const StudyCase& c) const {
    const RunHistory history = read_history(results_of(directory_, c) / "history.csv");
    for (const StudyOutput& output : study_.outputs)
      output_value(output, history, study_.file.string());
  }

  std::vector<std::string> command_of(const StudyCase& c) const {
    std::vector<std::string> command{program_,  "run",   study_.scenario.string(),
                                     "--quiet", "--out", results_of(directory_, c).string()};
    if (c.settings.threads) {
      command.emplace_back("--threads");
      command.push_back(std::to_string(*c.settings.threads));
    }
    if (c.settings.reproducible) command.emplace_back("--reproducible");
    for (const std::string& text : c.settings.overrides) {
      command.emplace_back("--set");
      command.push_back(text);
    }
    return command;
  }

  std::string key_of(const StudyCase& c) const {
    std::vector<std::string> words = command_of(c);
    words.insert(words.end(), c.settings.prepare.begin(), c.settings.prepare.end());
    words.push_back(fixed_key_);
    words.push_back(fmt::format("{} side by side", options_.jobs));
    return fmt::format("{:016x}", std::hash<std::string>{}(joined(words)));
  }

  const Study& study_;
  const StudyRunOptions& options_;
  fs::path directory_;
  std::string program_, fixed_key_;
};

/// Tells the user how far the study is.
class CaseProgress {
 public:
  CaseProgress(std::size_t all, bool quiet) : all_(all), quiet_(quiet) {}

  void finished(const StudyCase& c, const CaseRecord& record) {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (quiet_) return;
    fmt::print(stderr, "[{}/{}] {}: {}, {:.3g} s{}{}\n", done_, all_, c.name, record.outcome(),
               record.runs.back().wall_seconds, record.message.empty() ? "" : ": ", record.message);
  }

 private:
  std::mutex mutex_;
  std::size_t all_, done_ = 0;
  bool quiet_;
};

/// The cases that round number `round` has to run. Times of references don't matter: they run once.
std::vector<std::size_t> tasks_of_round(const std::vector<StudyCase>& cases,
                                        const std::vector<CaseRecord>& records, int round) {
  std::vector<std::size_t> tasks;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool failed = !records[i].runs.empty() && !records[i].succeeded();
    const bool wanted = round == 0 || cases[i].reference < 0;
    if (wanted && !failed && static_cast<int>(records[i].runs.size()) <= round) tasks.push_back(i);
  }
  return tasks;
}

}  // namespace

fs::path results_of(const fs::path& directory, const StudyCase& c) {
  return folder_of(directory, c) / "results";
}

std::vector<CaseRecord> run_cases(const Study& study, const std::vector<StudyCase>& cases,
                                  const StudyRunOptions& options) {
  CaseRunner runner(study, options);
  for (const StudyCase& c : cases) runner.check(c);
  for (const StudyCase& c : cases) runner.prepare(c);
  std::vector<CaseRecord> records;
  records.reserve(cases.size());
  for (const StudyCase& c : cases) records.push_back(runner.finished(c));
  std::size_t all = 0;
  for (int round = 0; round < study.repeats; ++round)
    all += tasks_of_round(cases, records, round).size();
  CaseProgress progress(all, options.quiet);
  ThreadPool pool(options.jobs);  // each thread waits for a program
  for (int round = 0; round < study.repeats; ++round) {
    const std::vector<std::size_t> tasks = tasks_of_round(cases, records, round);
    pool.run(static_cast<int>(tasks.size()), [&](int k, int) {
      const std::size_t i = tasks[static_cast<std::size_t>(k)];
      runner.run(cases[i], records[i]);
      progress.finished(cases[i], records[i]);
    });
  }
  return records;
}

}  // namespace articular::tools
