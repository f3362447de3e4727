// The jaw of scenarios/mandible/: it opens and closes, and only contact, muscles and ligaments make
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/build/build_model.hpp"
#include "tests/scenarios/coarse_jaw.hpp"

namespace articular::jaw_test {

/// Long steps: these runs are about where the jaw goes, not about its last tenth of a millimetre.
const std::vector<std::string> kCoarse = {"accuracy=fast", "integrator.step=6 ms"};

/// Incisor's way down from the start [mm].
double opening(const ScenarioResults& results, double time) {
  const std::string z = "incisor.position.z [mm]";
  return results.column(z).front() - results.at(z, time);
}

/// Condyle's way forward from the start [mm].
double translation(const ScenarioResults& results, const std::string& side, double time) {
  const std::string y = "condyle_" + side + ".position.y [mm]";
  return results.column(y).front() - results.at(y, time);
}

/// @param most_penetration  [m]; the discs are 1.2 mm and more thick
void expect_opens(const ScenarioResults& results, double open_time, double least_opening,
                  double least_translation, double most_penetration) {
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  for (const char* count : {"sundials_steps", "tree_updates", "narrow_tests", "reported_pairs"})
    EXPECT_GT(results.count(count), 0) << count;
  EXPECT_GT(opening(results, open_time), least_opening);
  EXPECT_GT(translation(results, "left", open_time), least_translation);
  EXPECT_GT(translation(results, "right", open_time), least_translation);
  EXPECT_LT(results.summary().at("max_penetration_m").get<double>(), most_penetration);
}

/// When the jaw has settled onto the discs.
constexpr double kSettled = 0.025;  // [s]

/// What the muscles gave and took while the mouth opened [J].
double muscle_work(const ScenarioResults& results, double open_time) {
  const auto& time = results.column("time [s]");
  const auto& work = results.column("energy.muscle_work [J]");
  double sum = 0;
  for (std::size_t i = 1; i < time.size() && time[i] <= open_time * (1 + 1e-9); ++i)
    if (time[i - 1] >= kSettled) sum += std::abs(work[i] - work[i - 1]);
  return sum;
}

void expect_energy_is_kept_while_opening(const ScenarioResults& results, double open_time) {
  // Nothing takes energy but ligaments and the time integration. Implicit Euler loses in proportion
  // to its step: with these long ones less than 3 % of the muscles' work.
  const std::string loss = "energy.numerical_loss [J]";
  EXPECT_LT(std::abs(results.at(loss, open_time) - results.at(loss, kSettled)),
            0.03 * muscle_work(results, open_time));
}

// The scene is symmetric, and so is its motion. On their discs the condyles take another path than
// on bone.
TEST(JawOpening, TheMouthOpensByTensOfMillimetresAndClosesAgain) {
  const ScenarioResults results = coarse_jaw("opening.toml", kCoarse);
  expect_opens(results, 0.4, 25, 8, 0.1e-3);
  expect_energy_is_kept_while_opening(results, 0.4);
  EXPECT_LT(std::abs(opening(results, 0.9)), 2);
  EXPECT_NEAR(results.at("incisor.position.x [mm]", 0.4), 0, 0.5);

  std::vector<std::string> overrides = kCoarse;
  overrides.insert(overrides.end(), {"choice.disc=none", "duration=0.3 s"});
  const ScenarioResults bare = run_scenario("mandible/opening.toml", overrides);
  const std::string z = "condyle_left.position.z [mm]";
  double largest = 0;
  for (const double t : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3})
    largest = std::max(largest, std::abs(bare.at(z, t) - results.at(z, t)));
  EXPECT_GT(largest, 0.5);  // [mm]
}

/// @param least_way  down at full opening [mm]
void expect_hyoid_goes_along(const ScenarioResults& results, double least_way) {
  const std::string hyoid = "hyoid.position.z [mm]";
  EXPECT_LT(results.at(hyoid, 0.4), results.at(hyoid, 0) - least_way);
  EXPECT_NEAR(results.at("hyoid.position.x [mm]", 0.4), 0, 0.01);
}

