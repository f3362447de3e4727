// Excitations from a table, in place of those of the muscles.
#include "sim/scenario/excitation_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::excitation_table_test {

class ExcitationTable : public ScenarioTest {
 protected:
  const std::string scene_ =
      kStart +
      "[[muscle]]\nname = \"pull\"\nmirror = \"x\"\nmax_force = \"1 N\"\nexcitation = { time = "
      "[\"0 s\"], value = [0.5] }\n"
      "path = [{ body = \"skull\", point = \"0.1 0 0 m\" }, { body = \"mandible\", point = \"0.1 0 "
      "1 m\" }]\n";
  const std::string table_ = "[excitations]\nfile = \"e.csv\"\n";

  std::string refusal_of(const std::string& csv) const {
    write("e.csv", csv);
    return refusal(scene_ + table_);
  }
};

TEST_F(ExcitationTable, ReplacesThoseOfItsMusclesAndNoOthers) {
  write("e.csv", "pull_right,time [s]\n0,0\n0.25,0.1\n");
  const Scenario scenario = read(scene_ + table_);
  EXPECT_EQ(scenario.muscles[0].excitation.value, (std::vector<double>{0.5}));
  EXPECT_EQ(scenario.muscles[1].excitation.time, (std::vector<double>{0, 0.1}));
  EXPECT_EQ(scenario.muscles[1].excitation.value, (std::vector<double>{0, 0.25}));
}

TEST_F(ExcitationTable, ChangesAfterTheEndOfTheRunAreTold) {
  const auto doubts = [&](const std::string& csv, const std::vector<std::string>& overrides = {}) {
    write("e.csv", csv);
    return read(scene_ + table_, overrides).doubts;
  };
  EXPECT_TRUE(doubts("pull_left,time [s]\n0,0\n0.25,100\n", {"duration=1 s"}).empty());
  const std::vector<std::string> late = doubts("pull_left,time [s]\n0,0\n0.25,100\n");
  ASSERT_EQ(late.size(), 1U);
  EXPECT_NE(late[0].find("the excitation of `pull_left` changes until 100 s, and the run ends at"),
            std::string::npos)
      << late[0];
  EXPECT_TRUE(doubts("pull_left,time [s]\n0.25,0\n0.25,100\n").empty());
  // Excitations of the scenario's own are told at their place, and not as the table's.
  std::string own = scene_;
  own.replace(own.find("[\"0 s\"], value = [0.5]"), 23, "[\"0 s\", \"90 s\"], value = [0, 1]");
  const std::vector<std::string> told = read(own + table_).doubts;
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].find("the excitation of"), std::string::npos) << told[0];
}

TEST_F(ExcitationTable, CanBeGivenByAnOverride) {
  const std::string file = write("e.csv", "time [s],pull_left\n0,1\n").string();
  const Scenario scenario = read(scene_, {"excitations.file=" + file});
  EXPECT_EQ(scenario.muscles[0].excitation.value, (std::vector<double>{1}));
  const auto& files = scenario.files;  // of which results keep record
  EXPECT_NE(std::find(files.begin(), files.end(), file), files.end());
}

TEST_F(ExcitationTable, SaysWhatIsWrongAndWhere) {
  const auto expect = [&](const std::string& csv, const std::string& message) {
    EXPECT_EQ(refusal_of(csv), message);
  };
  expect("time [s],pull_lift\n0,1\n",
         "e.csv:1: column \"pull_lift\": the scenario has no such muscle; did you mean "
         "`pull_left`?");
  expect("pull_left\n1\n", "e.csv:1: expected a column \"time [s]\"");
  expect("time [s],pull_left,pull_left\n0,1,1\n", "e.csv:1: column \"pull_left\" appears twice");
  expect("time [s],pull_left\n0,1\n0,1\n", "e.csv:3: times must increase, found 0 s after 0 s");
  expect("time [s],pull_left\n0,1.5\n",
         "e.csv:2: column `pull_left`: an excitation must lie between 0 and 1, found 1.5");
  expect("time [s],pull_left\n", "e.csv: the table of excitations has no rows");
}

TEST_F(ExcitationTable, HasToBeThere) {
  EXPECT_NE(refusal(scene_ + table_).find("jaw.toml:28:8: cannot read the table of excitations"),
            std::string::npos)
      << refusal(scene_ + table_);
}

}  // namespace articular::sim::excitation_table_test
