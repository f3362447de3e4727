// One study file on every engine: the same table comes out.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/tools/support/program.hpp"

namespace articular::engines_test {

const std::string kStudy =
    "command = ['sh', '-c', \"sleep 0.1; printf 'time [s],y [mm]\\\\n0,%s\\\\n' {x * 2} > "
    "history.csv\"]\n"
    "[[output]]\ncolumn = 'y [mm]'\n[population]\nsamples = 12\n"
    "[[parameter]]\nname = 'x'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n";

/// The table without what a machine's speed decides on.
std::string values_in(const std::string& csv) {
  std::string kept;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; std::getline(cells, cell, ','); ++i)
      if (i < 2 || i > 5) kept += cell + ",";
    kept += "\n";
  }
  return kept;
}

bool is_installed(const TemporaryFolder& folder, const std::string& program) {
  return run_shell(folder, "command -v " + program).exit_code == 0;
}

class Engines : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.file("s.toml", kStudy);
    ASSERT_EQ(run_program(folder_, "study s.toml --quiet --out local").exit_code, 0);
    expected_ = values_in(content(folder_ / "local/population.csv"));
    ASSERT_NE(expected_.find("sample 012,done,"), std::string::npos) << expected_;
  }
  void expect_the_same(const ProgramResult& result, const std::string& out) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(values_in(content(folder_ / (out + "/population.csv"))), expected_);
  }
  TemporaryFolder folder_;
  std::string expected_;
};

TEST_F(Engines, FolderIsServedByWhoeverWorksThere) {
  const ProgramResult result =
      run_shell(folder_,
                "\"$articular\" study s.toml --engine folder --out f & study=$!; "
                "while [ ! -d f/queue ] && kill -0 $study; do sleep 0.02; done; "
                "\"$articular\" work f/queue --wait --quiet & one=$!; "
                "\"$articular\" work f/queue --wait --quiet & two=$!; "
                "wait $study; code=$?; kill $one $two; wait $one; wait $two; exit $code");
  expect_the_same(result, "f");
  EXPECT_NE(result.err.find("12 cases for whoever runs: articular work '"), std::string::npos)
      << result.err;
}

TEST_F(Engines, GnuParallelStartsWorkers) {
  if (!is_installed(folder_, "parallel")) GTEST_SKIP() << "no GNU parallel here";
  expect_the_same(run_program(folder_, "study s.toml --engine parallel --jobs 3 --out p"), "p");
}

// In place of ssh a script that notes the machine and runs the command here.
TEST_F(Engines, SshStartsWorkersOnEveryMachine) {
  std::filesystem::create_directory(folder_ / "bin");
  folder_.file("bin/ssh", "#!/bin/sh\nshift 2\necho \"$1\" >> '" + (folder_ / "asked").string() +
                              "'\nshift\nexec sh -c \"$*\"\n");
  folder_.file("machines", "# ours\nleft 2\n\nright\n");
  const ProgramResult result =
      run_shell(folder_,
                "chmod +x bin/ssh; PATH=$PWD/bin:$PATH \"$articular\" study s.toml --engine ssh "
                "--machines machines --out s; code=$?; sort asked > sorted; exit $code");
  expect_the_same(result, "s");
  EXPECT_EQ(content(folder_ / "sorted"), "left\nleft\nright\n");
}

// A Slurm of one node, which the script starts and stops.
TEST_F(Engines, SlurmRunsAJobArray) {
  const ProgramResult result =
      run_shell(folder_, "'" ARTICULAR_SOURCE_DIR
                         "/tests/tools/engine/with-slurm' sh -c '"
                         "\"$articular\" study s.toml --engine slurm --jobs 2 --out sl && "
                         "sleep 3 && squeue --noheader > left'");
  if (result.exit_code == 77) GTEST_SKIP() << result.err;
  expect_the_same(result, "sl");
  EXPECT_NE(result.err.find("Slurm, job array"), std::string::npos) << result.err;
  EXPECT_EQ(content(folder_ / "left"), "");
}

TEST_F(Engines, AWorkerThatIsKilledCostsItsCaseOnly) {
  folder_.file("slow.toml",
               "command = ['sh', '-c', \"sleep 1; printf 'time [s],y [mm]\\\\n0,%s\\\\n' {x} > "
               "history.csv\"]\n[[output]]\ncolumn = 'y [mm]'\n[population]\nsamples = 3\n"
               "[[parameter]]\nname = 'x'\ndistribution = 'uniform'\nlowest = 0\nhighest = 1\n");
  const ProgramResult result =
      run_shell(folder_,
                "\"$articular\" study slow.toml --engine folder --lost-after 5 --out k & study=$!; "
                "while [ ! -d k/queue ] && kill -0 $study; do sleep 0.02; done; "
                "\"$articular\" work k/queue --wait --quiet & one=$!; "
                "while ! ls k/queue/*.taken > /dev/null 2>&1 && kill -0 $study; do sleep 0.02; "
                "done; kill -KILL $one; "
                "\"$articular\" work k/queue --wait --quiet & two=$!; "
                "wait $study; code=$?; kill $two; wait $two; exit $code");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string text = content(folder_ / "k/population.md");
  EXPECT_NE(text.find("2 of 3 cases succeeded"), std::string::npos) << text;
  EXPECT_NE(text.find("| lost | its worker fell silent"), std::string::npos) << text;
  const ProgramResult again =
      run_program(folder_, "study slow.toml --out k");  // here, the lost one
  EXPECT_NE(again.err.find("[1/1]"), std::string::npos) << again.err;
  EXPECT_NE(content(folder_ / "k/population.md").find("3 of 3"), std::string::npos);
}

TEST_F(Engines, MissingProgramsAndMachinesAreNamed) {
  const ProgramResult slurm =
      run_shell(folder_, "PATH=/nowhere \"$articular\" study s.toml --engine slurm --out x");
  EXPECT_EQ(slurm.exit_code, 4);
  EXPECT_NE(slurm.err.find("can't start sbatch (Debian: slurm-client)"), std::string::npos)
      << slurm.err;
  const ProgramResult ssh = run_program(folder_, "study s.toml --engine ssh");
  EXPECT_EQ(ssh.exit_code, 2);
  EXPECT_NE(ssh.err.find("expected --machines FILE"), std::string::npos) << ssh.err;
  folder_.file("machines", "left two\n");
  const ProgramResult machines =
      run_program(folder_, "study s.toml --engine ssh --machines machines --out y");
  EXPECT_EQ(machines.exit_code, 2);
  EXPECT_NE(machines.err.find("machines:1:6: expected a number of workers"), std::string::npos)
      << machines.err;
  const ProgramResult work = run_program(folder_, "work nowhere");
  EXPECT_EQ(work.exit_code, 2);
  EXPECT_NE(work.err.find("expected the queue of a study"), std::string::npos) << work.err;
}

}  // namespace articular::engines_test
