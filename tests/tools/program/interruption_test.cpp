// A run that is interrupted and resumed leaves the same history, bit for bit, as one that is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/tools/support/program.hpp"

namespace articular::interruption_test {

TEST(Program, InterruptedRunResumesToTheSameHistory) {
  const std::string scene = "'" ARTICULAR_SOURCE_DIR "/scenarios/verification/block_on_block.toml'";
  const std::string arguments =
      scene +
      " --quiet --set duration='100 ms' --set output.checkpoint_interval='10 ms'"
      " --set integrator.step='0.5 ms' --out ";
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(folder, "run " + arguments + "whole").exit_code, 0);
  // Stopped as soon as there is a checkpoint.
  const ProgramResult stopped = run_shell(
      folder, "\"$articular\" run " + arguments +
                  "parts & pid=$!; "
                  "while [ ! -f parts/checkpoint/state.bin ] && kill -0 $pid; do sleep 0.02; done; "
                  "kill -TERM $pid; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(content(folder / "parts/summary.json").find("\"interrupted\""), std::string::npos);
  EXPECT_NE(content(folder / "parts/history.csv"), content(folder / "whole/history.csv"));

  ASSERT_EQ(run_program(folder, "run " + arguments + "parts --resume").exit_code, 0);
  EXPECT_EQ(content(folder / "parts/history.csv"), content(folder / "whole/history.csv"));
}

// The knee's first load step takes half a minute: it is left after an iteration, of which the
// terminal shows something before.
TEST(Program, ALongLoadStepShowsItsIterationsAndIsInterrupted) {
  const TemporaryFolder folder;
  const ProgramResult stopped =
      run_shell(folder, "echo 'echo $$ > pid; exec \"$articular\" run \"" ARTICULAR_SOURCE_DIR
                        "/scenarios/knee/axial-load.toml\" --out knee' > start; touch terminal; "
                        "script -qefc 'sh start' terminal > /dev/null & pid=$!; "
                        "while ! grep -q 'iteration [0-9]* of at most [0-9]* a load step, "
                        "residual' terminal && kill -0 $pid; do sleep 0.05; done; "
                        "kill -INT $(cat pid); wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(content(folder / "terminal").find("load step to 10 % of the load: iteration "),
            std::string::npos);
  EXPECT_NE(content(folder / "knee/summary.json").find("\"interrupted\""), std::string::npos);
  // Column names and the row of the start.
  const std::string history = content(folder / "knee/history.csv");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 2);
}

}  // namespace articular::interruption_test
