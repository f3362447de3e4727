// The version stands in CMakeLists.txt. What people write by hand has to follow it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/tools/support/program.hpp"

namespace articular::version_test {

/// What the program says: "0.2.0".
std::string version() {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(folder, "--version");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out.substr(0, result.out.find('\n'));
}

/// The groups of a pattern's first match in a file of the source tree; the whole match is group 0.
std::vector<std::string> groups_in(const std::string& file, const std::string& pattern) {
  const std::string text = content(std::filesystem::path(ARTICULAR_SOURCE_DIR) / file);
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern)))
    throw std::runtime_error(file + " has no " + pattern);
  return {match.begin(), match.end()};
}

TEST(Version, IsThatOfTheCitation) {
  EXPECT_EQ(groups_in("CITATION.cff", "\nversion: (\\S+)\n").at(1), version());
}

TEST(Version, IsTheNewestOfTheChangelogAndOfTheSameDayAsInTheCitation) {
  const std::vector<std::string> newest = groups_in("CHANGELOG.md", "\n## (\\S+) - (\\S+)\n");
  EXPECT_EQ(newest.at(1), version());
  EXPECT_EQ(newest.at(2), groups_in("CITATION.cff", "\ndate-released: (\\S+)\n").at(1));
}

TEST(Version, StandsInTheSummaryOfARun) {
  const TemporaryFolder folder;
  const std::string scenario = ARTICULAR_SOURCE_DIR "/scenarios/verification/pendulum.toml";
  const ProgramResult run =
      run_program(folder, "run '" + scenario + "' --set duration='2 ms' --quiet --out out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto summary = nlohmann::json::parse(content(folder / "out/summary.json"));
  EXPECT_EQ(summary.at("versions").at("articular"), version());
}

}  // namespace articular::version_test