// Published for women: 44.3 ± 6.7 mm, 36.3 ± 4.3 degrees; the hyoid goes down.
TEST(JawOpening, WithAHyoidOnItsMusclesTheMouthOpensToThePublishedRange) {
  const ScenarioResults results = run_scenario(
      "mandible/opening.toml", {"choice.hyoid=moves", "choice.disc=rigid", "accuracy=fast",
                                "integrator.step=6 ms", "duration=0.42 s"});
  expect_opens(results, 0.4, 37.6, 8, 0.2e-3);
  EXPECT_GT(results.at("jaw.angle [deg]", 0.4), 28);
  expect_hyoid_goes_along(results, 5);
}

// All openers pull with all their force, so that no excitation is chosen. Published for women:
// 44.3 ± 6.7 mm, condyles 18.1 ± 2.5 mm forward, 36.3 ± 4.3 degrees; the hyoid goes down. It comes
// back when the mouth closes.
TEST(JawOpening, TheMouthOpensAsWideAsInPeopleWithAllForceAndAHyoidOnItsMuscles) {
  const ScenarioResults results = run_scenario(
      "mandible/opening.toml", {"choice.hyoid=moves", "choice.effort=all", "choice.disc=rigid",
                                "accuracy=fast", "integrator.step=6 ms"});
  expect_opens(results, 0.4, 44.3 - 6.7, 18.1 - 2.5, 0.2e-3);
  EXPECT_LT(opening(results, 0.4), 44.3 + 6.7);
  EXPECT_LT(translation(results, "left", 0.4), 18.1 + 2.5);
  EXPECT_NEAR(results.at("jaw.angle [deg]", 0.4), 36.3, 4.3);
  expect_hyoid_goes_along(results, 3);
  EXPECT_LT(std::abs(opening(results, 0.9)), 2);
}

TEST(JawOpening, WithoutContactACondyleLeavesItsFossa) {
  sim::Scenario scenario = shipped_scenario(
      "mandible/opening.toml",
      {"choice.disc=none", "accuracy=fast", "integrator.step=4 ms", "duration=0.2 s"});
  scenario.contact = false;
  scenario.contacts.clear();
  std::erase_if(scenario.probes, [](const sim::Probe& probe) {
    return std::holds_alternative<sim::ContactProbe>(probe.what);
  });
  const ScenarioResults results = run_scenario(scenario);
  // The fossa's roof is 3 mm above the condyle's disc.
  const auto& z = results.column("condyle_left.position.z [mm]");
  const double highest = *std::max_element(z.begin(), z.end()) - z.front();
  const double lowest = *std::min_element(z.begin(), z.end()) - z.front();
  EXPECT_GT(std::max(highest, -lowest), 6) << highest << ", " << lowest;
  EXPECT_EQ(results.count("tree_updates"), 0);
}

// Both condyles go forward on the recorded eminence, not as far as its crest, and back.
TEST(JawOpening, TheRealJawOpensOnItsRealDiscsAndClosesAgain) {
  if (std::getenv("ARTICULAR_DATA") == nullptr)
    GTEST_SKIP() << "ARTICULAR_DATA does not name the folder with the real anatomy";
  // Coarser than in the scenario, which takes minutes.
  const ScenarioResults results = run_scenario(
      "mandible/subject.toml",
      {"accuracy=fast", "integrator.step=5 ms", "integrator.position_tolerance=5 um",
       "duration=0.78 s", "output.interval=100 ms", "body.fossa_left.contact_meshes.0.faces=500",
       "body.fossa_right.contact_meshes.0.faces=500", "body.mandible.contact_meshes.0.faces=500",
       plain_disc("left"), plain_disc("right")});
  expect_opens(results, 0.5, 25, 4, 0.12e-3);
  expect_energy_is_kept_while_opening(results, 0.5);
  EXPECT_LT(std::abs(opening(results, 0.78)), 1);
  // The dampers in the ligaments hold nothing up.
  EXPECT_LT(results.last("energy.ligament_loss [J]"), 0.01 * muscle_work(results, 0.5));
}

}  // namespace articular::jaw_test
