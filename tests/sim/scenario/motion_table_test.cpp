// Recorded motions in files.
#include "sim/scenario/motion_table.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/scenario/driven_motion.hpp"
#include "tests/sim/support/readable_line.hpp"
#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::motion_table_test {

constexpr double kDegree = std::numbers::pi / 180;

class RecordedMotion : public ScenarioTest {
 protected:
  /// A rigid body that is held whole, and driven by a file of this text.
  std::string scenario(const std::string& table, const std::string& more = "") const {
    write("motion.csv", table);
    return "duration = \"1 s\"\n[[body]]\nname = \"femur\"\nkind = \"rigid\"\nmass = \"1 kg\"\n"
           "geometry = { box = { size = \"1 1 1 cm\", cells = [1, 1, 1] } }\n"
           "hold = { freedoms = [\"translation.x\", \"translation.y\", \"translation.z\", "
           "\"rotation.x\", \"rotation.z\"] }\n"
           "[[load]]\nkind = \"motion\"\nbody = \"femur\"\nfile = \"motion.csv\"\n" +
           more;
  }
  Motion motion(const std::string& table, const std::string& more = "") const {
    return std::get<MotionLoad>(read(scenario(table, more)).loads.at(0)).motion;
  }
  void expect_refused(const std::string& table, const std::string& message,
                      const std::string& more = "") const {
    const std::string found = refusal(scenario(table, more));
    EXPECT_NE(found.find(message), std::string::npos) << found;
  }
};

TEST_F(RecordedMotion, IsReadByTheNamesAndUnitsOfItsColumns) {
  const Motion read = motion(
      "rotation.x [deg], time [ms],translation.z [mm]\n0,0,0\n10, 500, -2\n\n20,1000,-1\r\n");
  EXPECT_EQ(read.time, (std::vector<double>{0, 0.5, 1}));
  ASSERT_EQ(read.translation.size(), 3u);
  EXPECT_LT((read.translation[1] - Vec3(0, 0, -2e-3)).norm(), 1e-18);
  EXPECT_LT((read.rotation[2] - Vec3(20 * kDegree, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(read.interpolation, Motion::Interpolation::Spline);
  EXPECT_EQ(read.ends, Motion::Ends::Rest);
  EXPECT_EQ(read.translation_bend.size(), 3u);
}

TEST_F(RecordedMotion, WithoutTurnsHasNone) {
  const Motion read = motion("time [s],translation.y [cm]\n0,0\n1,2\n2,3\n", "ends = \"moving\"\n");
  EXPECT_TRUE(read.rotation.empty());
  EXPECT_EQ(read.ends, Motion::Ends::Moving);
  EXPECT_DOUBLE_EQ(read.translation[1].y(), 0.02);
}

TEST_F(RecordedMotion, WithMistakesIsRefusedAtItsLine) {
  const std::string head = "time [s],translation.x [mm]\n";
  expect_refused(head + "0,0\n0.2,1\n0.2,2\n",
                 "motion.csv:4: times must increase, found 0.2 s after 0.2 s");
  expect_refused("translation.x [mm]\n0\n1\n2\n", "motion.csv:1: column `time` is missing");
  expect_refused("time [s]\n0\n1\n2\n", "motion.csv:1: no column moves anything");
  expect_refused(
      "time [s],translaton.x [mm]\n0,0\n1,1\n2,2\n",
      "motion.csv:1: unknown column \"translaton.x [mm]\"; did you mean `translation.x`?");
  expect_refused("time [s],translation.x\n0,0\n1,1\n2,2\n",
                 "column \"translation.x\" has no unit: expected \"translation.x [mm]\"");
  expect_refused("time [s],translation.x [deg]\n0,0\n1,1\n2,2\n",
                 "column \"translation.x [deg]\": expected the unit of a length such as \"mm\"");
  expect_refused("time [s],time [ms],translation.x [mm]\n0,0,0\n1,1,1\n2,2,2\n",
                 "column \"time [ms]\" appears twice");
  expect_refused(head + "0,0\n1,one\n2,2\n",
                 "motion.csv:3: column `translation.x [mm]`: expected a number, found \"one\"");
  expect_refused(head + "0,0\n1\n2,2\n", "motion.csv:3: expected 2 fields as in the first line");
  expect_refused(head + "0,0\n1,1\n", "`file`: a spline needs 3 samples or more, found 2");
  expect_refused(head, "the motion has no rows");
  expect_refused(head + "0,1\n1,2\n2,3\n", "body `femur` starts where its mesh is");
  expect_refused("time [s],rotation.y [deg]\n0,0\n1,2\n2,3\n",
                 "motion.csv:3: rotation: drives `rotation.y`, which `hold` of body `femur` leaves "
                 "free");
  expect_refused("time [s],rotation.x [deg]\n0,0\n1,179\n2,-179\n",
                 "motion.csv:4: rotation: the rotation vector changes by 358 deg");
  expect_refused(head + "0,0\n1,1\n2,2\n",
                 "`interpolation` \"linear\"; expected \"smooth\" or \"spline\"",
                 "interpolation = \"linear\"\n");
  expect_refused(head + "0,0\n1,1\n2,2\n", "`ends` does not belong here: only a spline",
                 "interpolation = \"smooth\"\nends = \"rest\"\n");
  expect_refused(head + "0,0\n1,1\n2,2\n", "`time` does not belong here: the samples are those",
                 "time = [\"0 s\", \"1 s\"]\n");
}

TEST_F(RecordedMotion, ThatCannotBeReadIsRefusedWhereItIsNamed) {
  const std::string text = scenario("time [s],translation.x [mm]\n0,0\n1,1\n2,2\n");
  std::filesystem::remove(folder_ / "motion.csv");
  EXPECT_NE(refusal(text).find("jaw.toml:11"), std::string::npos) << refusal(text);
}

// A device may have no end.
TEST_F(RecordedMotion, IsNoDevice) {
  const std::string text = scenario("time [s],translation.x [mm]\n0,0\n1,1\n2,2\n");
  std::filesystem::remove(folder_ / "motion.csv");
  std::filesystem::create_symlink("/dev/zero", folder_ / "motion.csv");
  EXPECT_NE(refusal(text).find("motion.csv: it is no regular file"), std::string::npos)
      << refusal(text);
}

TEST_F(RecordedMotion, IsRefusedInOneReadableLineWhateverItHolds) {
  for (const std::string table :
       {"time\x01 [s],translation.x [mm]\n0,0\n", "time [s\x01],translation.x [mm]\n0,0\n",
        "time\t [s],translation.x [mm]\nno,0\n"}) {
    const std::string message = refusal(scenario(table));
    EXPECT_TRUE(is_readable_line(message)) << message;
  }
}

}  // namespace articular::sim::motion_table_test
