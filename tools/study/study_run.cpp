#include "tools/study/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>

#include "parallel/thread_pool.hpp"
#include "sim/base/error.hpp"
#include "sim/base/hash.hpp"
#include "sim/scenario/scenario.hpp"
#include "tools/engine/serve_tasks.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/this_program.hpp"
#include "tools/study/study_prepare.hpp"
#include "tools/study/study_record.hpp"
#include "tools/study/study_values.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using End = ProgramUse::End;

constexpr const char* kData = "ARTICULAR_DATA";  // an ssh would not pass it on

/// Runs a program in the folder of its results. Shells say with 127 that there is no such program,
/// which would be said of the shell itself.
constexpr const char* kRunThere =
    R"(mkdir -p "$0" && cd "$0" || exit 126
command -v "$1" > /dev/null || { echo "can't start $1"; exit 126; }
exec "$@")";

fs::path folder_of(const fs::path& directory, const StudyCase& c) {
  return directory / "cases" / c.folder;
}

/// Where the meshes that `prepare` makes lie, one folder for all cases that say the same.
fs::path prepared_folder(const fs::path& directory, const StudySettings& settings) {
  if (settings.prepare.empty()) return directory;
  return directory / "prepared" /
         fmt::format("{:016x}", std::hash<std::string>{}(joined(settings.prepare)));
}

