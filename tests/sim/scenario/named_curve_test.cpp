// Curves with names, which several entries share.
#include <gtest/gtest.h>

#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::named_curve_test {

class NamedCurves : public ScenarioTest {
 protected:
  const std::string curves_ =
      "[curve.ramp]\ntime = [\"0 s\", \"1 s\"]\nvalue = [0, 1]\n"
      "[curve.title]\ntime = [\"0 s\"]\nvalue = [2]\n";
  const std::string muscle_ =
      "[[muscle]]\nname = \"m\"\nmax_force = \"1 N\"\n"
      "path = [{ body = \"skull\", point = \"0 0 0 m\" }, { body = \"mandible\", point = \"0 0 1 "
      "m\" }]\n";
  const std::string gravity_ = "[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 -9.81 m/s^2\"\n";
};

TEST_F(NamedCurves, AreTheSameAsThoseWrittenInPlace) {
  const Scenario scenario = read(kStart + curves_ + muscle_ + "excitation = \"ramp\"\n" + gravity_ +
                                 "profile = \"title\"\n");
  EXPECT_EQ(scenario.muscles[0].excitation.time, (std::vector<double>{0, 1}));
  EXPECT_EQ(scenario.muscles[0].excitation.value, (std::vector<double>{0, 1}));
  EXPECT_EQ(std::get<GravityLoad>(scenario.loads[0]).profile.value, (std::vector<double>{2}));
}

TEST_F(NamedCurves, AreChangedForAllThatNameThem) {
  const Scenario scenario = read(
      kStart + curves_ + muscle_ + "excitation = \"ramp\"\n" + gravity_ + "profile = \"ramp\"\n",
      {"curve.ramp.value=[0, 0.5]"});
  EXPECT_EQ(scenario.muscles[0].excitation.value[1], 0.5);
  EXPECT_EQ(std::get<GravityLoad>(scenario.loads[0]).profile.value[1], 0.5);
}

TEST_F(NamedCurves, UnknownOnesGetTheNearest) {
  EXPECT_NE(refusal(kStart + curves_ + muscle_ + "excitation = \"ramb\"\n")
                .find("`excitation`: no curve is called `ramb`; did you mean `ramp`?"),
            std::string::npos);
  EXPECT_NE(refusal(kStart + muscle_ + "excitation = \"ramp\"\n")
                .find("`excitation`: no curve is called `ramp`; expected it as [curve.NAME] with "
                      "`time` and `value`"),
            std::string::npos);
}

// An excitation lies between 0 and 1, a profile need not.
TEST_F(NamedCurves, HaveTheRangeOfTheKeyThatNamesThem) {
  EXPECT_NE(refusal(kStart + curves_ + muscle_ + "excitation = \"title\"\n")
                .find("must lie between 0 and 1, found 2"),
            std::string::npos);
}

TEST_F(NamedCurves, AreCheckedEvenIfNothingNamesThem) {
  EXPECT_NE(refusal(kStart + "[curve.a]\ntime = [\"0 s\"]\nvalue = [1, 2]\n")
                .find("expected as many values as times (1), found 2"),
            std::string::npos);
  EXPECT_NE(refusal("curve = 5\n" + kStart).find("expected curves as [curve.NAME]"),
            std::string::npos);
}

}  // namespace articular::sim::named_curve_test
