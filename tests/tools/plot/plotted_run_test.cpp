#include "tools/plot/plotted_run.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::plotted_run_test {

using Pieces = std::vector<std::vector<PlotPoint>>;

const std::string kHeader = "time [s],a.x [mm],b [N]\n";

std::string refusal(const TemporaryFolder& folder) {
  try {
    read_curves(open_run(folder.path()), 0, {1, 2});
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PlottedRun, HasTheColumnsAndWhatTheSummarySays) {
  const TemporaryFolder folder;
  folder.file("history.csv", kHeader + "0,1,2\n");
  folder.file("summary.json",
              R"({"outcome": "finished", "settings": {"analysis": "static", "duration_s": 2}})");
  const PlottedRun run = open_run(folder.path());
  EXPECT_EQ(run.columns,
            (std::vector<sim::HistoryColumn>{{"time", "s"}, {"a.x", "mm"}, {"b", "N"}}));
  EXPECT_EQ(run.outcome, "finished");
  EXPECT_TRUE(run.is_static);
  EXPECT_EQ(run.duration, 2);
  EXPECT_EQ(find_column(run, "b"), 2U);
  EXPECT_FALSE(find_column(run, "c"));
}

TEST(PlottedRun, ADamagedSummaryIsNone) {
  for (const char* text : {"", "{", "[]", R"({"settings": 3, "outcome": 4})"}) {
    const TemporaryFolder folder;
    folder.file("history.csv", kHeader + "0,1,2\n");
    folder.file("summary.json", text);
    EXPECT_EQ(open_run(folder.path()).outcome, "") << text;
  }
}

TEST(Curves, BlankAndNotFiniteCellsAreGaps) {
  const TemporaryFolder folder;
  folder.file("history.csv", kHeader + "0,1,5\n1,,6\n2,nan,7\r\n3,4,8\n\n4,inf,9\n5,6,\n");
  const RunCurves read = read_curves(open_run(folder.path()), 0, {1, 2});
  EXPECT_EQ(read.curves[0].pieces(), (Pieces{{{0, 1}}, {{3, 4}}, {{5, 6}}}));
  EXPECT_EQ(read.curves[1].pieces(), (Pieces{{{0, 5}, {1, 6}, {2, 7}, {3, 8}, {4, 9}}}));
  EXPECT_EQ(read.rows, 6U);
}

TEST(Curves, AgainstAnotherColumn) {
  const TemporaryFolder folder;
  folder.file("history.csv", kHeader + "0,1,5\n1,2,6\n2,1,7\n");
  EXPECT_EQ(read_curves(open_run(folder.path()), 1, {2}).curves[0].pieces(),
            (Pieces{{{1, 5}, {2, 6}, {1, 7}}}));
}

// "12" may be the beginning of "123.4".
TEST(Curves, ALastLineWithoutEndIsLeftOutAndTold) {
  const TemporaryFolder folder;
  folder.file("history.csv", kHeader + "0,1,5\n1,2,12");
  const RunCurves read = read_curves(open_run(folder.path()), 0, {2});
  EXPECT_TRUE(read.is_torn);
  EXPECT_EQ(read.curves[0].pieces(), (Pieces{{{0, 5}}}));
}

TEST(Curves, WhatIsNoHistoryIsRefusedInOneReadableLine) {
  const auto refused = [](const std::string& text, const std::string& words) {
    const TemporaryFolder folder;
    folder.file("history.csv", text);
    const std::string message = refusal(folder);
    EXPECT_NE(message.find(words), std::string::npos) << message;
    for (const char c : {'\x1b', '\n'}) EXPECT_EQ(message.find(c), std::string::npos);
  };
  refused("", "holds no row of results yet");
  refused("time [s],a", "holds no row of results yet");
  refused(kHeader, "holds no row of results yet");
  refused(kHeader + "0,1", "holds no row of results yet");
  refused("t\x1b,b\n0,1\n", "expected `time [s]` as the first column");
  refused(kHeader + "0,1,2\n1,2\n",
          "history.csv:3: expected 3 fields as in the first line, found 2");
  refused(kHeader + "0,1,\x1b[2J\n", "history.csv:2: column `b`: expected a number");
}

TEST(Curves, WithoutFolderOrHistoryAreRefused) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder).find("no history.csv here"), std::string::npos);
  EXPECT_THROW(open_run(folder / "none"), sim::InputError);
  std::filesystem::create_directory(folder / "history.csv");
  EXPECT_NE(refusal(folder).find("it is no regular file"), std::string::npos);
}

TEST(ErrorBars, AreThoseOfLastValues) {
  const TemporaryFolder folder;
  folder.file("history.csv", kHeader + "0,1,5\n");
  folder.file("error_bars.csv",
              "column,quantity,value,bar,mesh,verdict,not in the bar\n"
              "a.x [mm],end,1,0.25,0.1,asymptotic,\n"
              "a.x [mm],largest,7,0.5,0.1,asymptotic,\n"
              "b [N],end,5,,,\"not estimated (mesh, failed)\",\n");
  const PlottedRun run = open_run(folder.path());
  ASSERT_EQ(run.bars.size(), 2U);
  EXPECT_EQ(run.bars[0].column, (sim::HistoryColumn{"a.x", "mm"}));
  EXPECT_EQ(run.bars[0].bar, 0.25);
  EXPECT_FALSE(run.bars[1].bar);
  EXPECT_EQ(run.bars[1].verdict, "not estimated (mesh, failed)");
}

}  // namespace articular::tools::plotted_run_test