/// When it is run, which no other case waits for.
bool makes_its_own_meshes(const StudyCase& c) {
  return c.prepares_alone && !c.settings.prepare.empty();
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
  void check(const StudyCase& c) {
    if (!c.command.empty()) return;
    ::setenv(kPrepared, prepared_of(c).c_str(), 1);
    for (const std::string& variable : c.environment) {
      const std::size_t is = variable.find('=');
      ::setenv(variable.substr(0, is).c_str(), variable.substr(is + 1).c_str(), 1);
    }
    try {
      std::vector<fs::path> files = sim::read_scenario(study_.scenario, c.settings.overrides).files;
      if (!makes_its_own_meshes(c)) files_of_case_[c.folder] = std::move(files);
    } catch (const sim::InputError& error) {
      throw sim::InputError(
          fmt::format("{} (case `{}` of {})", error.what(), c.name, study_.file.string()));
    }
  }

  /// Of cases that make their own meshes when they are run: those of one, so that it can be read.
  /// That they can't be made is a failure of that case, which it says when it is run.
  void check_alone(const StudyCase& c) {
    if (prepare_meshes(prepared_of(c), c.settings.prepare, false).empty()) check(c);
  }

  /// Makes the meshes of a case, if it asks for some that are not there yet.
  void prepare(const StudyCase& c) {
    if (c.settings.prepare.empty() || c.prepares_alone) return;
    const fs::path folder = prepared_of(c);
    const std::string failure = prepare_meshes(folder, c.settings.prepare, false);
    if (!failure.empty())
      throw sim::InputError({study_.file.string()},
                            fmt::format("case `{}`: `prepare` failed {}", c.name, failure));
  }

  /// Takes note of what the files hold that cases name, once all of them are made. A case that is
  /// run later has this in its key: should a file change meanwhile, the next call runs it again.
  void look_at_files(const std::vector<StudyCase>& cases) {
    for (const StudyCase& c : cases) {
      const auto files = files_of_case_.find(c.folder);
      if (files == files_of_case_.end()) continue;
      std::vector<std::string>& seen = seen_of_case_[c.folder];
      for (const fs::path& file : files->second)
        seen.push_back(fmt::format("{} {}", file.string(), hash_of(file)));
    }
  }

  CaseRecord finished(const StudyCase& c) const {
    if (options_.fresh) return {};
    return read_record(folder_of(directory_, c) / "case.json", key_of(c));
  }

  /// What runs a case once more, here or elsewhere.
  Task task_of(const StudyCase& c) const {
    const fs::path folder = folder_of(directory_, c);
    fs::create_directories(folder);
    Task task{c.folder, key_of(c), {}, c.environment, folder / "log", study_.time_limit};
    if (makes_its_own_meshes(c)) {
      fs::create_directories(prepared_of(c));
      task.commands.push_back(prepare_command(prepared_of(c), c.settings.prepare));
    }
    // Elsewhere the working folder is another one.
    const bool as_it_is = options_.engine.kind == EngineKind::Local || study_.scenario.empty();
    task.commands.push_back(
        command_of(c, as_it_is ? study_.scenario : fs::absolute(study_.scenario)));
    task.environment.push_back(std::string(kPrepared) + "=" + prepared_of(c).string());
    if (const char* data = std::getenv(kData); data != nullptr)
      task.environment.push_back(std::string(kData) + "=" + data);
    return task;
  }

  /// Takes in how it went.
  void finish(const StudyCase& c, const TaskEnd& end, CaseRecord& record) const {
    const fs::path folder = folder_of(directory_, c);
    record.runs.push_back(end.use);
    record.message = end.why;
    if (end.why.empty() && !record.succeeded())
      record.message = c.command.empty() ? first_error(folder / "log") : last_line(folder / "log");
    if (record.succeeded()) check_outputs(c);
    if (end.use.end != End::Lost) write_record(folder / "case.json", key_of(c), record);
  }

 private:
  /// At the first case rather than after the last.
  void check_outputs(const StudyCase& c) const {
    const RunHistory history = read_history(results_of(directory_, c) / "history.csv");
    for (const StudyOutput& output : study_.outputs)
      output_value(output, history, study_.file.string());
  }

  std::vector<std::string> command_of(const StudyCase& c, const fs::path& scenario) const {
    const std::string results = results_of(directory_, c).string();
    if (!c.command.empty()) {
      std::vector<std::string> command{"sh", "-c", kRunThere, results};
      command.insert(command.end(), c.command.begin(), c.command.end());
      return command;
    }
    std::vector<std::string> command{program_,  "run",   scenario.string(),
                                     "--quiet", "--out", results};
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
    std::vector<std::string> words = command_of(c, study_.scenario);
    words.insert(words.end(), c.settings.prepare.begin(), c.settings.prepare.end());
    words.insert(words.end(), c.environment.begin(), c.environment.end());
    words.push_back(fixed_key_);
    if (const auto seen = seen_of_case_.find(c.folder); seen != seen_of_case_.end())
      words.insert(words.end(), seen->second.begin(), seen->second.end());
    // Of a population times are not compared.
    if (!study_.population) words.push_back(fmt::format("{} side by side", options_.jobs));
    return fmt::format("{:016x}", std::hash<std::string>{}(joined(words)));
  }

  /// Of what a file holds. That it can't be read is said by the run that needs it.
  const std::string& hash_of(const fs::path& file) {
    const auto [known, is_new] = hashes_.try_emplace(file.string());
    std::error_code none;
    if (is_new && fs::is_regular_file(file, none))
      known->second = fmt::format("{:016x}", sim::hash_bytes(text_of(file)));
    return known->second;
  }

  fs::path prepared_of(const StudyCase& c) const {
    return c.prepares_alone ? folder_of(directory_, c) / "prepared"
                            : prepared_folder(directory_, c.settings);
  }

  const Study& study_;
  const StudyRunOptions& options_;
  fs::path directory_;
  std::string program_, fixed_key_;
  std::map<std::string, std::vector<fs::path>> files_of_case_;    // by its folder
  std::map<std::string, std::vector<std::string>> seen_of_case_;  // the same with what they hold
  std::map<std::string, std::string> hashes_;                     // by file
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

/// One round of cases, each of which is run once more.
struct Round {
  const std::vector<StudyCase>& cases;
  std::vector<std::size_t> numbers;
  std::vector<CaseRecord>& records;
};

void run_here(const CaseRunner& runner, Round round, int jobs, CaseProgress& progress) {
  ThreadPool pool(jobs);  // each thread waits for a program
  pool.run(static_cast<int>(round.numbers.size()), [&](int k, int) {
    const std::size_t i = round.numbers[static_cast<std::size_t>(k)];
    const Task task = runner.task_of(round.cases[i]);
    const TaskEnd end{task.key, run_task(task, interruption_asked), ""};
    if (end.use.end == End::Interrupted || interruption_asked()) throw StudyInterrupted{};
    runner.finish(round.cases[i], end, round.records[i]);
    progress.finished(round.cases[i], round.records[i]);
  });
}

int most_threads(const Round& round) {
  int most = 1;
  for (const std::size_t i : round.numbers)
    most = std::max(most, round.cases[i].settings.threads.value_or(1));
  return most;
}

void run_by_engine(const CaseRunner& runner, Round round, const StudyRunOptions& options,
                   CaseProgress& progress) {
  std::vector<Task> tasks;
  tasks.reserve(round.numbers.size());
  for (const std::size_t i : round.numbers) tasks.push_back(runner.task_of(round.cases[i]));
  TaskQueue queue(fs::absolute(options.directory) / "queue");
  const auto start = [&] {
    Workers workers =
        start_workers(options.engine, queue.folder(), options.jobs, most_threads(round));
    if (!options.quiet)
      fmt::print(stderr, "articular: {} cases for {}\n", tasks.size(), workers.where);
    return workers;
  };
  const auto ended = [&](std::size_t k, const TaskEnd& end) {
    const std::size_t i = round.numbers[k];
    runner.finish(round.cases[i], end, round.records[i]);
    progress.finished(round.cases[i], round.records[i]);
  };
  try {
    if (!serve_tasks(queue, tasks, options.engine.silence_limit, start, ended, interruption_asked))
      throw StudyInterrupted{};
  } catch (...) {
    queue.close();
    throw;
  }
}

}  // namespace

