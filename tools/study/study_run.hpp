#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/engine/workers.hpp"
#include "tools/process/measured_program.hpp"
#include "tools/study/study_cases.hpp"
#include "tools/study/study_prepare.hpp"

/// Runs the cases of a study, in processes of their own, and keeps what each of them took.
namespace articular::tools {

/// How one case went.
struct CaseRecord {
  std::vector<ProgramUse> runs;  // one a repeat; the last one's results are in the folder
  std::string message;           // first line of the error, "" when there was none

  bool succeeded() const;
  std::string outcome() const;  // "done", "bad input", "stopped", "time limit", ...
  double wall() const;          // median over the runs [s]
  double cpu() const;
  double memory() const;  // largest [MB]
};

/// @throws sim::SimulationError  where no case succeeded
void require_success(const std::vector<CaseRecord>& records);

struct StudyRunOptions {
  std::filesystem::path directory;
  int jobs = 1;
  bool fresh = false;  // run again what is there
  bool quiet = false;
  EngineOptions engine = {};
};

/// The folder with the results of a case.
std::filesystem::path results_of(const std::filesystem::path& directory, const StudyCase& c);

/// Runs each case as often as the study says, round by round, so that a slow quarter of an hour of
/// the machine falls on all of them. What an earlier call finished is kept if scenario, arguments,
/// program and all files that the scenario names are the same.
/// With an engine but the local one cases wait in DIR/queue for workers, see tools/engine. One that
/// is lost there is not kept, so that the next call runs it again.
/// @return one record a case; fewer runs than asked for after a failure
/// @throws StudyInterrupted  what is finished stays
/// @throws sim::InputError   when a case is no valid scenario, before any runs, or when the first
///                           one's results lack an output
std::vector<CaseRecord> run_cases(const Study& study, const std::vector<StudyCase>& cases,
                                  const StudyRunOptions& options);

}  // namespace articular::tools
