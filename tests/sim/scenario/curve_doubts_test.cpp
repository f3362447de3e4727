// Curves that can be read and are hardly meant.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::curve_doubts_test {

class CurveDoubts : public ScenarioTest {
 protected:
  const std::string gravity_ = "[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 -9.81 m/s^2\"\n";
  /// Up to 3 s.
  const std::string ramp_ = "[curve.ramp]\ntime = [\"0 s\", \"1 s\", \"3 s\"]\nvalue = [0, 1, 1]\n";

  std::vector<std::string> doubts(const std::string& text,
                                  const std::vector<std::string>& overrides = {}) {
    return read(text, overrides).doubts;
  }
  /// kStart with another duration.
  std::string lasting(const std::string& duration) const {
    std::string text = kStart;
    const std::size_t begin = text.find("duration = ");
    return text.replace(begin, text.find('\n', begin) - begin, "duration = \"" + duration + "\"");
  }
};

TEST_F(CurveDoubts, ACurveThatNothingNamesIsTold) {
  const auto found = doubts(kStart + ramp_ + gravity_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("no `excitation` or `profile` names the curve `ramp`"), std::string::npos)
      << found[0];
  EXPECT_NE(found[0].find(".toml:"), std::string::npos) << found[0];
  // A name that is something else's says nothing.
  EXPECT_EQ(doubts("title = \"ramp\"\n" + kStart + ramp_ + gravity_).size(), 1U);
}

TEST_F(CurveDoubts, OneThatAVariantOrAnOverrideNamesIsNot) {
  const std::string light = "[choice]\nload = \"light\"\n" + ramp_ + gravity_ +
                            "when = { load = \"light\" }\n" + gravity_ +
                            "when = { load = \"heavy\" }\nprofile = \"ramp\"\n";
  EXPECT_TRUE(doubts(lasting("3 s") + light).empty());
  EXPECT_TRUE(doubts(lasting("3 s") + ramp_ + gravity_, {"load.0.profile=ramp"}).empty());
  // Nor is one that an override has replaced.
  EXPECT_TRUE(doubts(lasting("3 s") + ramp_ + gravity_ + "profile = \"ramp\"\n",
                     {"load.0.profile={ time = [\"0 s\"], value = [1] }"})
                  .empty());
}

TEST_F(CurveDoubts, AChangeAfterTheEndOfTheRunIsTold) {
  const std::string named = gravity_ + "profile = \"ramp\"\n";
  const auto found = doubts(lasting("0.5 s") + ramp_ + named);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("`ramp` changes until 3 s, and the run ends at 0.5 s"), std::string::npos)
      << found[0];
  EXPECT_TRUE(doubts(lasting("3 s") + ramp_ + named).empty());
  // From 1 s on it is constant.
  EXPECT_TRUE(doubts(lasting("1 s") + ramp_ + named).empty());
  EXPECT_TRUE(doubts(lasting("2 s") + ramp_ + named).empty());
  // In place.
  EXPECT_EQ(doubts(lasting("0.5 s") + gravity_ +
                   "profile = { time = [\"0 s\", \"1 s\"], value = [0, 1] }\n")
                .size(),
            1U);
}

TEST_F(CurveDoubts, SoIsAMotionOfWhichTheEndIsCutOff) {
  const std::string motion =
      "[[load]]\nkind = \"motion\"\nbody = \"stand\"\ntime = [\"0 s\", \"1 s\", \"2 s\"]\n"
      "translation = [\"0 0 0 mm\", \"0 0 1 mm\", \"0 0 2 mm\"]\n";
  EXPECT_EQ(doubts(lasting("1.5 s") + motion).size(), 1U);
  EXPECT_TRUE(doubts(lasting("2 s") + motion).empty());
}

// As a study does, and who wants a shorter run.
TEST_F(CurveDoubts, WhoSetsTheDurationIsNotTold) {
  const std::string text = lasting("3 s") + ramp_ + gravity_ + "profile = \"ramp\"\n";
  EXPECT_TRUE(doubts(text, {"duration=0.5 s"}).empty());
  EXPECT_TRUE(doubts(text, {" duration = 0.5 s"}).empty());
  EXPECT_EQ(doubts(text, {"curve.ramp.value=[0, 1, 2]",
                          "curve.ramp.time=[\"0 s\", \"1 s\", "
                          "\"5 s\"]"})
                .size(),
            1U);
}

TEST_F(CurveDoubts, ARunWarnsOfThem) {
  const Scenario scenario =
      read("duration = \"1 s\"\n" + ramp_ +
           "[[body]]\nname = \"cube\"\nkind = \"tissue\"\ndensity = \"1000 kg/m^3\"\n"
           "geometry = { box = { size = \"10 10 10 mm\", cells = [1, 1, 1] } }\n"
           "material = { law = \"linear\", young_modulus = \"5 MPa\", poisson_ratio = 0.4 }\n" +
           gravity_);
  const std::vector<std::string> warnings = build_model(scenario).warnings;
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(), scenario.doubts.at(0)), 1);
}

}  // namespace articular::sim::curve_doubts_test