fs::path results_of(const fs::path& directory, const StudyCase& c) {
  return folder_of(directory, c) / "results";
}

void require_success(const std::vector<CaseRecord>& records) {
  if (records.empty() || std::ranges::any_of(records, &CaseRecord::succeeded)) return;
  const CaseRecord& first = records.front();
  throw sim::SimulationError(fmt::format("no case succeeded, the first one: {}{}{}",
                                         first.outcome(), first.message.empty() ? "" : ": ",
                                         first.message));
}

std::vector<CaseRecord> run_cases(const Study& study, const std::vector<StudyCase>& cases,
                                  const StudyRunOptions& options) {
  CaseRunner runner(study, options);
  for (const StudyCase& c : cases)
    if (!makes_its_own_meshes(c)) runner.check(c);
  const auto first = std::find_if(cases.begin(), cases.end(), makes_its_own_meshes);
  if (first != cases.end()) runner.check_alone(*first);
  for (const StudyCase& c : cases) runner.prepare(c);
  runner.look_at_files(cases);
  std::vector<CaseRecord> records;
  records.reserve(cases.size());
  for (const StudyCase& c : cases) records.push_back(runner.finished(c));
  std::size_t all = 0;
  for (int round = 0; round < study.repeats; ++round)
    all += tasks_of_round(cases, records, round).size();
  CaseProgress progress(all, options.quiet);
  for (int number = 0; number < study.repeats; ++number) {
    Round round{cases, tasks_of_round(cases, records, number), records};
    if (round.numbers.empty()) continue;
    if (options.engine.kind == EngineKind::Local)
      run_here(runner, std::move(round), options.jobs, progress);
    else
      run_by_engine(runner, std::move(round), options, progress);
  }
  // Workers that wait for more may go.
  if (options.engine.kind != EngineKind::Local && all > 0)
    TaskQueue(fs::absolute(options.directory) / "queue").close();
  return records;
}

}  // namespace articular::tools
