// Loads that a hold takes, and angles that it keeps.
#include "sim/build/hold_doubts.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::hold_doubts_test {

/// What is doubted of a bar that is held at 0, with entries.
std::vector<std::string> doubts_of(const std::string& freedoms, const std::string& entries) {
  const TemporaryFolder folder;
  return build_model(read_scenario(folder.file("held.toml", R"(duration = "1 s"
contact = false
[[body]]
name = "bar"
kind = "rigid"
density = "1 g/cm^3"
geometry = { box = { size = "20 4 4 mm", cells = [4, 1, 1] } }
hold = { freedoms = [)" + freedoms + R"(], at = "0 0 0 mm" }
)" + entries)))
      .warnings;
}

std::string force(const std::string& newtons, const std::string& millimetres) {
  return "[[load]]\nkind = \"force\"\nbody = \"bar\"\nforce = \"" + newtons + " N\"\npoint = \"" +
         millimetres + " mm\"\n";
}

std::string moment(const std::string& value) {
  return "[[load]]\nkind = \"moment\"\nbody = \"bar\"\nmoment = \"" + value + " N m\"\n";
}

std::string angle(const std::string& axis) {
  return "[[probe]]\nname = \"turn\"\nkind = \"angle\"\nbody = \"bar\"\naxis = [" + axis + "]\n";
}

const std::string kShifts = R"("translation.x", "translation.y", "translation.z")";
const std::string kHinge = kShifts + R"(, "rotation.x", "rotation.z")";  // free about y
const std::string kBall = kShifts;
const std::string kSlider =
    R"("translation.y", "translation.z", "rotation.x", "rotation.y", "rotation.z")";

struct Case {
  const char* name;
  std::string freedoms, entry;
  bool doubted;
};

TEST(HoldDoubts, AreOfWhatCanNeverMoveTheBody) {
  for (const auto& [name, freedoms, entry, doubted] : {
           Case{"along the hinge", kHinge, force("0 1 0", "10 0 0"), true},
           Case{"at the hinge", kHinge, force("1 0 1", "0 2 0"), true},
           Case{"across it", kHinge, force("0 0 1", "10 0 0"), false},
           Case{"askew to it", kHinge, force("0 5 0.01", "10 0 0"), false},
           Case{"through it at first, as it hangs", kHinge, force("1 0 0", "10 0 0"), false},
           Case{"about a held axis", kHinge, moment("0 0 1"), true},
           Case{"about both", kHinge, moment("0 1 1"), false},
           Case{"at the middle of a ball joint", kBall, force("1 2 3", "0 0 0"), true},
           Case{"beside it", kBall, force("1 2 3", "0 0 1"), false},
           Case{"a moment on a ball joint", kBall, moment("0 0 1"), false},
           Case{"across a slider", kSlider, force("0 1 1", "10 2 0"), true},
           Case{"along it", kSlider, force("1 1 1", "10 2 0"), false},
           Case{"a moment on a slider", kSlider, moment("1 0 0"), true},
       }) {
    const std::vector<std::string> doubts = doubts_of(freedoms, entry);
    EXPECT_EQ(doubts.size(), doubted ? 1U : 0U) << name;
    if (!doubts.empty()) {
      EXPECT_NE(doubts[0].find("taken by its `hold`"), std::string::npos) << doubts[0];
    }
  }
}

// A moment of the ground on a shank that also carries a weight is there for the hip's reaction.
TEST(HoldDoubts, AreNotOfOneLoadOfSeveralThatAReactionTellsOf) {
  const std::string reaction = "[[probe]]\nname = \"grip\"\nkind = \"reaction\"\nbody = \"bar\"\n";
  const std::string weight = force("0 0 -1", "10 0 0"), twist = moment("0 0 1");
  EXPECT_TRUE(doubts_of(kHinge, reaction + weight + twist).empty());
  EXPECT_EQ(doubts_of(kHinge, weight + twist).size(), 1U);
  EXPECT_EQ(doubts_of(kHinge, reaction + twist).size(), 1U);
  EXPECT_EQ(doubts_of(kHinge, reaction + twist + force("0 1 0", "10 0 0")).size(), 2U);
}

TEST(HoldDoubts, AreOfAnglesAboutAxesThatAreHeld) {
  for (const auto& [axis, doubted] : {std::pair("1, 0, 0", true), std::pair("1, 0, 2", true),
                                      std::pair("0, 1, 0", false), std::pair("0, 0.1, 1", false)}) {
    const std::vector<std::string> doubts = doubts_of(kHinge, angle(axis));
    EXPECT_EQ(doubts.size(), doubted ? 1U : 0U) << axis;
    if (!doubts.empty()) {
      EXPECT_NE(doubts[0].find("can't turn about this axis"), std::string::npos) << doubts[0];
    }
  }
  EXPECT_EQ(doubts_of(kBall, angle("1, 0, 0")).size(), 0U);
}

}  // namespace articular::sim::hold_doubts_test
