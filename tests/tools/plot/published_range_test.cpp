#include "tools/plot/published_range.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::published_range_test {

template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Interval, IsInSiWithItsDimension) {
  const Interval interval = parse_interval("knee.anterior=-1.5..4e0 mm", "--band");
  EXPECT_EQ(interval.probe, "knee.anterior");
  EXPECT_DOUBLE_EQ(interval.low, -1.5e-3);
  EXPECT_DOUBLE_EQ(interval.high, 4e-3);
  EXPECT_EQ(interval.unit.dimension, sim::kLength.dimension);
  EXPECT_EQ(parse_interval("0 .. 1", "--range").unit.dimension, sim::Dimension{});
  EXPECT_DOUBLE_EQ(parse_interval("0..50 %", "--x-range").high, 0.5);
}

TEST(Interval, OfAnythingElseSaysWhatWasExpected) {
  for (const char* text : {"", "4 mm", "4..", "..4 mm", "a=b", "7..4 mm", "4..4 mm", "nan..1 mm",
                           "1..inf mm", "1..2 furlong", "1..2 mm mm."})
    EXPECT_NE(refusal([&] { parse_interval(text, "--band"); }).find("--band"), std::string::npos)
        << text;
}

TEST(BandTable, IsInSiByTheUnitsOfItsHeader) {
  const TemporaryFolder folder;
  const auto file = folder.file("study.csv", "time [ms],low [mm],\"high [cm]\"\n0,1,2\n50,3,4\n");
  const BandTable band = read_band("tip.position=" + file.string());
  EXPECT_EQ(band.probe, "tip.position");
  EXPECT_EQ(band.name, "study");
  EXPECT_DOUBLE_EQ(band.x.values[1], 0.05);
  EXPECT_DOUBLE_EQ(band.low.values[1], 3e-3);
  EXPECT_DOUBLE_EQ(band.high.values[1], 4e-2);
  EXPECT_EQ(band.low.unit.dimension, sim::kLength.dimension);
}

TEST(BandTable, ThatIsNoneIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* text, const char* words) {
    const auto file = folder.file("b.csv", text);
    const std::string message = refusal([&] { read_band(file.string()); });
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(message.find('\x1b'), std::string::npos);
  };
  refused("time [s],low [mm]\n0,1\n", "b.csv:1: expected three columns");
  refused("time [s],low [mm],high [N]\n0,1,2\n",
          "the lower end is a length, the upper one a force");
  refused("time [s],low [mm],high [mm]\n0,1,x\x1b\n", "b.csv:2: column `high`: expected a number");
  refused("time [s],low [mm],high [mm]\n0,3,2\n", "b.csv:2: the lower end lies above");
  refused("time [s],low [mm],high [mm]\n0,1,2\n0,1,2\n", "b.csv:3: column `time` has to increase");
  refused("time [x],low [mm],high [mm]\n0,1,2\n", "unknown unit `x`");
  EXPECT_NE(refusal([] { read_band("none.csv"); }).find("No such file"), std::string::npos);
}

}  // namespace articular::tools::published_range_test
