// What --target-error and --of mean, and what is refused.
#include "tools/target_error/wanted_error.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"

namespace articular::tools::wanted_error_test {

const RunHistory kHistory{
    {"time [s]", "tip.position.z [mm]", "plate.force.x [N]", "plate.force.z [N]",
     "share.share [-]"},
    {{0, 1, 2}, {-100, -104, -102}, {0, 0, 1e-9}, {0, 3, 2}, {0, 0.1, kNoValue}}};
const std::vector<std::string> kColumns(kHistory.names.begin() + 1, kHistory.names.end());

template <class F>
std::string refusal(F ask) {
  try {
    ask();
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "";
}

double goal_of(const std::string& error, const std::string& of) {
  return error_goal(wanted_error(error), wanted_result(of, kColumns), kHistory).error;
}

TEST(WantedError, IsAShareOrAnAmount) {
  EXPECT_DOUBLE_EQ(wanted_error("2%").number, 0.02);
  EXPECT_TRUE(wanted_error("2 %").is_share);
  EXPECT_EQ(wanted_error("0.05 mm").unit, "mm");
  EXPECT_FALSE(wanted_error("0.05 mm").is_share);
}

TEST(WantedError, RefusesWhatIsNeither) {
  for (const char* const text : {"", "little", "0%", "-1 mm", "nan%", "inf mm"})
    EXPECT_EQ(refusal([&] { wanted_error(text); }).rfind("--target-error \"", 0), 0U) << text;
  EXPECT_NE(refusal([] { wanted_error("150%"); }).find("less than 100 %"), std::string::npos);
}

TEST(WantedResult, IsAColumnWithOrWithoutItsUnitOrTheOnlyOneOfAProbe) {
  EXPECT_EQ(wanted_result("tip.position.z [mm]", kColumns).column, "tip.position.z [mm]");
  EXPECT_EQ(wanted_result("plate.force.z", kColumns).column, "plate.force.z [N]");
  EXPECT_EQ(wanted_result("tip", kColumns).column, "tip.position.z [mm]");
  EXPECT_EQ(wanted_result("tip", kColumns).quantity, Quantity::End);
  EXPECT_EQ(wanted_result("plate.force.z:largest", kColumns).quantity, Quantity::Largest);
}

TEST(WantedResult, ThatIsUnknownOrNotClearIsRefusedWithWhatThereIs) {
  const auto asked = [](const std::string& of) {
    return refusal([&] { wanted_result(of, kColumns); });
  };
  EXPECT_EQ(asked("tipp"), "--of \"tipp\": there is no such probe; did you mean `tip`?");
  EXPECT_NE(asked("foot").find("`plate`, `share`, `tip`"), std::string::npos) << asked("foot");
  EXPECT_NE(asked("tip.position.u").find("tip.position.z"), std::string::npos);
  EXPECT_EQ(asked("plate"),
            "--of \"plate\": expected one of its results: plate.force.x, plate.force.z");
  EXPECT_NE(refusal([] { wanted_result("tip", {}); }).find("no [[probe]]"), std::string::npos);
}

// Where zero lies means nothing for a coordinate.
TEST(ErrorGoal, IsAShareOfTheValueAndOfACoordinateOfItsWay) {
  EXPECT_DOUBLE_EQ(goal_of("2%", "plate.force.z"), 0.04);
  EXPECT_DOUBLE_EQ(goal_of("2%", "plate.force.z:largest"), 0.06);
  EXPECT_DOUBLE_EQ(goal_of("2%", "tip.position.z"), 0.08);
}

TEST(ErrorGoal, OfAnAmountIsInTheUnitOfTheColumn) {
  EXPECT_DOUBLE_EQ(goal_of("5 um", "tip.position.z"), 0.005);
  EXPECT_DOUBLE_EQ(goal_of("10 mN", "plate.force.x"), 0.01);
  EXPECT_DOUBLE_EQ(goal_of("0.01", "share:largest"), 0.01);
}

TEST(ErrorGoal, OfNothingIsRefused) {
  const auto asked = [](const std::string& error, const std::string& of) {
    return refusal([&] { goal_of(error, of); });
  };
  EXPECT_NE(asked("2%", "plate.force.x").find("say an amount, such as --target-error \"0.01 N\""),
            std::string::npos)
      << asked("2%", "plate.force.x");
  EXPECT_NE(asked("2%", "share").find("no value"), std::string::npos);
  EXPECT_NE(asked("2 N", "tip").find("`tip.position.z [mm]` is in mm"), std::string::npos);
  EXPECT_NE(asked("2", "tip").find("it needs a unit"), std::string::npos);
  EXPECT_NE(asked("2 furlong", "tip"), "");
  EXPECT_NE(asked("2 mm", "share:largest").find("has no unit"), std::string::npos);
}

}  // namespace articular::tools::wanted_error_test
