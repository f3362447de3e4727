// Scenarios that come with the program, by name. ARTICULAR_SCENARIOS names their folder here.
#include "tools/shipped/shipped_scenarios.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/tools/support/program.hpp"

namespace articular::shipped_test {

const std::string kScene = R"(
title = "A block"
duration = "2 ms"
[[body]]
name = "block"
kind = "rigid"
density = "1 g/cm^3"
mesh = { file = "parts/block.stl" }
)";
const std::string kBlock = R"(solid block
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 4 0 vertex 4 0 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 4 0 0 vertex 0 0 4 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 4 vertex 0 4 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 4 0 0 vertex 0 4 0 vertex 0 0 4 endloop endfacet
endsolid block
)";

class Shipped : public ::testing::Test {
 protected:
  Shipped() {
    for (const char* made : {"shipped/jaw/parts", "work"})
      std::filesystem::create_directories(folder_ / made);
    folder_.file("shipped/jaw/block.toml", kScene);
    folder_.file("shipped/jaw/parts/block.stl", kBlock);
    folder_.file("shipped/jaw/block-study.toml",
                 "scenario = \"block.toml\"\n[[output]]\ncolumn = \"x\"\nexact = 1\n");
    folder_.file("shipped/jaw/notes.toml", "author = \"none\"\n");
  }

  /// In the folder work.
  ProgramResult program(const std::string& arguments) const {
    return run_shell(folder_,
                     "cd work; export ARTICULAR_SCENARIOS=../shipped; \"$articular\" " + arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(Shipped, AreListedWithNameKindAndTitle) {
  const ProgramResult result = program("scenarios");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "jaw/block        dynamic     A block\n"
            "jaw/block-study  study       jaw/block-study\n");
}

TEST_F(Shipped, RunByNameIntoTheWorkingFolderAndReadFilesBesideThem) {
  const ProgramResult result = program("run jaw/block --quiet");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "work/out/block/summary.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "shipped/jaw/out"));
}

TEST_F(Shipped, AreTakenByEveryCommandThatTakesAScenario) {
  for (const char* command :
       {"check jaw/block", "explain jaw/block --no-costs", "scenarios jaw/block"}) {
    const ProgramResult result = program(command);
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  }
  const ProgramResult study = program("study jaw/block-study --quiet");
  EXPECT_NE(study.err.find("history.csv has no column `x`"), std::string::npos) << study.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "work/out/block-study"));
}

TEST_F(Shipped, AFileOfThatPathWins) {
  std::filesystem::create_directories(folder_ / "work/jaw");
  folder_.file("work/jaw/block", "duration = 5\n");
  const ProgramResult result = program("check jaw/block");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("jaw/block:1:12: `duration`"), std::string::npos) << result.err;
}

TEST_F(Shipped, AnUnknownNameGetsTheNearest) {
  for (const char* written : {"jaw/blok", "block", "scenarios/jaw/block.toml", "jaw/block.toml"}) {
    const ProgramResult result = program(std::string("run ") + written);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, std::string("articular: ") + written +
                              ": no such file, and no scenario of this name is shipped; did you "
                              "mean `jaw/block`?\n");
  }
  EXPECT_NE(program("run elbow").err.find("`articular scenarios` lists those that are"),
            std::string::npos);
}

TEST_F(Shipped, AMisspeltFileGetsTheOneBesideIt) {
  std::filesystem::create_directories(folder_ / "work/own");
  folder_.file("work/own/bar.toml", kScene);
  EXPECT_EQ(program("run own/bar.tml").err,
            "articular: own/bar.tml: no such file; did you mean `own/bar.toml`?\n");
}

TEST_F(Shipped, ANameNeverLeavesTheirFolder) {
  folder_.file("secret.toml", kScene);
  EXPECT_EQ(program("check ../secret").exit_code, 2);
}

TEST_F(Shipped, AMissingFolderIsNamed) {
  const ProgramResult result =
      run_shell(folder_, "ARTICULAR_SCENARIOS=nowhere \"$articular\" scenarios");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "articular: expected the shipped scenarios in `nowhere`, found no such folder; the "
            "environment variable ARTICULAR_SCENARIOS can name another\n");
}

TEST_F(Shipped, AnInstalledProgramHasThemInShareOrElseInTheSourceTree) {
  std::filesystem::create_directories(folder_ / "usr/bin");
  std::filesystem::create_directories(folder_ / "usr/share/articular");
  const std::string installed = "unset ARTICULAR_SCENARIOS; cp \"$articular\" usr/bin/articular; ";
  EXPECT_NE(
      run_shell(folder_, installed + "usr/bin/articular scenarios").out.find("mandible/opening"),
      std::string::npos);
  const ProgramResult result =
      run_shell(folder_,
                "mv shipped usr/share/articular/scenarios; ln -s usr/bin/articular linked; "
                "unset ARTICULAR_SCENARIOS; ./linked scenarios");
  EXPECT_NE(result.out.find("jaw/block "), std::string::npos) << result.err;
  EXPECT_EQ(result.out.find("mandible/opening"), std::string::npos);
}

TEST_F(Shipped, AFileThatAnotherSubcommandTakesIsToldWithIt) {
  folder_.file("shipped/jaw/many.toml", "scenario = \"block.toml\"\npopulation = {}\n");
  folder_.file("shipped/jaw/width.toml", "scenario = \"block.toml\"\n[[parameter]]\n");
  for (const auto& [arguments, message] :
       {std::pair("run jaw/block-study", "expected a scenario, found a study; `articular study"),
        {"report jaw/many", "expected a scenario, found a population; `articular study"},
        {"render jaw/width", "expected a scenario, found a fit; `articular fit"},
        {"fit jaw/many", "expected a fit, found a population; `articular study"},
        {"study jaw/block", "expected a study, found a scenario; `articular run"}}) {
    const ProgramResult result = program(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  }
}

TEST_F(Shipped, AMeshInPlaceOfAScenarioIsNamedWithWhatNamesIt) {
  folder_.file("work/bone.stl", kBlock);
  folder_.file("work/knee.feb", "<febio_spec/>");
  const ProgramResult mesh = run_program(folder_, "run work/bone.stl");
  EXPECT_EQ(mesh.exit_code, 2);
  EXPECT_EQ(mesh.err,
            "articular: work/bone.stl: expected a scenario (.toml), found a mesh; a [[body]] of a "
            "scenario names it: mesh = { file = \"bone.stl\" }\n");
  const ProgramResult model = run_program(folder_, "check work/knee.feb");
  EXPECT_EQ(model.exit_code, 2);
  EXPECT_NE(model.err.find("`articular import` makes one of a FEBio model"), std::string::npos)
      << model.err;
}

}  // namespace articular::shipped_test
