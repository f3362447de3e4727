// `articular track` as a user runs it. Twins: what a scenario does with known excitations is
// tracked, and these are found again.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "tests/tools/support/number_columns.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::track_test {

const std::string kScene = ARTICULAR_SOURCE_DIR "/scenarios/verification/three_muscles.toml";

/// The scene's own excitations, which are the first guess, would be those of the twin.
const std::string kNoGuess =
    "\"muscle.pull_y.excitation\" = { time = [\"0 s\"], value = [0] }, "
    "\"muscle.pull_z.excitation\" = { time = [\"0 s\"], value = [0] }";
const std::string kStatic = "set = { " + kNoGuess + " }\n";

const std::string kTargets =
    "[[target]]\ncolumn = \"bone.position.y [mm]\"\nfile = \"twin/history.csv\"\nspread = 0.01\n"
    "[[target]]\ncolumn = \"bone.position.z [mm]\"\nfile = \"twin/history.csv\"\nspread = 0.01\n";
const std::string kTwoMuscles = "[[muscle]]\nname = \"pull_*\"\n";

class TrackTest : public ::testing::Test {
 protected:
  ProgramResult program(const std::string& arguments) const {
    return run_program(folder_, arguments + " --quiet");
  }
  /// Runs the scene as it is: in `twin`.
  void make_twin(const std::string& settings = "") const {
    const ProgramResult run = program("run '" + kScene + "' --out twin " + settings);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  ProgramResult track(const std::string& text, const std::string& more = "") const {
    folder_.file("t.toml", "scenario = \"" + kScene + "\"\n" + text);
    return program("track t.toml " + more);
  }

  TemporaryFolder folder_;
};

using Track = TrackTest;

TEST_F(Track, FindsTheExcitationsOfATwinAgain) {
  make_twin();
  const ProgramResult result = track(kStatic + kTwoMuscles + kTargets);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "out/t/track.md\nout/t/excitations.csv\nout/t/excitations.txt\nout/t/targets.csv\n"
            "out/t/muscles.csv\n");
  auto found = columns(folder_ / "out/t/excitations.csv");
  EXPECT_EQ(found["time [s]"], (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  const std::vector<double> y{0, 0.3, 0.6, 0.4, 0.2}, z{0, 0.1, 0.2, 0.3, 0.4};
  for (std::size_t k = 0; k < y.size(); ++k) {
    EXPECT_NEAR(found["pull_y"][k], y[k], 1e-4);
    EXPECT_NEAR(found["pull_z"][k], z[k], 1e-4);
  }
  const std::string text = content(folder_ / "out/t/track.md");
  EXPECT_NE(text.find("determined |"), std::string::npos) << text;
  EXPECT_EQ(text.find("not determined"), std::string::npos) << text;

  // What was found runs, and does what the twin did.
  const ProgramResult again =
      program("run '" + kScene + "' --set @out/t/excitations.txt --out again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto wanted = columns(folder_ / "twin/history.csv"),
             got = columns(folder_ / "again/history.csv");
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(got.at("bone.position.y [mm]")[k], wanted.at("bone.position.y [mm]")[k], 1e-4);
}

// A trial leaves no trace in the food that it pressed on: the next one begins where the interval
// did.
TEST_F(Track, FindsATwinThatCrushesFoodAndLetsGo) {
  folder_.file("food.toml", content(kScene) + R"(
[[bolus]]
name = "nut"
path = [{ body = "frame", point = "0 60 0 mm" }, { body = "bone", point = "0 0 0 mm" }]
depth = ["0 mm", "0.5 mm", "4 mm"]
force = ["0 N", "2 N", "4 N"]
unloading_stiffness = "20 N/mm"
[[probe]]
name = "nut"
kind = "line"
line = "nut"
)");
  ASSERT_EQ(program("run food.toml --out twin").exit_code, 0);
  folder_.file("t.toml", "scenario = \"food.toml\"\n" + kStatic + kTwoMuscles + kTargets);
  const ProgramResult result = program("track t.toml");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto found = columns(folder_ / "out/t/excitations.csv");
  const std::vector<double> y{0, 0.3, 0.6, 0.4, 0.2}, z{0, 0.1, 0.2, 0.3, 0.4};
  for (std::size_t k = 0; k < y.size(); ++k) {
    EXPECT_NEAR(found.at("pull_y")[k], y[k], 1e-3) << k;
    EXPECT_NEAR(found.at("pull_z")[k], z[k], 1e-3) << k;
  }
  ASSERT_EQ(program("run food.toml --set @out/t/excitations.txt --out again").exit_code, 0);
  const auto wanted = columns(folder_ / "twin/history.csv"),
             got = columns(folder_ / "again/history.csv");
  EXPECT_NEAR(got.at("nut.deepest [mm]").back(), wanted.at("nut.deepest [mm]").back(), 1e-2);
  EXPECT_GT(wanted.at("nut.deepest [mm]").back(), 1);
  EXPECT_EQ(wanted.at("nut.force [N]").back(), 0);  // it was let go
}

// The bone can't move along x.
TEST_F(Track, DoesNotSayThatItFoundWhatNoMuscleMoves) {
  make_twin();
  const ProgramResult result =
      track(kStatic + kTwoMuscles +
            "[[target]]\ncolumn = \"bone.position.x [mm]\"\nvalue = 1\nspread = 0.01\n");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(content(folder_ / "out/t/track.md").find("not converged"), std::string::npos);
}

// Three muscles for two freedoms: which share is whose, targets do not say.
TEST_F(Track, SaysWhatTargetsDoNotDetermine) {
  make_twin();
  ASSERT_EQ(track(kStatic + "[[muscle]]\nname = \"*\"\n" + kTargets).exit_code, 0);
  auto muscles = columns(folder_ / "out/t/excitations.csv");
  // The third helps: squares are least where it takes part.
  EXPECT_GT(muscles["aslant"][4], 0.1);
  EXPECT_LT(muscles["pull_z"][4], 0.35);
  const std::string text = content(folder_ / "out/t/track.md");
  EXPECT_NE(text.find("2 of 3"), std::string::npos) << text;
  EXPECT_NE(text.find("in part"), std::string::npos) << text;
  // The way is met all the same.
  EXPECT_NE(text.find("| 1 s | 0.0"), std::string::npos) << text;
}

TEST_F(Track, EmgDecidesWhereMotionDoesNot) {
  make_twin();
  ASSERT_EQ(track(kStatic + "[[muscle]]\nname = \"aslant\"\nemg = 0\nemg_spread = 0.01\n" +
                  kTwoMuscles + kTargets)
                .exit_code,
            0);
  auto found = columns(folder_ / "out/t/excitations.csv");
  EXPECT_NEAR(found["pull_y"][2], 0.6, 2e-3);
  EXPECT_NEAR(found["pull_z"][4], 0.4, 2e-3);
}

// A force is a target like any other. pull_y alone has 3 N where it has them.
TEST_F(Track, MeetsForces) {
  ASSERT_EQ(
      track(kStatic + "duration = \"0.5 s\"\n[[muscle]]\nname = \"pull_y\"\n[[target]]\ncolumn = "
                      "\"pull_y.force [N]\"\nvalue = 3\nspread = 0.01\n")
          .exit_code,
      0);
  const std::string targets = content(folder_ / "out/t/targets.csv");
  const std::string row = "0.5,pull_y.force [N],N,3,";
  const std::size_t at = targets.find(row);
  ASSERT_NE(at, std::string::npos) << targets;
  EXPECT_NEAR(std::stod(targets.substr(at + row.size())), 3, 1e-4);
}

TEST_F(Track, BoundsHoldAndAreTold) {
  make_twin();
  ASSERT_EQ(track(kStatic +
                  "[[muscle]]\nname = \"pull_y\"\nhighest = 0.5\n[[muscle]]\nname = \"pull_z\"\n" +
                  kTargets)
                .exit_code,
            0);
  auto found = columns(folder_ / "out/t/excitations.csv");
  EXPECT_EQ(found["pull_y"][2], 0.5);
  const std::string text = content(folder_ / "out/t/track.md");
  EXPECT_NE(text.find("`pull_y` | 0.5000, at its highest"), std::string::npos) << text;
}

TEST_F(Track, MusclesTogetherHaveOneExcitation) {
  ASSERT_EQ(track(kStatic + "[[muscle]]\nname = \"pull_*\"\ntogether = true\n[[target]]\ncolumn = "
                            "\"bone.position.y [mm]\"\nvalue = 1\nspread = 0.01\n")
                .exit_code,
            0);
  auto found = columns(folder_ / "out/t/excitations.csv");
  EXPECT_GT(found["pull_y"][4], 0.1);
  EXPECT_EQ(found["pull_y"], found["pull_z"]);
}

// Two targets ask for forces that are 20 spreads apart at the end, of a muscle that was silent.
TEST_F(Track, SaysWhichTargetsItMissesAndWhenMost) {
  const ProgramResult result =
      track(kStatic +
            "duration = \"0.5 s\"\n[[muscle]]\nname = \"pull_y\"\nemg = 0\nemg_spread = "
            "0.05\n[[target]]\ncolumn = \"pull_y.force [N]\"\nvalue = 3\nspread = 0.01\n"
            "[[target]]\nname = \"other\"\ncolumn = \"pull_y.force [N]\"\nvalue = { time = "
            "[\"0 s\", \"0.5 s\"], value = [3, 3.2] }\nspread = 0.01\n");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.rfind("articular: warning: missed: ", 0), 0u) << result.err;
  EXPECT_NE(result.err.find("`pull_y.force [N]` at 0.5 s by "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("`other` at 0.5 s by -"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("EMG of `pull_y` at "), std::string::npos) << result.err;
  EXPECT_NE(content(folder_ / "out/t/track.md").find("\n**Missed**: "), std::string::npos);
}

// `run` warns of muscles that nothing excites; here they are what is sought.
TEST_F(Track, DoesNotMissExcitationsThatItFinds) {
  make_twin();
  std::istringstream scene(content(kScene));
  std::string silent;
  for (std::string line; std::getline(scene, line);)
    if (line.rfind("excitation", 0) != 0) silent += line + "\n";
  folder_.file("silent.toml", silent);
  folder_.file("t.toml", "scenario = \"silent.toml\"\n[[muscle]]\nname = \"*\"\n" + kTargets);
  const ProgramResult track = program("track t.toml");
  EXPECT_EQ(track.exit_code, 0);
  EXPECT_EQ(track.err.find("excitation"), std::string::npos) << track.err;
  const ProgramResult run = program("run silent.toml --out silent");
  EXPECT_NE(run.err.find("no muscle of the scene has an `excitation`"), std::string::npos)
      << run.err;
}

// All excitations would be nil, and nothing missed.
TEST_F(Track, RefusesATargetThatBeginsWhenTheRunIsOver) {
  make_twin();
  const ProgramResult late =
      track(kStatic + kTwoMuscles + kTargets +
            "[[target]]\nname = \"late\"\ncolumn = \"bone.position.y [mm]\"\nspread = 1\n"
            "value = { time = [\"90 s\", \"91 s\"], value = [1, 2] }\n");
  EXPECT_EQ(late.exit_code, 2);
  EXPECT_NE(late.err.find("target `late` begins at 90 s, when the run of "), std::string::npos)
      << late.err;
}

TEST_F(Track, RefusesATargetThatCountsAtNoTime) {
  const auto with = [&](const std::string& times) {
    return track(kStatic + kTwoMuscles +
                 "[[target]]\nname = \"way\"\ncolumn = \"bone.position.y [mm]\"\nspread = 1\n"
                 "value = { time = [" +
                 times + "], value = [0, 0.1] }\n");
  };
  const ProgramResult between = with("\"0 s\", \"0.2 s\"");  // excitations are found every 0.25 s
  EXPECT_EQ(between.exit_code, 2);
  EXPECT_NE(between.err.find("target `way` counts from 0 to 0.2 s, and excitations are found every "
                             "0.25 s: at none of these times"),
            std::string::npos)
      << between.err;
  EXPECT_EQ(with("\"0.2 s\", \"0.3 s\"").exit_code, 0);
  const ProgramResult late = with("\"0 s\", \"90 s\"");
  EXPECT_EQ(late.exit_code, 0) << late.err;
  EXPECT_NE(late.err.find("target `way` changes until 90 s, and the run ends at 1 s"),
            std::string::npos)
      << late.err;
}

// Three tenths of a second are 0.30000000000000004 in binary.
TEST_F(Track, TimesOfTheTableHaveNoRoundOff) {
  make_twin();
  const ProgramResult result = track("duration = \"0.4 s\"\ninterval = \"0.1 s\"\nset = { " +
                                     kNoGuess + " }\n" + kTwoMuscles + kTargets);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(content(folder_ / "out/t/excitations.csv").find("\n0.3,"), std::string::npos)
      << content(folder_ / "out/t/excitations.csv");
}

/// Moves in time, for a tenth of a second.
const std::string kInTime =
    "set = { analysis = \"dynamic\", duration = \"0.1 s\", \"integrator.step\" = \"1 ms\", "
    "\"integrator.position_tolerance\" = \"1e-6 um\", \"output.interval\" = \"10 ms\", " +
    kNoGuess + " }\n";
const std::string kSetInTime =
    "--set analysis=dynamic --set duration='0.1 s' --set integrator.step='1 ms' --set "
    "integrator.position_tolerance='1e-6 um' --set output.interval='10 ms' ";

double rise_and_fall(double part) { return part < 0.5 ? 1.2 * part : 1 - 0.8 * part; }

const std::string kTwinInTime =
    kSetInTime +
    "--set muscle.pull_y.excitation='{ time = [\"0 s\", \"50 ms\", \"0.1 s\"], value = [0, 0.6, "
    "0.2] "
    "}' --set muscle.pull_z.excitation='{ time = [\"0 s\", \"0.1 s\"], value = [0, 0.4] }'";

// In time, with activation dynamics and inertia between excitation and motion. Without looking
// ahead a twin is found, but what the iteration leaves (3e-3 of the sum) grows three- to fourfold
// from one interval to the next: four of them show it.
TEST_F(Track, FindsTheExcitationsOfATwinInTime) {
  make_twin(kTwinInTime);
  const ProgramResult result =
      track("look_ahead = \"1 ms\"\nduration = \"50 ms\"\n" + kInTime + kTwoMuscles + kTargets);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto found = columns(folder_ / "out/t/excitations.csv");
  ASSERT_EQ(found["pull_y"].size(), 6u);
  for (std::size_t k = 1; k <= 4; ++k) {
    const double part = 0.1 * static_cast<double>(k);
    EXPECT_NEAR(found["pull_y"][k], rise_and_fall(part), 2e-3) << k;
    EXPECT_NEAR(found["pull_z"][k], 0.4 * part, 2e-3) << k;
  }
}

// With a look ahead of an interval it is calm.
TEST_F(Track, LookingAheadFollowsATwinInTime) {
  make_twin(kTwinInTime);
  const ProgramResult result = track(kInTime + kTwoMuscles + kTargets);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto found = columns(folder_ / "out/t/excitations.csv");
  for (std::size_t k = 1; k <= 10; ++k) {
    const double part = 0.1 * static_cast<double>(k);
    EXPECT_NEAR(found["pull_y"][k], rise_and_fall(part), 0.1) << k;
    EXPECT_NEAR(found["pull_z"][k], 0.4 * part, 0.1) << k;
  }
  const ProgramResult again =
      program("run '" + kScene + "' --set @out/t/excitations.txt --out again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto wanted = columns(folder_ / "twin/history.csv").at("bone.position.y [mm]"),
             got = columns(folder_ / "again/history.csv").at("bone.position.y [mm]");
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(got[k], wanted[k], 0.05) << k;
}

/// The block of TOML behind a sentence of a page.
std::string block_after(const std::string& page, const std::string& sentence) {
  const std::size_t begin = page.find("```toml\n", page.find(sentence)) + 8;
  return page.substr(begin, page.find("```", begin) - begin);
}

// From the top of the tree, as the page says.
TEST_F(Track, DoesTheExampleOfItsPage) {
  const std::string page = content(ARTICULAR_SOURCE_DIR "/tools/track/README.md");
  std::filesystem::create_directory_symlink(ARTICULAR_SOURCE_DIR "/scenarios",
                                            folder_ / "scenarios");
  folder_.file("bone.toml", block_after(page, "A track file looks like this"));
  ASSERT_EQ(program("run scenarios/verification/three_muscles.toml --out out/known").exit_code, 0);
  const ProgramResult result = program("track bone.toml");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto found = columns(folder_ / "out/bone/excitations.csv");
  EXPECT_NEAR(found["pull_y"][2], 0.6, 5e-3);
  EXPECT_NEAR(found["pull_z"][4], 0.4, 5e-3);
}

// What the command sets stands in what it writes for `run`.
TEST_F(Track, WritesWhatItsCommandSets) {
  ASSERT_EQ(track(kStatic + kTwoMuscles +
                      "[[target]]\ncolumn = \"bone.position.y [mm]\"\nvalue = 1\nspread = 0.01\n",
                  "--set duration='0.5 s'")
                .exit_code,
            0);
  EXPECT_NE(content(folder_ / "out/t/excitations.txt").find("\nduration=0.5 s\n"),
            std::string::npos);
}

TEST_F(Track, SaysWhatIsWrongAndWhere) {
  const auto refused = [&](const std::string& text, const std::string& message) {
    const ProgramResult result = track(text);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
  };
  const std::string target =
      "[[target]]\ncolumn = \"bone.position.y [mm]\"\nvalue = 1\nspread = 0.01\n";
  refused("[[muscle]]\nname = \"pul_y\"\n" + target,
          "t.toml:2:1: the scenario has no muscle `pul_y` that an entry before does not name; did "
          "you mean `pull_y`?");
  refused(kTwoMuscles + "[[target]]\ncolumn = \"bone.position.w [mm]\"\nvalue = 1\nspread = 0.01\n",
          "t.toml:4:1: no probe of the scenario shows `bone.position.w [mm]`");
  refused("look_ahead = \"1 s\"\n" + kTwoMuscles + target, "`look_ahead` is for dynamic scenarios");
}

}  // namespace articular::track_test
