// What a track file may say, and what is refused with its place.
#include "tools/track/track_file.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::track_file_test {

const std::string kHead = "scenario = \"jaw.toml\"\n";
const std::string kMuscle = "[[muscle]]\nname = \"l*\"\n";
const std::string kTarget = "[[target]]\ncolumn = \"bite.force.z [N]\"\nvalue = 100\nspread = 1\n";

class TrackFile : public ::testing::Test {
 protected:
  Track read(const std::string& text) const { return read_track(folder_.file("t.toml", text)); }
  /// Without the folder; "" where it is taken.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const sim::InputError& error) {
      std::string message = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (std::size_t at; (at = message.find(folder)) != std::string::npos;)
        message.erase(at, folder.size());
      return message;
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(TrackFile, HasDefaults) {
  const Track track = read(kHead + kMuscle + kTarget);
  EXPECT_EQ(track.scenario, folder_ / "jaw.toml");
  EXPECT_EQ(track.title, "t");
  EXPECT_EQ(track.cost, TrackCost::Squares);
  EXPECT_EQ(track.effort, 0.1);
  EXPECT_FALSE(track.duration || track.interval || track.look_ahead);
  EXPECT_EQ(track.muscles[0].highest, 1);
  EXPECT_FALSE(track.muscles[0].together);
  EXPECT_EQ(track.targets[0].name, "bite.force.z [N]");
  EXPECT_EQ(track.targets[0].value.value, (std::vector<double>{100}));
}

TEST_F(TrackFile, ReadsWhatItSays) {
  const Track track = read(
      "cost = \"cubes\"\neffort = 0.5\nduration = \"1 s\"\ninterval = \"0.1 s\"\n"
      "look_ahead = \"0.2 s\"\nset = { \"integrator.step\" = \"1 ms\" }\n" +
      kHead + kMuscle +
      "together = true\nlowest = 0.1\nhighest = 0.6\nemg = { time = [\"0 s\", \"1 s\"], value = "
      "[0, 0.5] }\nemg_spread = 0.1\n" +
      "[[target]]\nname = \"both\"\ncolumn = [\"a [N]\", \"b [N]\"]\nspread = 2\n"
      "value = { time = [\"0.5 s\", \"1 s\"], value = [0, -20] }\n");
  EXPECT_EQ(track.cost, TrackCost::Cubes);
  EXPECT_EQ(track.effort, 0.5);
  EXPECT_EQ(track.look_ahead, 0.2);
  EXPECT_EQ(track.overrides, (std::vector<std::string>{"integrator.step=\"1 ms\""}));
  EXPECT_TRUE(track.muscles[0].together);
  EXPECT_EQ(track.muscles[0].emg.value, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(track.muscles[0].emg_spread, 0.1);
  EXPECT_EQ(track.targets[0].columns, (std::vector<std::string>{"a [N]", "b [N]"}));
  EXPECT_EQ(track.targets[0].value.time, (std::vector<double>{0.5, 1}));
}

TEST_F(TrackFile, TakesTargetsFromTables) {
  folder_.file("h.csv", "time [s],other [N],bite.force.z [N]\n0,9,1\n0.5,9,2\n");
  const std::string target =
      "[[target]]\ncolumn = \"bite.force.z [N]\"\nfile = \"h.csv\"\nspread = 1\n";
  EXPECT_EQ(read(kHead + kMuscle + target).targets[0].value.value, (std::vector<double>{1, 2}));
  EXPECT_EQ(read(kHead + kMuscle + target + "file_column = \"other [N]\"\n").targets[0].value.value,
            (std::vector<double>{9, 9}));
  EXPECT_EQ(refusal(kHead + kMuscle + target + "file_column = \"othr [N]\"\n"),
            "h.csv:1: no column `othr [N]`; did you mean `other [N]`?");
  folder_.file("ms.csv", "time [ms],bite.force.z [N]\n0,1\n500,2\n");
  std::string in_ms = target;
  in_ms.replace(in_ms.find("h.csv"), 5, "ms.csv");
  EXPECT_EQ(refusal(kHead + kMuscle + in_ms),
            "ms.csv:1: no column `time [s]`, which has the times in seconds");
}

TEST_F(TrackFile, RefusesATableInAnotherUnit) {
  folder_.file("h.csv", "time [s],force [kN],plain,way [mm]\n0,1,2,3\n0.5,1,2,3\n");
  const std::string target =
      "[[target]]\ncolumn = \"bite.force.z [N]\"\nfile = \"h.csv\"\nspread = 1\n";
  const auto with = [&](const std::string& column) {
    return kHead + kMuscle + target + "file_column = \"" + column + "\"\n";
  };
  EXPECT_NE(refusal(with("force [kN]"))
                .find("the file's column is in kN, and `bite.force.z [N]` in N: expected the same"),
            std::string::npos);
  EXPECT_NE(refusal(with("way [mm]")).find("is in mm"), std::string::npos);
  EXPECT_EQ(read(with("plain")).targets[0].value.value, (std::vector<double>{2, 2}));
}

TEST_F(TrackFile, SaysWhatIsWrongAndWhere) {
  const auto expect = [&](const std::string& text, const std::string& message) {
    EXPECT_EQ(refusal(text), message) << text;
  };
  expect("cost = \"power\"\n" + kHead + kMuscle + kTarget,
         "t.toml:1:8: `cost`: expected one of \"squares\", \"cubes\", \"largest\", found "
         "\"power\"");
  expect(kMuscle + kTarget, "t.toml:1:1: track: `scenario` is missing");
  expect(kHead + kTarget, "t.toml:1:1: track: `muscle` is missing");
  expect(kHead + kMuscle, "t.toml:1:1: track: `target` is missing");
  expect(kHead + kMuscle + "lowest = 0.5\nhighest = 0.5\n" + kTarget,
         "t.toml:2:1: `muscle[0]`: expected `lowest` to be less than `highest`");
  expect(kHead + kMuscle + "emg_spread = 0.1\n" + kTarget,
         "t.toml:4:1: [[muscle]]: `emg_spread` does not belong here: it is that of `emg`");
  expect(kHead + kMuscle + "[[target]]\ncolumn = \"a [N]\"\nspread = 1\n",
         "t.toml:4:1: [[target]]: expected `value` or `file`, found none of them");
  expect(kHead + kMuscle + kTarget + "weight = 2\n",
         "t.toml:8:1: [[target]]: unknown key `weight`; expected one of `name`, `column`, `value`, "
         "`file`, `file_column`, `spread`");
}

}  // namespace articular::tools::track_file_test
