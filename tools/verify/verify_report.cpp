#include "tools/verify/verify_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace articular::tools {
namespace {

std::string word(bool passed) { return passed ? "passed" : "FAILED"; }

std::string row(const std::string& problem, const std::string& quantity,
                const std::string& expected, const std::string& got, const std::string& deviation,
                const std::string& tolerance, const std::string& passed) {
  return fmt::format("{:<27} {:<50} {:>13} {:>13} {:>9} {:>9}  {}\n", problem, quantity, expected,
                     got, deviation, tolerance, passed);
}

std::size_t num_passed(const std::vector<Outcome>& outcomes) {
  return static_cast<std::size_t>(std::count_if(
      outcomes.begin(), outcomes.end(), [](const Outcome& outcome) { return outcome.passed(); }));
}

double seconds(const std::vector<Outcome>& outcomes) {
  double sum = 0;
  for (const Outcome& outcome : outcomes) sum += outcome.seconds;
  return sum;
}

}  // namespace

std::string table_head(const sim::Provenance& by) {
  return fmt::format("articular {}, {}, {}\nthis machine: instructions {}, OpenBLAS kernels {}\n\n",
                     by.version, by.compiler, by.flags, by.instruction_set, by.blas_kernels) +
         row("problem", "quantity", "expected", "got", "deviation", "tolerance", "");
}

std::string table_rows(const Outcome& outcome) {
  if (!outcome.error.empty())
    return fmt::format("{:<27} {}  FAILED\n", outcome.problem, outcome.error);
  if (outcome.findings.empty())
    return fmt::format("{:<27} nothing was measured  FAILED\n", outcome.problem);
  std::string rows;
  for (const Finding& f : outcome.findings)
    rows += row(outcome.problem, fmt::format("{} [{}]", f.quantity, f.unit),
                fmt::format("{:.7g}", f.expected), fmt::format("{:.7g}", f.got),
                fmt::format("{:.1e}", f.deviation()), fmt::format("{:.1e}", f.tolerance),
                word(f.passed()));
  return rows;
}

std::string table_end(const std::vector<Outcome>& outcomes) {
  std::string text = fmt::format("\n{} of {} problems passed, in {:.0f} s\n", num_passed(outcomes),
                                 outcomes.size(), seconds(outcomes));
  if (exit_code_of(outcomes) == 0) return text;
  for (const Outcome& outcome : outcomes)
    if (!outcome.passed()) text += "FAILED: " + outcome.problem + "\n";
  return text + "A wrong number here is a bug: please report it with this table.\n";
}

std::string outcomes_json(const sim::Provenance& by, const std::vector<Outcome>& outcomes) {
  using Json = nlohmann::ordered_json;  // writes what is no number as null
  Json problems = Json::array();
  for (const Outcome& outcome : outcomes) {
    Json findings = Json::array();
    for (const Finding& f : outcome.findings)
      findings.push_back({{"quantity", f.quantity},
                          {"unit", f.unit},
                          {"expected", f.expected},
                          {"got", f.got},
                          {"deviation", f.deviation()},
                          {"tolerance", f.tolerance},
                          {"passed", f.passed()}});
    problems.push_back({{"problem", outcome.problem},
                        {"passed", outcome.passed()},
                        {"seconds", outcome.seconds},
                        {"error", outcome.error.empty() ? Json(nullptr) : Json(outcome.error)},
                        {"findings", findings}});
  }
  const Json json = {{"version", by.version},
                     {"compiler", by.compiler},
                     {"flags", by.flags},
                     {"instruction_set", by.instruction_set},
                     {"blas_kernels", by.blas_kernels},
                     {"passed", exit_code_of(outcomes) == 0},
                     {"problems", problems}};
  return json.dump(2) + "\n";
}

int exit_code_of(const std::vector<Outcome>& outcomes) {
  return num_passed(outcomes) == outcomes.size() ? 0 : 1;
}

}  // namespace articular::tools
