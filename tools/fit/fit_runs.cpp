#include "tools/fit/fit_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "sim/base/error.hpp"
#include "tools/fit/fit_values.hpp"
#include "tools/fit/parameter_text.hpp"
#include "tools/study/case_warnings.hpp"

namespace articular::tools {
namespace {

/// The runs that a part needs, in order.
std::vector<std::size_t> runs_of(const Fit& fit, FitPart part) {
  std::vector<std::size_t> runs;
  for (const FitMeasurement& measurement : measurements_of(fit, part))
    runs.push_back(measurement.run);
  std::sort(runs.begin(), runs.end());
  runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
  return runs;
}

StudyCase case_of(const Fit& fit, const FitRun& run, const FitTrial& trial) {
  StudyCase c;
  c.name = fit.runs.size() == 1 ? trial.name : trial.name + ", " + run.name;
  c.settings = run.settings;
  c.settings.overrides = overrides_of(fit, run, trial.parameters);
  c.settings.overrides.emplace_back("output.frames=false");  // hundreds of runs of which rows count
  c.folder = fmt::format("{:016x}", std::hash<std::string>{}(joined(c.settings.overrides)));
  return c;
}

/// The cases of all trials. The same settings are one case.
class FitCases {
 public:
  std::size_t add(StudyCase c) {
    const auto same = std::find_if(cases_.begin(), cases_.end(), [&](const StudyCase& other) {
      return other.folder == c.folder;
    });
    if (same != cases_.end()) return static_cast<std::size_t>(same - cases_.begin());
    cases_.push_back(std::move(c));
    return cases_.size() - 1;
  }
  const std::vector<StudyCase>& all() const { return cases_; }

 private:
  std::vector<StudyCase> cases_;
};

/// What a run has to say.
struct RunResults {
  RunHistory history;
  sim::Scenario::Analysis analysis = sim::Scenario::Analysis::Dynamic;
};

RunResults read_results(const std::filesystem::path& results) {
  using Analysis = sim::Scenario::Analysis;
  const std::filesystem::path file = results / "summary.json";
  std::ifstream stream(file);
  const auto summary = nlohmann::json::parse(stream, nullptr, false);
  try {
    const bool is_static = summary.at("settings").at("analysis") == "static";
    return {read_history(results / "history.csv"),
            is_static ? Analysis::Static : Analysis::Dynamic};
  } catch (const nlohmann::json::exception&) {
    throw sim::SystemError(file.string() + ": can't be read");
  }
}

/// Why a run gave no values. What is no question of the parameters (bad input, a full disk, a bug)
/// ends the fit.
std::string failure_of(const StudyCase& c, const CaseRecord& record) {
  constexpr int kBadInput = 2, kCannotGoOn = 3;
  std::string why = fmt::format("{}: {}{}{}", c.name, record.outcome(),
                                record.message.empty() ? "" : ": ", record.message);
  const ProgramUse& use = record.runs.back();
  if (use.end == ProgramUse::End::TimeLimit) return why;
  if (use.end == ProgramUse::End::Exited && use.code == kCannotGoOn) return why;
  if (use.end == ProgramUse::End::Exited && use.code == kBadInput) throw sim::InputError(why);
  throw sim::SystemError(why);
}

}  // namespace

std::vector<FitMeasurement> measurements_of(const Fit& fit, FitPart part) {
  std::vector<FitMeasurement> measurements;
  for (const FitMeasurement& measurement : fit.measurements)
    if (part == FitPart::All || !measurement.held_out) measurements.push_back(measurement);
  return measurements;
}

std::vector<TrialValues> run_trials(const Fit& fit, const std::vector<FitTrial>& trials,
                                    FitPart part, const StudyRunOptions& options) {
  Study study;
  study.file = fit.file;
  study.scenario = fit.scenario;
  study.time_limit = fit.time_limit;
  const std::vector<std::size_t> runs = runs_of(fit, part);
  FitCases cases;
  std::vector<std::vector<std::size_t>> case_of_run(trials.size(),
                                                    std::vector<std::size_t>(fit.runs.size()));
  for (std::size_t t = 0; t < trials.size(); ++t)
    for (const std::size_t run : runs)
      case_of_run[t][run] = cases.add(case_of(fit, fit.runs[run], trials[t]));
  const std::vector<CaseRecord> records = run_cases(study, cases.all(), options);
  if (part == FitPart::All)  // what the fit begins and ends with
    tell_warnings(case_warnings(cases.all(), records, options.directory));

  const std::vector<FitMeasurement> measurements = measurements_of(fit, part);
  std::vector<TrialValues> results(trials.size());
  for (std::size_t t = 0; t < trials.size(); ++t) {
    std::vector<RunResults> of_run(fit.runs.size());
    for (const std::size_t run : runs) {
      const std::size_t c = case_of_run[t][run];
      if (!records[c].succeeded())
        results[t].failure = failure_of(cases.all()[c], records[c]);
      else
        of_run[run] = read_results(results_of(options.directory, cases.all()[c]));
    }
    if (!results[t].failure.empty()) continue;
    results[t].values.resize(static_cast<Eigen::Index>(measurements.size()));
    for (std::size_t m = 0; m < measurements.size(); ++m) {
      const RunResults& run = of_run[measurements[m].run];
      results[t].values[static_cast<Eigen::Index>(m)] =
          measured_value(measurements[m], run.history, run.analysis, fit.file.string());
    }
  }
  return results;
}

}  // namespace articular::tools
