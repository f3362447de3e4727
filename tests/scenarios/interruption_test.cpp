// A run that is interrupted and resumed leaves the same history, bit for bit, as one that is not.
#include <gtest/gtest.h>

#include "tests/scenarios/program.hpp"

namespace articular {
namespace {

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
      folder, "'" ARTICULAR_PROGRAM "' run " + arguments +
                  "parts & pid=$!; "
                  "while [ ! -f parts/checkpoint/state.bin ] && kill -0 $pid; do sleep 0.02; done; "
                  "kill -TERM $pid; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(content(folder / "parts/summary.json").find("\"interrupted\""), std::string::npos);
  EXPECT_NE(content(folder / "parts/history.csv"), content(folder / "whole/history.csv"));

  ASSERT_EQ(run_program(folder, "run " + arguments + "parts --resume").exit_code, 0);
  EXPECT_EQ(content(folder / "parts/history.csv"), content(folder / "whole/history.csv"));
}

}  // namespace
}  // namespace articular
