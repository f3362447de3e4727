#include "tools/study/population_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tools/process/interruption.hpp"
#include "tools/process/this_program.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSize = "900x600";  // small enough for a page with dozens of them

std::set<std::size_t> extremes(const PopulationResult& result) {
  std::set<std::size_t> cases;
  for (const PopulationOutput& output : result.outputs)
    for (const auto& extreme : {output.least, output.largest})
      if (extreme) cases.insert(*extreme);
  return cases;
}

}  // namespace

std::map<std::size_t, fs::path> draw_extremes(const PopulationStudy& all,
                                              const fs::path& directory) {
  std::map<std::size_t, fs::path> drawn;
  const std::vector<std::string>& asked = all.study.population->picture;
  if (asked.empty()) return drawn;
  for (const std::size_t i : extremes(all.result)) {
    const StudyCase& c = all.population.cases[i];
    const fs::path folder = directory / "pictures" / c.folder;
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    fs::create_directories(folder);
    // In `render`, as where pictures_of() looks for those of a run.
    std::vector<std::string> command{this_program().string(), "render",
                                     results_of(directory, c).string(), "--out",
                                     (folder / "render").string()};
    if (std::find(asked.begin(), asked.end(), "--size") == asked.end())
      command.insert(command.end(), {"--size", kSize});
    command.insert(command.end(), asked.begin(), asked.end());
    const fs::path log = folder / "log";
    const ProgramUse use = run_measured(command, {}, log, {}, interruption_asked);
    if (interruption_asked()) throw StudyInterrupted{};
    if (use.end == ProgramUse::End::Exited && use.code == 0)
      drawn[i] = folder;
    else
      fmt::print(stderr, "articular: no picture of `{}`: {}\n", c.name, first_error(log));
  }
  return drawn;
}

}  // namespace articular::tools
