// The shipped populations, in a small form.
#include <gtest/gtest.h>

#include <regex>

#include "tests/tools/support/program.hpp"

namespace articular::populations_test {

const std::string kScenarios = ARTICULAR_SOURCE_DIR "/scenarios/";

/// A shipped population with two samples and nothing else, beside which its scenario need not lie.
std::string small_form(const std::string& folder, const std::string& name) {
  std::string text = content(kScenarios + folder + "/" + name);
  text = std::regex_replace(text, std::regex("scenario = \""),
                            "scenario = \"" + kScenarios + folder + "/");
  text = std::regex_replace(text, std::regex("samples = [0-9]+"), "samples = 2");
  return std::regex_replace(text, std::regex("(tornado|picture) = .*\n"), "");
}

void expect_two_of_two(const TemporaryFolder& folder, const ProgramResult& result) {
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string text = content(folder / "out/small/population.md");
  EXPECT_NE(text.find("2 of 2 cases succeeded"), std::string::npos) << text << result.err;
}

TEST(Populations, OfKneesRunInASmallForm) {
  const TemporaryFolder folder;
  folder.file("small.toml", small_form("knee", "axial-load-population.toml"));
  expect_two_of_two(folder, run_program(folder, "study small.toml --jobs 2"));
}

// On the nodes of Slurm where it can be started, here else.
TEST(Populations, OfJawsRunInASmallFormOnSlurm) {
  const TemporaryFolder folder;
  folder.file("small.toml", small_form("mandible", "clench-population.toml"));
  const ProgramResult result =
      run_shell(folder, "'" ARTICULAR_SOURCE_DIR
                        "/tests/tools/engine/with-slurm' \"$articular\" study small.toml --engine "
                        "slurm --jobs 2");
  if (result.exit_code == 77)
    return expect_two_of_two(folder, run_program(folder, "study small.toml --jobs 2"));
  expect_two_of_two(folder, result);
  EXPECT_NE(result.err.find("Slurm, job array"), std::string::npos) << result.err;
}

}  // namespace articular::populations_test
