#include "tests/benchmarks/extremes/judge.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/extremes/result_check.hpp"

namespace articular::benchmarks {
namespace {

constexpr int kBadInput = 2, kCannotGoOn = 3;

nlohmann::json summary_of(const ProgramRun& run) {
  std::ifstream in(run.results / "summary.json");
  return nlohmann::json::parse(in);
}

}  // namespace

std::optional<Finding> ended_early(const ProgramRun& run) {
  const auto failed = [](std::string why) { return Finding{Outcome::Failed, std::move(why)}; };
  if (run.timed_out)
    return failed(fmt::format("not done after {:.0f} s of wall time", run.seconds));
  if (run.exit_code != 0 && run.exit_code != kBadInput && run.exit_code != kCannotGoOn)
    return failed(fmt::format("exit code {}: {}", run.exit_code, run.message));
  if (run.exit_code != kBadInput)
    if (const std::string broken = what_is_invalid(run.results); !broken.empty())
      return failed(broken);
  if (run.exit_code == 0) return std::nullopt;
  if (run.message.find('`') == std::string::npos)
    return failed("the message names no body: " + run.message);
  return Finding{Outcome::Refused, run.message};
}

std::string warnings_of(const ProgramRun& run) {
  const nlohmann::json summary = summary_of(run);
  const std::string file = summary.at("scenario").get<std::string>() + ":";
  std::string all;
  for (const char* kind : {"warnings", "notes"})
    for (const auto& item : summary.at(kind))
      if (const std::string told = item; told.find(file) == std::string::npos)
        all += (all.empty() ? "" : "; ") + told;
  return all;
}

Finding judged(const ProgramRun& run, double error, const Bound& bound, const std::string& what) {
  const std::string measured = fmt::format("{}: {:.2g} (bound {:.2g})", what, error, bound.right);
  if (error <= bound.right) return {Outcome::Right, measured};
  const std::string warnings = warnings_of(run);
  const bool is_static = summary_of(run).at("settings").at("analysis") == "static";
  if (!(is_static ? std::isfinite(error) : error <= bound.stable))
    return {Outcome::Failed, fmt::format("{}, beyond {:.2g}; {}", measured, bound.stable,
                                         warnings.empty() ? "no warning" : warnings)};
  if (warnings.empty()) return {Outcome::Failed, measured + ", and no warning"};
  return {Outcome::Degraded, measured + "; " + warnings};
}

}  // namespace articular::benchmarks
