// What `cmake --install` puts somewhere, used from there.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/support/program.hpp"

namespace articular::installed_test {

/// The program as installed, in a folder to which it was moved afterwards: nothing may remember
/// where it was built or put first.
class Installed : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    const ProgramResult result =
        run_shell(*folder, "for component in program mesher; do '" ARTICULAR_CMAKE
                           "' --install '" ARTICULAR_BUILD_DIR
                           "' --component $component --prefix first; done && mv first prefix");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  static void TearDownTestSuite() { folder.reset(); }

  static ProgramResult run_installed(const std::string& arguments) {
    return run_shell(*folder, "prefix/bin/articular " + arguments);
  }

  static std::unique_ptr<TemporaryFolder> folder;
};

std::unique_ptr<TemporaryFolder> Installed::folder;

TEST_F(Installed, RunsAShippedScenario) {
  const ProgramResult run = run_installed(
      "run prefix/share/articular/scenarios/v-shapes/two.toml --set duration='2 ms' --quiet");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(*folder / "out/two/two.pvd"));
}

TEST_F(Installed, MakesTheReportOfARun) {
  const ProgramResult report = run_installed(
      "run verification/hanging_beam --out out/beam --quiet && prefix/bin/articular "
      "report out/beam");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_TRUE(std::filesystem::exists(*folder / "out/beam/report.html"));
}

/// The values of `file = "..."` in a scenario, but for those that lie in a folder of the user.
std::vector<std::filesystem::path> shipped_files(const std::filesystem::path& scenario) {
  const std::string text = content(scenario);
  const std::regex pattern("\\bfile = \"([^$\"]*)\"");
  std::vector<std::filesystem::path> files;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    if (!match->str(1).starts_with("../../out/"))  // what a script makes of a user's meshes
      files.push_back(scenario.parent_path() / match->str(1));
  return files;
}

TEST_F(Installed, HasTheFilesThatItsScenariosName) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           *folder / "prefix/share/articular/scenarios")) {
    if (entry.path().extension() != ".toml") continue;
    for (const std::filesystem::path& file : shipped_files(entry.path())) {
      EXPECT_TRUE(std::filesystem::exists(file)) << entry.path() << " names " << file;
      ++count;
    }
  }
  EXPECT_GT(count, 20);
}

// Links to what is no page, as to a scenario, would lead out of the documentation.
TEST_F(Installed, HasAllPagesThatItsPagesNameInLinks) {
  const std::filesystem::path documents = *folder / "prefix/share/doc/articular";
  const std::regex link("\\]\\(([^)#\\s]+)(#[^)\\s]*)?\\)");
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(documents)) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = content(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match) {
      if (match->str(1).find("://") != std::string::npos) continue;
      ++count;
      EXPECT_TRUE(std::filesystem::exists(entry.path().parent_path() / match->str(1)))
          << entry.path() << ": " << match->str(1);
    }
  }
  EXPECT_GT(count, 100);
}

TEST_F(Installed, FindsItsMesher) {
  if (!std::filesystem::exists(*folder / "prefix/libexec/articular/articular-mesher"))
    GTEST_SKIP() << "this build has no mesher";
  folder->file("octahedron.obj",
               "v 9 0 0\nv -9 0 0\nv 0 9 0\nv 0 -9 0\nv 0 0 9\nv 0 0 -9\n"
               "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
  const ProgramResult mesh = run_installed("mesh octahedron.obj --size '4 mm' --out tissue.vtu");
  EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
  EXPECT_TRUE(std::filesystem::exists(*folder / "tissue.vtu"));
}

TEST_F(Installed, HasManualPageAndCompletionsWhereTheyAreLookedFor) {
  EXPECT_EQ(run_shell(*folder, "gzip -dc prefix/share/man/man1/articular.1.gz").out,
            run_installed("manual man").out);
  for (const auto& [file, format] : {std::pair{"bash-completion/completions/articular", "bash"},
                                     std::pair{"zsh/vendor-completions/_articular", "zsh"},
                                     std::pair{"fish/vendor_completions.d/articular.fish", "fish"}})
    EXPECT_EQ(content(*folder / (std::string("prefix/share/") + file)),
              run_installed(std::string("manual ") + format).out)
        << file;
}

TEST_F(Installed, HasNoTestsAndNoSanitizedTwins) {
  const ProgramResult list = run_shell(*folder, "cd prefix && find bin libexec -type f | sort");
  EXPECT_TRUE(list.out == "bin/articular\n" ||
              list.out == "bin/articular\nlibexec/articular/articular-mesher\n")
      << list.out;
}

}  // namespace articular::installed_test
