#include "tools/plot/axis_range.hpp"

#include <gtest/gtest.h>

namespace articular::tools::axis_range_test {

using Labels = std::vector<std::string>;

TEST(AxisRange, HasRoomAroundValues) {
  EXPECT_EQ(with_room({0, 100}), (AxisRange{-5, 105}));
  EXPECT_EQ(with_room({0, 0}), (AxisRange{-1, 1}));
  EXPECT_EQ(with_length({0, 100}), (AxisRange{0, 100}));
}

// Values that differ by round-off must not fill the panel as if they moved.
TEST(AxisRange, RoundOffLooksLikeOneValue) {
  const AxisRange range = with_room({36.1, 36.1 * (1 + 1e-12)});
  EXPECT_LT(range.low, 36);
  EXPECT_GT(range.high, 37);
}

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  EXPECT_EQ(ticks({-5, 105}, 6).labels, (Labels{"0", "20", "40", "60", "80", "100"}));
  EXPECT_EQ(ticks({0, 1}, 3).labels, (Labels{"0.0", "0.5", "1.0"}));
  EXPECT_EQ(ticks({-0.2, 0.2}, 5).labels, (Labels{"−0.2", "−0.1", "0.0", "0.1", "0.2"}));
}

TEST(Ticks, AreNeverMoreThanThereIsRoomFor) {
  for (int most = 2; most < 12; ++most)
    for (const double size : {1e-9, 0.37, 4.1, 99.0, 12345.0}) {
      const Ticks divided = ticks({-0.3 * size, 0.7 * size}, most);
      EXPECT_LE(divided.at.size(), static_cast<std::size_t>(most));
      EXPECT_GE(divided.at.size(), 1U);
      EXPECT_EQ(divided.at.size(), divided.labels.size());
      for (const double at : divided.at) EXPECT_TRUE(at >= -0.3 * size && at <= 0.7 * size);
    }
}

TEST(Ticks, HaveDigitsEnoughToDiffer) {
  const Ticks divided = ticks({36.1001, 36.1004}, 4);
  ASSERT_GE(divided.labels.size(), 2U);
  EXPECT_NE(divided.labels[0], divided.labels[1]);
}

}  // namespace articular::tools::axis_range_test
