#include "tools/report/packed_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/report/unpacked.hpp"

namespace articular::tools::report_test {

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff"), "+/8=");
}

TEST(PackedIntegers, ComeBackFromTheirDifferences) {
  const std::vector<std::uint32_t> numbers{7, 4000000000U, 3, 3, 70000, 0};
  for (const std::size_t back : {0U, 1U, 3U, 9U})
    EXPECT_EQ(unpacked_integers(packed_integers(numbers, 4, back), 4, back), numbers) << back;
}

TEST(PackedDoubles, KeepAllTheirBits) {
  const std::vector<double> numbers{0, -1.0 / 3, 1e-300, 6.02e23};
  EXPECT_EQ(unpacked_doubles(packed_doubles(numbers)), numbers);
}

TEST(Quantised, IsOffByHalfAStepAtMost) {
  std::vector<double> numbers(1000);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = -3 + 17 * std::sin(static_cast<double>(i) * 0.37);
  for (const std::size_t frame_size : {0U, 10U}) {
    const Json json = quantised(numbers, frame_size);
    const std::vector<double> values = unquantised(json, frame_size);
    const double step = (json["high"].get<double>() - json["low"].get<double>()) / 65534;
    EXPECT_NEAR(step, 34.0 / 65534, 1e-5);
    ASSERT_EQ(values.size(), numbers.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], numbers[i], 0.5000001 * step);
  }
}

TEST(Quantised, WhatIsNoNumberStaysNone) {
  const std::vector<double> values = unquantised(quantised({1, NAN, 2, INFINITY}, 0), 0);
  EXPECT_EQ(values[0], 1);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], 2);
  EXPECT_TRUE(std::isnan(values[3]));
}

TEST(Quantised, EqualNumbersAndNoneAreExact) {
  EXPECT_EQ(unquantised(quantised({0.1, 0.1}, 1), 1), (std::vector<double>{0.1, 0.1}));
  EXPECT_TRUE(unquantised(quantised({}, 0), 0).empty());
}

// What hardly moves takes little room.
TEST(Quantised, WhatStandsStillIsPackedOnce) {
  std::vector<double> one, all;
  for (int i = 0; i < 5000; ++i) one.push_back(std::sin(i * i * 0.7));
  for (int frame = 0; frame < 50; ++frame) all.insert(all.end(), one.begin(), one.end());
  const auto size = [](const Json& json) { return json["packed"].get<std::string>().size(); };
  EXPECT_LT(size(quantised(all, one.size())), size(quantised(one, 0)) * 6 / 5);
}

}  // namespace articular::tools::report_test
