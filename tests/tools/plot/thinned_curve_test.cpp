#include "tools/plot/thinned_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace articular::tools::thinned_curve_test {

using Pieces = std::vector<std::vector<PlotPoint>>;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr int kRows = 1000003;  // no multiple of anything

ThinnedCurve curve_of(int rows, double (*y)(int)) {
  ThinnedCurve curve;
  for (int i = 0; i < rows; ++i) curve.add(i, y(i));
  return curve;
}

bool contains(const Pieces& pieces, const PlotPoint& point) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) {
    return std::find(piece.begin(), piece.end(), point) != piece.end();
  });
}

TEST(ThinnedCurve, OfFewRowsIsWhole) {
  const auto y = [](int i) { return std::sin(i); };
  const Pieces pieces = curve_of(static_cast<int>(ThinnedCurve::kMostBuckets), y).pieces();
  ASSERT_EQ(pieces.size(), 1U);
  ASSERT_EQ(pieces[0].size(), ThinnedCurve::kMostBuckets);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pieces[0][static_cast<std::size_t>(i)].y, y(i));
}

// A single row up and one down: each lies anywhere within its bucket.
TEST(ThinnedCurve, KeepsEveryExtremeAndBothEnds) {
  const Pieces pieces = curve_of(kRows, [](int i) {
                          return i == 777777 ? 50.0 : i == 123457 ? -9.0 : 0.1 * std::sin(i);
                        }).pieces();
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(contains(pieces, {777777, 50}));
  EXPECT_TRUE(contains(pieces, {123457, -9}));
  EXPECT_EQ(pieces[0].front().x, 0);
  EXPECT_EQ(pieces[0].back().x, kRows - 1);
}

// As of a loop: x goes to and fro while y is of no interest.
TEST(ThinnedCurve, KeepsExtremesOfXToo) {
  ThinnedCurve curve;
  for (int i = 0; i < kRows; ++i) curve.add(i == 500001 ? 7 : i == 500777 ? -7 : 0, i);
  const Pieces pieces = curve.pieces();
  EXPECT_TRUE(contains(pieces, {7, 500001}));
  EXPECT_TRUE(contains(pieces, {-7, 500777}));
}

TEST(ThinnedCurve, IsBoundedAndInTheOrderOfTheRows) {
  const Pieces pieces = curve_of(kRows, [](int i) { return std::sin(0.7 * i); }).pieces();
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_LE(pieces[0].size(), 6 * ThinnedCurve::kMostBuckets);
  EXPECT_GE(pieces[0].size(), ThinnedCurve::kMostBuckets);
  for (std::size_t i = 1; i < pieces[0].size(); ++i) EXPECT_LT(pieces[0][i - 1].x, pieces[0][i].x);
}

TEST(ThinnedCurve, ABlankRowIsAGap) {
  const Pieces pieces = curve_of(6, [](int i) { return i == 2 || i == 4 ? kNothing : i; }).pieces();
  EXPECT_EQ(pieces, (Pieces{{{0, 0}, {1, 1}}, {{3, 3}}, {{5, 5}}}));
}

TEST(ThinnedCurve, ALongGapIsKeptWhereRowsAreGathered) {
  const Pieces pieces =
      curve_of(kRows, [](int i) { return i > 300000 && i < 500000 ? kNothing : 1.0 * i; }).pieces();
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].back().x, 300000);
  EXPECT_EQ(pieces[1].front().x, 500000);
}

// Rows lie in twos: a blank second one ends a piece, a blank first one begins another.
TEST(ThinnedCurve, AGapAtTheEdgeOfABucketIsKept) {
  for (const int blank : {1000, 1001}) {
    ThinnedCurve curve;
    for (int i = 0; i < 2 * static_cast<int>(ThinnedCurve::kMostBuckets); ++i)
      curve.add(i, i == blank ? kNothing : 1);
    const Pieces pieces = curve.pieces();
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].back().x, blank - 1);
    EXPECT_EQ(pieces[1].front().x, blank + 1);
  }
}

TEST(ThinnedCurve, WithoutValuesHasNoPieces) {
  EXPECT_TRUE(curve_of(10000, [](int) { return kNothing; }).pieces().empty());
}

}  // namespace articular::tools::thinned_curve_test
