// The table of `articular verify`: what it takes for right and for wrong, and what it leaves
// behind.
#include "tools/verify/verify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "tests/tools/support/program.hpp"
#include "tools/verify/problems.hpp"
#include "tools/verify/scene.hpp"
#include "tools/verify/verify_report.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

Problem made_up(const std::string& name, const Finding& finding) {
  return {name, true, [finding](const Laboratory&) { return std::vector<Finding>{finding}; }};
}

const Problem kRight = made_up("made-up/right", relative("force", "N", 2, 2.01, 0.01));
const Problem kWrong = made_up("made-up/wrong", relative("force", "N", 2, 2.03, 0.01));

Outcome outcome_of(const Problem& problem) { return verify({problem}, {}).front(); }

TEST(Verify, AFindingPassesUpToItsToleranceOnBothSides) {
  EXPECT_TRUE(relative("", "", 2, 2.0199, 0.01).passed());
  EXPECT_TRUE(relative("", "", 2, 1.9801, 0.01).passed());
  EXPECT_FALSE(relative("", "", 2, 2.0201, 0.01).passed());
  EXPECT_FALSE(relative("", "", 2, 1.9799, 0.01).passed());
  EXPECT_FALSE(relative("", "", -2, 2, 0.01).passed());  // the sign counts
  EXPECT_TRUE(vanishing("", "", 0, 1, 0).passed());
  EXPECT_TRUE(vanishing("", "", -0.9e-3, 10, 1e-4).passed());
  EXPECT_FALSE(vanishing("", "", -1.1e-3, 10, 1e-4).passed());
}

TEST(Verify, WhatIsNoNumberFails) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(relative("", "", 2, missing, 1).passed());
  EXPECT_FALSE(vanishing("", "", missing, 1, 1).passed());
  EXPECT_FALSE(relative("", "", 2, std::numeric_limits<double>::infinity(), 1).passed());
}

TEST(Verify, OneWrongNumberGivesTheExitCodeOfABug) {
  EXPECT_EQ(exit_code_of(verify({kRight, kRight}, {})), 0);
  EXPECT_EQ(exit_code_of(verify({kRight, kWrong, kRight}, {})), 1);
}

TEST(Verify, AProblemThatCannotBeSolvedOrMeasuresNothingFails) {
  const Problem stopped{"made-up/stopped", true, [](const Laboratory&) -> std::vector<Finding> {
                          throw sim::SimulationError("no step size makes it");
                        }};
  const Problem empty{"made-up/empty", true,
                      [](const Laboratory&) { return std::vector<Finding>(); }};
  for (const Problem& problem : {stopped, empty}) {
    const Outcome outcome = outcome_of(problem);
    EXPECT_FALSE(outcome.passed());
    EXPECT_NE(table_rows(outcome).find("FAILED"), std::string::npos);
  }
  EXPECT_EQ(exit_code_of(verify({stopped, kRight}, {})), 1);
  EXPECT_NE(table_rows(outcome_of(stopped)).find("no step size makes it"), std::string::npos);
}

TEST(Verify, ASystemThatFailsIsNoWrongResult) {
  const Problem full{"made-up/full", true, [](const Laboratory&) -> std::vector<Finding> {
                       throw sim::SystemError("disk full");
                     }};
  EXPECT_THROW(verify({full}, {}), sim::SystemError);
}

TEST(Verify, TheTableSaysOfEachNumberWhatWasExpectedAndWhatCame) {
  const std::string right = table_rows(outcome_of(kRight)), wrong = table_rows(outcome_of(kWrong));
  for (const std::string text :
       {"made-up/right", "force [N]", " 2 ", "2.01", "5.0e-03", "1.0e-02", "passed"})
    EXPECT_NE(right.find(text), std::string::npos) << text << "\n" << right;
  EXPECT_EQ(right.find("FAILED"), std::string::npos);
  EXPECT_NE(wrong.find("1.5e-02"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("FAILED"), std::string::npos);
  const std::string head = table_head(sim::provenance());
  for (const std::string& text :
       {sim::provenance().version, sim::provenance().compiler, sim::provenance().instruction_set,
        sim::provenance().blas_kernels})
    EXPECT_NE(head.find(text), std::string::npos) << text << "\n" << head;
  const std::string end = table_end(verify({kRight, kWrong}, {}));
  EXPECT_NE(end.find("1 of 2 problems passed"), std::string::npos) << end;
  EXPECT_NE(end.find("FAILED: made-up/wrong"), std::string::npos) << end;
}

TEST(Verify, JsonHasTheSameAndNullWhereANumberIsMissing) {
  const Problem missing = made_up("made-up/missing", relative("force", "N", 2, std::nan(""), 0.01));
  const auto json =
      nlohmann::json::parse(outcomes_json(sim::provenance(), verify({kRight, missing}, {})));
  EXPECT_EQ(json.at("passed"), false);
  ASSERT_EQ(json.at("problems").size(), 2U);
  const auto& right = json.at("problems")[0].at("findings")[0];
  EXPECT_EQ(right.at("expected"), 2);
  EXPECT_EQ(right.at("got"), 2.01);
  EXPECT_EQ(right.at("tolerance"), 0.01);
  EXPECT_EQ(right.at("passed"), true);
  EXPECT_TRUE(json.at("problems")[1].at("findings")[0].at("got").is_null());
}

TEST(Verify, NamesAreUniqueAndEachGroupHasAProblem) {
  std::set<std::string> names, groups;
  for (const Problem& problem : all_problems()) {
    EXPECT_TRUE(names.insert(problem.name).second) << problem.name;
    groups.insert(problem.name.substr(0, problem.name.find('/')));
  }
  EXPECT_EQ(groups,
            (std::set<std::string>{"law", "patch", "cantilever", "twist", "hertz", "friction",
                                   "period", "momentum", "line", "resume", "threads"}));
}

TEST(Verify, ProblemsAreChosenByAPartOfTheirNames) {
  const std::vector<Problem> problems = {
      {"law/a", true, {}}, {"law/b", false, {}}, {"twist/c", true, {}}};
  EXPECT_EQ(chosen(problems, "", false).size(), 3U);
  EXPECT_EQ(chosen(problems, "law", false).size(), 2U);
  EXPECT_EQ(chosen(problems, "law", true).size(), 1U);
  EXPECT_EQ(chosen(problems, "l*/[bc]", false).size(), 1U);
  try {
    chosen(problems, "twits", false);
    FAIL() << "nothing was chosen, and nothing said";
  } catch (const sim::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("law/a, law/b, twist/c"), std::string::npos)
        << error.what();
  }
}

