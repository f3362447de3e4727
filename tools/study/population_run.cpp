#include "tools/study/population_run.hpp"

#include <fmt/format.h>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "tools/study/case_warnings.hpp"
#include "tools/study/population_page.hpp"
#include "tools/study/population_pictures.hpp"

namespace articular::tools {

namespace fs = std::filesystem;

int study_population(const Study& study, const StudyRunOptions& options) {
  const PopulationCases population = population_cases(study);
  const std::vector<CaseRecord> records = run_cases(study, population.cases, options);
  const CaseWarnings warnings = case_warnings(population.cases, records, options.directory);
  tell_warnings(warnings);
  const auto values = values_of_cases(study, population.cases, records, options.directory);
  const PopulationResult result = population_result(study, population, records, values);
  const PopulationStudy all{study, population, records, result};
  const auto write = [&](const char* name, const std::string& text) {
    const fs::path file = options.directory / name;
    sim::write_text_file(file, text);
    fmt::print("{}\n", file.string());
  };
  write("population.md", population_text(all) + warnings_table(warnings));
  write("population.csv", population_csv(all));
  try {
    write("population.html", population_page(all, draw_extremes(all, options.directory)));
  } catch (const sim::SystemError& error) {
    fmt::print(stderr, "articular: no page: {}\n", error.what());
  }
  require_success(records);
  return 0;
}

}  // namespace articular::tools
