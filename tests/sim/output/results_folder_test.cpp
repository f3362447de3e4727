#include "sim/output/results_folder.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::results_folder_test {

namespace fs = std::filesystem;

std::string refusal(const fs::path& folder, const fs::path& scenario) {
  try {
    clear_results(folder, scenario, false);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// As a run of knee.toml leaves it, with a file of somebody else's everywhere.
class Results : public ::testing::Test {
 protected:
  Results() {
    fs::create_directories(folder_ / "frames");
    fs::create_directories(folder_ / "checkpoint");
    for (const std::string& name : kWritten) folder_.file(name, "");
    folder_.file("summary.json", R"({"scenario": "knee.toml"})");
    for (const std::string& name : kForeign) folder_.file(name, "mine");
  }
  void expect_cleared() const {
    for (const std::string& name : kWritten) EXPECT_FALSE(fs::exists(folder_ / name)) << name;
    EXPECT_NE(content(folder_ / "summary.json").find("\"unfinished\""), std::string::npos);
    expect_foreign();
  }
  void expect_foreign() const {
    for (const std::string& name : kForeign) EXPECT_EQ(content(folder_ / name), "mine") << name;
  }

  const std::vector<std::string> kWritten = {"history.csv",
                                             "convergence.csv",
                                             "knee.pvd",
                                             "frames/disc_000000.vtu",
                                             "frames/disc_contact_000012.vtp",
                                             "frames/lines_1000000.vtp",
                                             "frames/disc_000001.vtu.part",
                                             "checkpoint/state.bin",
                                             "checkpoint/previous.bin"};
  const std::vector<std::string> kForeign = {"notes.txt",          "view.pvd",
                                             "history_old.csv",    "frames/picture.png",
                                             "frames/best_v2.vtu", "checkpoint/README"};
  TemporaryFolder folder_;
};

TEST_F(Results, OfTheSameScenarioAreReplacedAndNothingElse) {
  clear_results(folder_.path(), "knee.toml", false);
  expect_cleared();
}

TEST_F(Results, OfAnotherScenarioAreReplacedOnlyWhenAskedFor) {
  EXPECT_NE(refusal(folder_.path(), "jaw.toml").find("holds results of knee.toml"),
            std::string::npos);
  for (const std::string& name : kWritten) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  clear_results(folder_.path(), "jaw.toml", true);
  expect_cleared();
}

TEST_F(Results, OfAScenarioOfThatNameInAnotherFolderAreThoseOfAnotherOne) {
  const fs::path here = folder_ / "here/knee.toml", there = folder_ / "there/knee.toml";
  for (const fs::path& scenario : {here, there}) fs::create_directories(scenario.parent_path());
  write_unfinished_summary(folder_.path(), here);
  EXPECT_EQ(refusal(folder_.path(), folder_ / "there/../here/knee.toml"), "");
  EXPECT_NE(
      refusal(folder_.path(), there)
          .find("holds results of knee.toml in " + folder_of(here) + "; choose another --out"),
      std::string::npos);
  clear_results(folder_.path(), there, true);
  EXPECT_EQ(refusal(folder_.path(), there), "");
}

TEST_F(Results, WithoutASummaryAreKnownByTheirSeries) {
  fs::remove(folder_ / "summary.json");
  fs::remove(folder_ / "view.pvd");
  EXPECT_EQ(refusal(folder_.path(), "knee.toml"), "");
  fs::remove(folder_ / "summary.json");
  folder_.file("knee.pvd", "");
  EXPECT_NE(refusal(folder_.path(), "jaw.toml"), "");
  fs::remove(folder_ / "knee.pvd");
  folder_.file("history.csv", "somebody's");
  EXPECT_NE(refusal(folder_.path(), "knee.toml").find("an unknown scenario"), std::string::npos);
  EXPECT_EQ(content(folder_ / "history.csv"), "somebody's");
}

TEST_F(Results, ThatAreSymbolicLinksAreRefusedAndNothingIsRemoved) {
  folder_.file("target", "mine");
  for (const std::string name : {"history.csv", "knee.pvd", "frames/disc_000000.vtu"}) {
    fs::remove(folder_ / name);
    fs::create_symlink(folder_ / "target", folder_ / name);
    EXPECT_NE(refusal(folder_.path(), "knee.toml").find(name + ": is a symbolic link"),
              std::string::npos);
    EXPECT_TRUE(fs::exists(folder_ / "summary.json"));
    fs::remove(folder_ / name);
  }
  EXPECT_EQ(content(folder_ / "target"), "mine");
}

TEST(ResultsFolder, IsMadeAndBelongsToOneRunAtATime) {
  const TemporaryFolder folder;
  {
    const ResultsFolder first(folder / "a/b");
    EXPECT_TRUE(fs::is_directory(folder / "a/b"));
    try {
      const ResultsFolder second(folder / "a/b");
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("a/b: another run"), std::string::npos);
    }
    const ResultsFolder elsewhere(folder / "a/c");
  }
  const ResultsFolder later(folder / "a/b");
}

TEST(ResultsFolder, ThatIsAFileIsASystemErrorThatNamesIt) {
  const TemporaryFolder folder;
  const auto file = folder.file("plain", "text");
  EXPECT_THROW(ResultsFolder{file}, SystemError);
  EXPECT_THROW(ResultsFolder{file / "below"}, SystemError);
}

}  // namespace articular::sim::results_folder_test
