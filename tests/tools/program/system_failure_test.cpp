// What the system does to the program: streams that are closed or full, files that may not grow, a
// folder that vanishes, signals. Results are whole or can be resumed, and one line says what is
// wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/tools/support/program.hpp"

namespace articular::system_failure_test {

const std::string kScene = R"(
duration = "0.4 ms"
[output]
interval = "0.1 ms"
checkpoint_interval = "0.2 ms"
[integrator]
step = "0.05 ms"
[[body]]
name = "disc"
kind = "tissue"
density = "1 g/cm^3"
velocity = "1 0 0 m/s"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.3, element = "plain" }
geometry = { box = { size = "4 4 4 mm", cells = [2, 2, 2] } }
[[probe]]
name = "disc"
kind = "energy"
)";

void expect_one_line(const ProgramResult& result, const std::string& words) {
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
}

class SystemFailure : public ::testing::Test {
 protected:
  SystemFailure() { folder_.file("scene.toml", kScene); }

  std::string outcome() const {
    std::string summary = content(folder_ / "out/summary.json");
    for (std::string word : {"unfinished", "interrupted", "finished"})
      if (summary.find('"' + word + '"') != std::string::npos) return word;
    return summary;
  }

  const TemporaryFolder folder_;
};

TEST_F(SystemFailure, TextThatCannotBePrintedIsToldAndResultsAreWhole) {
  for (const std::string to : {"> /dev/full", ">&-"}) {
    expect_one_line(run_program(folder_, "run scene.toml --quiet --out out " + to),
                    "standard output can't be written");
    EXPECT_EQ(outcome(), "finished");
    for (const std::string what : {"check scene.toml ", "explain scene.toml ", "--help "})
      expect_one_line(run_program(folder_, what + to), "standard output can't be written");
  }
}

// Its number would be that of the next file, into which messages would go.
TEST_F(SystemFailure, AClosedStreamIsNotTakenForAFileOfResults) {
  run_program(folder_, "run scene.toml --quiet --out out");
  const std::string history = content(folder_ / "out/history.csv");
  for (const std::string closed : {"2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(run_program(folder_, "run scene.toml --out out " + closed).exit_code, 4) << closed;
    EXPECT_EQ(content(folder_ / "out/history.csv").rfind("time [s]", 0), 0U) << closed;
    EXPECT_EQ(run_program(folder_, "run scene.toml --resume --quiet --out out").exit_code, 0);
    EXPECT_EQ(content(folder_ / "out/history.csv"), history) << closed;
  }
  EXPECT_EQ(run_program(folder_, "check scene.toml 2>&-").exit_code, 0);  // it has said all
}

TEST_F(SystemFailure, AFileThatMayNotGrowIsASystemErrorAndResumed) {
  run_program(folder_, "run scene.toml --quiet --out whole");
  // In blocks of 512 bytes: nothing; neither a summary nor a frame; no frame.
  for (const std::string blocks : {"0", "3", "7"}) {
    // Through a pipe: the messages' own file may not grow either.
    expect_one_line(
        run_shell(folder_, "rm -rf out; words=$(ulimit -f " + blocks +
                               "; \"$articular\" run scene.toml --quiet --out out 2>&1); "
                               "code=$?; echo \"$words\" >&2; exit $code"),
        "File too large");
    EXPECT_NE(outcome(), "finished") << blocks;
    EXPECT_EQ(run_program(folder_, "run scene.toml --resume --quiet --out out").exit_code, 0);
    EXPECT_EQ(content(folder_ / "out/history.csv"), content(folder_ / "whole/history.csv"));
  }
}

/// Runs a long one, does something as soon as there is a frame, and waits for the end.
ProgramResult run_and(const TemporaryFolder& folder, const std::string& deed) {
  return run_shell(
      folder,
      "rm -rf out; \"$articular\" run scene.toml --set duration='10 s' "
      "--set output.interval='1 ms' --quiet --out out & "
      "pid=$!; "
      "while [ ! -f out/frames/disc_000001.vtu ] && kill -0 $pid; do sleep 0.02; done; " +
          deed + "; wait $pid");
}

TEST_F(SystemFailure, AFolderThatVanishesEndsTheRun) {
  expect_one_line(run_and(folder_, "mv out gone"), "articular: out/");  // what is missed first
  EXPECT_EQ(run_program(folder_, "run scene.toml --resume --quiet --out out").exit_code, 0);
}

TEST_F(SystemFailure, AClosedTerminalEndsTheRunInGoodOrder) {
  for (const std::string signal : {"HUP", "TERM", "INT"}) {
    const ProgramResult result = run_and(folder_, "kill -" + signal + " $pid");
    EXPECT_EQ(result.exit_code, 130) << signal;
    EXPECT_EQ(outcome(), "interrupted") << signal;
  }
  EXPECT_EQ(run_shell(folder_,
                      "rm -rf out; trap '' HUP; \"$articular\" run scene.toml --quiet "
                      "--out out & kill -HUP $!; wait $!")
                .exit_code,
            0);
}

// As it reads and builds, which takes a minute for so many elements. It is sent the signal once
// that is one which it catches.
TEST_F(SystemFailure, WhatHasWrittenNothingEndsAtOnce) {
  for (const std::string command : {"check ", "run --out new "}) {
    const ProgramResult result = run_shell(
        folder_, "\"$articular\" " + command +
                     "scene.toml --set body.disc.geometry.box.cells='[60, 60, 60]' & pid=$!; "
                     "until grep -q '^SigCgt:.*[4-7c-f]...$' /proc/$pid/status; do sleep 0.02; "
                     "kill -0 $pid || break; done; sleep 0.2; kill -TERM $pid; wait $pid");
    EXPECT_EQ(result.exit_code, 130) << command;
    EXPECT_EQ(result.err, "articular: interrupted\n");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
}

}  // namespace articular::system_failure_test
