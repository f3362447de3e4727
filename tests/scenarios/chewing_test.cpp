// The jaw of scenarios/mandible/ chews on a bolus between the left molars.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/scenarios/coarse_jaw.hpp"
#include "tests/tools/support/number_columns.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::chewing_test {

constexpr double kCycle = 0.8;  // [s]

/// Two cycles with coarse discs and steps; the second begins on the bolus, as all that follow.
ScenarioResults chew() {
  return coarse_jaw("chewing.toml", {"accuracy=fast", "integrator.step=5 ms",
                                     "output.interval=50 ms", "duration=1.6 s"});
}

/// Where the incisor is, to the left, at this height on its way down or up in the second cycle.
double sideways_at(const ScenarioResults& results, double height, bool opening) {
  const auto& time = results.column("time [s]");
  const auto& x = results.column("incisor.position.x [mm]");
  const auto& z = results.column("incisor.position.z [mm]");
  for (std::size_t i = 1; i < time.size(); ++i)
    if (time[i] > kCycle &&
        (opening ? z[i - 1] > height && z[i] <= height : z[i - 1] < height && z[i] >= height))
      return x[i];
  throw std::out_of_range("the incisor is never at this height");
}

// Published of a simulated chew on the left: 20 mm down and 6 mm to the side of the bolus.
TEST(JawChewing, TheCycleSwingsToTheSideOfTheBolusWhileTheMouthCloses) {
  const ScenarioResults results = chew();
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const auto& z = results.column("incisor.position.z [mm]");
  const double lowest = *std::min_element(z.begin(), z.end());
  EXPECT_GT(z.front() - lowest, 15);
  EXPECT_LT(z.front() - lowest, 30);
  const double middle = 0.5 * (lowest + results.at("incisor.position.z [mm]", kCycle));
  EXPECT_GT(sideways_at(results, middle, false), sideways_at(results, middle, true) + 2);
  EXPECT_GT(results.largest("incisor.position.x [mm]"), 4);
  EXPECT_LT(results.largest("incisor.position.x [mm]"), 10);
  EXPECT_GT(results.largest("bite.force.z [N]"), 30);

  // The cycle closes, and the condyle of the working side is back first.
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string column = "incisor.position." + axis + " [mm]";
    EXPECT_NEAR(results.last(column), results.at(column, kCycle), 0.5) << axis;
  }
  EXPECT_GT(results.at("condyle_left.position.y [mm]", kCycle + 0.38),
            results.at("condyle_right.position.y [mm]", kCycle + 0.38) + 2);
}

/// On a piece of carrot, bone on bone, on the left or on the right.
ScenarioResults chew_carrot(const std::string& duration, bool on_the_right) {
  sim::Scenario scenario =
      shipped_scenario("mandible/chewing.toml",
                       {"choice.bolus=carrot", "choice.disc=none", "accuracy=fast",
                        "integrator.step=5 ms", "output.interval=50 ms", "duration=" + duration});
  if (!on_the_right) return run_scenario(scenario);
  for (sim::Anchor& anchor : scenario.boluses.at(0).path) anchor.point.x() *= -1;
  std::map<std::string, sim::Curve> excitations;
  for (const sim::Muscle& muscle : scenario.muscles) excitations[muscle.name] = muscle.excitation;
  for (sim::Muscle& muscle : scenario.muscles)
    muscle.excitation = excitations.at((muscle.name[0] == 'l' ? 'r' : 'l') + muscle.name.substr(1));
  return run_scenario(scenario);
}

TEST(JawChewing, ACarrotBreaksStaysCrushedAndIsCrushedFurtherByTheNextChew) {
  const ScenarioResults results = chew_carrot("1.6 s", false);
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const auto& time = results.column("time [s]");
  const auto& depth = results.column("bite.depth [mm]");
  const auto& force = results.column("bite.force [N]");
  double at_rupture = 0;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] < kCycle && depth[i] > 0.5 && depth[i] < 2.5)
      at_rupture = std::max(at_rupture, force[i]);
  EXPECT_GT(at_rupture, 40);
  EXPECT_LE(at_rupture, 66);
  EXPECT_GT(results.largest("bite.force [N]"), 80);
  EXPECT_GT(results.last("bite.deepest [mm]"), results.at("bite.deepest [mm]", kCycle) + 0.3);
  EXPECT_LT(results.last("bite.deepest [mm]"), 8);
  EXPECT_NEAR(results.at("bite.strength [-]", kCycle + 0.2), 0.7, 1e-12);
  EXPECT_GT(results.last("energy.bolus_loss [J]"), results.at("energy.bolus_loss [J]", kCycle));
}

TEST(JawChewing, AChewOnTheRightIsTheMirrorImage) {
  const ScenarioResults left = chew_carrot("0.8 s", false), right = chew_carrot("0.8 s", true);
  for (const char* axis : {"x", "y", "z"}) {
    const std::string column = std::string("incisor.position.") + axis + " [mm]";
    const double sign = axis[0] == 'x' ? -1 : 1;
    for (std::size_t i = 0; i < left.column(column).size(); ++i)
      ASSERT_NEAR(left.column(column)[i], sign * right.column(column).at(i), 1e-6) << column;
  }
  EXPECT_NEAR(left.last("bite.deepest [mm]"), right.last("bite.deepest [mm]"), 1e-6);
}

// The beginning of chewing-track.toml, with few trials: the way is straight so far, and nobody told
// who opens a jaw.
TEST(JawChewing, AChewThatIsFoundBeginsWithOpenersThatPullAlike) {
  const TemporaryFolder folder;
  const std::string scenarios = ARTICULAR_SOURCE_DIR "/scenarios/mandible/";
  std::string text = content(scenarios + "chewing-track.toml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("chewing.toml", scenarios + "chewing.toml");
  replace("duration = \"0.8 s\"", "duration = \"0.15 s\"");
  folder.file("chew.toml", text);
  const ProgramResult result = run_program(folder, "track chew.toml --iterations 2 --quiet");
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
  const auto found = columns(folder.path() / "out/chew/excitations.csv");
  ASSERT_EQ(found.at("time [s]").size(), 4U);
  for (const char* muscle : {"ip", "ad", "pm", "sm", "at"})
    EXPECT_NEAR(found.at(std::string("l") + muscle)[2], found.at(std::string("r") + muscle)[2],
                1e-3);
  EXPECT_GT(found.at("lpm")[2] + found.at("lad")[2], 0.05);
  EXPECT_LT(found.at("lsm")[2] + found.at("lat")[2], 0.01);
  const ProgramResult run =
      run_program(folder, "run '" + scenarios + "chewing.toml' --set @out/chew/excitations.txt" +
                              " --set duration='0.15 s' --out chew --quiet");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(ScenarioResults(folder.path() / "chew").last("incisor.position.z [mm]"), 36.79, 0.6);
}

}  // namespace articular::chewing_test
