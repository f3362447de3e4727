// Bars of the columns of a history, from made-up coarser runs.
#include "tools/error_bars/error_bars.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/error_bars/error_bar_report.hpp"

namespace articular::tools::error_bars_test {

/// A history of one column, whose last value is `end`.
RunHistory ends_with(double end) { return {{"time [s]", "x [mm]"}, {{0, 1}, {0, end}}}; }

CoarserRun run_with(double size, RunHistory history) {
  return {"run", {}, size, "", std::move(history)};
}

CoarserRun failed(const std::string& why) { return {"run", {}, 0, why, {}}; }

ErrorBar only_bar(const RunHistory& history, const std::vector<Direction>& directions) {
  const std::vector<ErrorBar> bars = error_bars(history, directions);
  EXPECT_EQ(bars.size(), 1U);
  return bars.at(0);
}

/// Errors of second order, 0.01 at size 1, about 1.
Direction second_order(const std::string& name, double own) {
  return {
      name, 2, {run_with(2, ends_with(own + 0.03)), run_with(4, ends_with(own + 0.15))}, "", ""};
}

TEST(ErrorBars, AreTheSumOfTheirParts) {
  const Direction second = second_order("mesh", 1);
  const Direction first{
      "step", 1, {run_with(2, ends_with(1.1)), run_with(4, ends_with(1.3))}, "", ""};
  const ErrorBar bar = only_bar(ends_with(1), {second, first});
  EXPECT_NEAR(bar.parts[0].bar, 1.25 * 0.01, 1e-12);
  EXPECT_NEAR(bar.parts[1].bar, 1.25 * 0.1, 1e-12);
  EXPECT_NEAR(bar.bar, 1.25 * 0.11, 1e-12);
  EXPECT_EQ(bar.doubts, "");
  EXPECT_EQ(bar.left_out, "");
  EXPECT_EQ(verdict(bar), "asymptotic");
}

// A doubtful part matters once it is more than a tenth of the bar.
TEST(ErrorBars, ASmallDoubtfulPartDoesNotSpoilTheVerdict) {
  const auto to_and_fro = [](double size) {
    return Direction{
        "step", 1, {run_with(2, ends_with(1 + size)), run_with(4, ends_with(1 - size))}, "", ""};
  };
  EXPECT_EQ(only_bar(ends_with(1), {second_order("mesh", 1), to_and_fro(1e-4)}).doubts, "");
  EXPECT_EQ(only_bar(ends_with(1), {second_order("mesh", 1), to_and_fro(1e-2)}).doubts,
            "step: goes to and fro");
}

// Newton's tolerance is varied once, as it should be.
TEST(ErrorBars, ADirectionOfOneRunIsNotDoubtedForIt) {
  const Direction tolerance{"tolerance", 1, {run_with(10, ends_with(1.09))}, "", "", 1};
  const ErrorBar bar = only_bar(ends_with(1), {tolerance});
  EXPECT_NEAR(bar.bar, 3 * 0.09 / 9, 1e-12);
  EXPECT_EQ(verdict(bar), "asymptotic");
}

// Of steps there should have been two.
TEST(ErrorBars, OneRunWhereTwoWereWantedIsDoubted) {
  const Direction steps{"step", 1, {run_with(2, ends_with(1.09))}, "", ""};
  EXPECT_EQ(verdict(only_bar(ends_with(1), {steps})),
            "not asymptotic (step: order 1 taken, not seen)");
}

TEST(ErrorBars, AFailedRunLeavesABarOfTheOtherAndSaysSo) {
  Direction mesh = second_order("mesh", 1);
  mesh.runs[1] = failed("could not go on: t = 3 ms");
  const ErrorBar bar = only_bar(ends_with(1), {mesh});
  EXPECT_NEAR(bar.bar, 3 * 0.03 / 3, 1e-12);
  EXPECT_EQ(verdict(bar),
            "not asymptotic (mesh: order 2 taken, not seen; the coarser run `run` failed)");
}

TEST(ErrorBars, WhereAllFailThereIsNone) {
  const Direction mesh{"mesh", 2, {failed("a"), failed("b")}, "", ""};
  const ErrorBar bar = only_bar(ends_with(1), {mesh});
  EXPECT_FALSE(bar.is_estimated());
  EXPECT_EQ(verdict(bar),
            "not estimated (mesh: the coarser run `run` failed; the coarser run `run` failed)");
}

// Steps say nothing of the elements: their tiny bar would promise too much.
TEST(ErrorBars, WithoutTheMeshOfATissueThereIsNone) {
  Direction mesh{"mesh", 2, {}, "there are no fewer cells to take", ""};
  mesh.is_needed = true;
  const Direction steps{
      "step", 1, {run_with(2, ends_with(1 + 1e-9)), run_with(4, ends_with(1 + 2e-9))}, "", ""};
  const ErrorBar bar = only_bar(ends_with(1), {mesh, steps});
  EXPECT_FALSE(bar.is_estimated());
  EXPECT_FALSE(bar.is_negligible());
  EXPECT_EQ(verdict(bar), "not estimated (mesh: there are no fewer cells to take)");
  EXPECT_LT(bar.parts[1].bar, 1e-8);  // is in the table
  mesh = second_order("mesh", 1);
  mesh.is_needed = true;
  EXPECT_EQ(verdict(only_bar(ends_with(1), {mesh, steps})), "asymptotic");
}

// A long message would stand in each row.
TEST(ErrorBarReport, SaysOnceWhyARunFailed) {
  const RunHistory history{{"time [s]", "x [mm]", "y [mm]"}, {{0, 1}, {0, 1}, {0, 2}}};
  const std::vector<Direction> directions{
      {"mesh", 2, {failed("no node in the region"), failed("b")}, "", ""}};
  const std::string text = error_bars_text(directions, error_bars(history, directions));
  const std::size_t first = text.find("no node in the region");
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find("no node in the region", first + 1), std::string::npos) << text;
}