TEST(Verify, AFolderIsGoneAfterItsProblemHoweverItEnds) {
  fs::path folder;
  const auto writes_and = [&](const std::function<void()>& ends) {
    return Problem{"made-up/folder", true, [&folder, ends](const Laboratory& laboratory) {
                     folder = laboratory.folder;
                     fs::create_directories(folder / "results");
                     EXPECT_TRUE(fs::is_directory(folder));
                     ends();
                     return std::vector<Finding>();
                   }};
  };
  verify({writes_and([] {})}, {});
  EXPECT_FALSE(fs::exists(folder));
  verify({writes_and([] { throw std::runtime_error("broken"); })}, {});
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_THROW(verify({writes_and([] { throw sim::Interruption(); })}, {}), sim::Interruption);
  EXPECT_FALSE(fs::exists(folder));
}

// Within a run, not only between problems.
TEST(Verify, AnInterruptionEndsARunThatIsUnderWay) {
  int asked = 0;
  VerifyWatch watch;
  watch.is_to_stop = [&] { return ++asked > 20; };
  std::size_t solved = 0;
  watch.after = [&](const Outcome&) { ++solved; };
  EXPECT_THROW(verify(chosen(all_problems(), "pendulum", false), watch), sim::Interruption);
  EXPECT_EQ(solved, 0U);
  EXPECT_LT(asked, 40);
}

TEST(Verify, EmbeddedScenariosAreTheShippedOnes) {
  EXPECT_EQ(embedded_scenario("incline"),
            content(fs::path(ARTICULAR_SOURCE_DIR) / "scenarios/verification/incline.toml"));
  EXPECT_THROW(embedded_scenario("decline"), std::invalid_argument);
}

// --- the program

/// Its temporary files in a folder of the test, with none of the sources beside it.
ProgramResult verify_in(const TemporaryFolder& folder, const std::string& arguments) {
  return run_shell(folder, "mkdir -p tmp; TMPDIR=$PWD/tmp \"$articular\" verify " + arguments);
}

TEST(VerifyProgram, AQuickPartPassesAndLeavesNothing) {
  const TemporaryFolder folder;
  const ProgramResult result = verify_in(folder, "--only law/ --json");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("passed"), true);
  EXPECT_GE(json.at("problems").size(), 6U);
  for (const auto& problem : json.at("problems")) EXPECT_EQ(problem.at("passed"), true) << problem;
  EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST(VerifyProgram, TellsItsProgressOnStderrAndItsTableOnStdout) {
  const TemporaryFolder folder;
  const ProgramResult result = verify_in(folder, "--only line/");
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_NE(result.err.find("2 of 3: line/ligament"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("3 of 3 problems passed"), std::string::npos) << result.out;
  EXPECT_EQ(verify_in(folder, "--only line/ligament --quiet").err, "");
}

TEST(VerifyProgram, AnUnknownNameIsBadInputAndAFolderThatIsNoneTheSystems) {
  const TemporaryFolder folder;
  const ProgramResult unknown = verify_in(folder, "--only cantilevre");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("cantilever/plain"), std::string::npos) << unknown.err;
  const ProgramResult nowhere =
      run_shell(folder, "TMPDIR=$PWD/missing \"$articular\" verify --only line");
  EXPECT_EQ(nowhere.exit_code, 4);
  EXPECT_NE(nowhere.err.find("TMPDIR"), std::string::npos) << nowhere.err;
}

// In the middle of a run that takes some seconds.
TEST(VerifyProgram, InterruptedItLeavesNothing) {
  const TemporaryFolder folder;
  const ProgramResult result = run_shell(
      folder,
      "mkdir tmp; TMPDIR=$PWD/tmp \"$articular\" verify --only hertz & pid=$!; "
      "while [ -z \"$(find tmp -name history.csv)\" ] && kill -0 $pid; do sleep 0.02; done; "
      "kill -TERM $pid; wait $pid");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

}  // namespace
}  // namespace articular::tools