TEST(ErrorBars, SayWhatIsNotInThem) {
  const Direction mesh{"mesh", 2, {}, "`scan` can't be made coarser", ""};
  const ErrorBar bar = only_bar(ends_with(1), {mesh, second_order("step", 1)});
  EXPECT_NEAR(bar.bar, 1.25 * 0.01, 1e-12);
  EXPECT_EQ(bar.left_out, "mesh: `scan` can't be made coarser");
  EXPECT_FALSE(only_bar(ends_with(1), {mesh}).is_estimated());
}

// The peak lies between the first and the last row; the least value is the first, which is given.
TEST(ErrorBars, AreOfTheEndAndOfExtremesBetween) {
  const RunHistory history{{"time [s]", "x [mm]"}, {{0, 1, 2, 3}, {0, 5, 4, 3}}};
  const std::vector<ErrorBar> bars = error_bars(history, {});
  ASSERT_EQ(bars.size(), 2U);
  EXPECT_EQ(bars[0].quantity, Quantity::End);
  EXPECT_EQ(bars[0].value, 3);
  EXPECT_EQ(bars[1].quantity, Quantity::Largest);
  EXPECT_EQ(bars[1].value, 5);
}

TEST(ErrorBars, AColumnThatEndsBlankHasNoEnd) {
  const RunHistory history{{"time [s]", "x [mm]", "y [mm]"},
                           {{0, 1, 2, 3}, {kNoValue, -5, -9, kNoValue}, std::vector(4, kNoValue)}};
  EXPECT_TRUE(error_bars(history, {}).empty());  // both extremes stand at an end of what there is
  const RunHistory peak{{"time [s]", "x [mm]"}, {{0, 1, 2, 3, 4}, {kNoValue, 1, 9, 2, kNoValue}}};
  const std::vector<ErrorBar> bars = error_bars(peak, {});
  ASSERT_EQ(bars.size(), 1U);
  EXPECT_EQ(bars[0].value, 9);
}

TEST(ErrorBars, ABlankInACoarserRunIsToldAndNotTakenForANumber) {
  Direction mesh = second_order("mesh", 1);
  mesh.runs[0].history = ends_with(kNoValue);
  mesh.runs[1].history = ends_with(kNoValue);
  EXPECT_EQ(verdict(only_bar(ends_with(1), {mesh})),
            "not estimated (mesh: no value in the coarser runs)");
}

// Across a force of 1 N there is round-off, which converges nowhere.
TEST(ErrorBars, RoundOffBesideALargeComponentIsNegligible) {
  const auto history = [](double across) {
    return RunHistory{{"time [s]", "f.force.x [N]", "f.force.z [N]", "g.force.x [N]"},
                      {{0, 1}, {0, across}, {0, 1}, {0, across}}};
  };
  const Direction mesh{
      "mesh", 2, {run_with(2, history(-3e-12)), run_with(4, history(9e-12))}, "", ""};
  const std::vector<ErrorBar> bars = error_bars(history(1e-12), {mesh});
  EXPECT_EQ(verdict(bars[0]), "negligible");
  EXPECT_EQ(verdict(bars[1]), "negligible");  // equal in all runs
  EXPECT_EQ(verdict(bars[2]), "not asymptotic (mesh: goes to and fro)");
}

TEST(ErrorBars, ForcesAreQuotedByTheirSizesToo) {
  RunHistory history{
      {"time [s]", "f.force.x [N]", "f.force.y [N]", "f.force.z [N]", "f.area [mm^2]"},
      {{0, 1}, {0, 2}, {0, -3}, {0, 6}, {0, 9}}};
  add_force_sizes(history);
  ASSERT_EQ(history.names.size(), 6U);
  EXPECT_EQ(history.names[5], "f.force [N]");
  EXPECT_EQ(history.columns[5], (std::vector<double>{0, 7}));
}

TEST(ErrorBarReport, TableHasARowAQuantityAndSummaryCountsThem) {
  const std::vector<Direction> directions{second_order("mesh", 1),
                                          {"step", 1, {}, "one step, no more", ""}};
  const std::vector<ErrorBar> bars = error_bars(ends_with(1), directions);
  EXPECT_EQ(error_bars_csv(directions, bars),
            "column,quantity,value,bar,mesh,order of mesh,step,order of step,verdict,not in the "
            "bar\nx [mm],end,1,0.0125,0.0125,2,,,asymptotic,\"step: one step, no more\"\n");
  const auto json = nlohmann::json::parse(
      summary_with_error_bars("{\"outcome\": \"finished\"}", directions, bars));
  EXPECT_EQ(json.at("outcome"), "finished");
  EXPECT_EQ(json.at("error_bars").at("mesh").at("sizes"), (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(json.at("error_bars").at("quantities").at("asymptotic"), 1);
  EXPECT_EQ(json.at("error_bars").at("step").at("not_in_the_bars"), "one step, no more");
  const std::string text = error_bars_text(directions, bars);
  EXPECT_NE(text.find("not in the bars: one step, no more"), std::string::npos) << text;
  EXPECT_NE(text.find("1.000 ± 0.013      asymptotic; not all is in the bar\n"), std::string::npos)
      << text;
}

}  // namespace articular::tools::error_bars_test
