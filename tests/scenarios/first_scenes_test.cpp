// Scenes as somebody writes them who has read only the documentation, with the mistakes of such a
// person. Each gives the right number, or a line that names the mistake.
#include <gtest/gtest.h>

#include <optional>

#include "sim/base/error.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::first_scenes_test {

/// How a scene ends.
struct Outcome {
  enum class Exit { Finished, BadInput, CannotGoOn } exit = Exit::Finished;
  std::string words;  // the message, or all warnings
  std::optional<ScenarioResults> results;
};

Outcome outcome_of(const std::string& text) {
  const TemporaryFolder folder;
  Outcome outcome;
  try {
    const sim::Scenario scenario = sim::read_scenario(folder.file("scene.toml", text), {});
    const sim::Model model = sim::build_model(scenario);
    for (const std::string& warning : model.warnings) outcome.words += warning + "\n";
    sim::RunOptions options;
    options.directory = folder / "results";
    sim::run(scenario, model, options);
    outcome.results.emplace(folder / "results");
    for (const auto& warning : outcome.results->summary().at("warnings"))
      outcome.words += warning.get<std::string>() + "\n";
  } catch (const sim::InputError& error) {
    outcome = {Outcome::Exit::BadInput, error.what(), {}};
  } catch (const sim::SimulationError& error) {
    outcome = {Outcome::Exit::CannotGoOn, error.what(), {}};
  }
  return outcome;
}

void expect_words(const std::string& text, Outcome::Exit exit, const std::string& words) {
  const Outcome outcome = outcome_of(text);
  EXPECT_EQ(outcome.exit, exit) << outcome.words;
  EXPECT_NE(outcome.words.find(words), std::string::npos) << outcome.words;
}
void expect_refused(const std::string& text, const std::string& words) {
  expect_words(text, Outcome::Exit::BadInput, words);
}
void expect_warned(const std::string& text, const std::string& words) {
  expect_words(text, Outcome::Exit::Finished, words);
}
/// @param part  of the expected number that it may be off
void expect_value(const std::string& text, const std::string& column, double expected,
                  double part) {
  const Outcome outcome = outcome_of(text);
  ASSERT_EQ(outcome.exit, Outcome::Exit::Finished) << outcome.words;
  EXPECT_EQ(outcome.words, "");
  EXPECT_NEAR(outcome.results->last(column), expected, part * std::abs(expected));
}

/// The text with one place of it replaced.
std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the scene has no `" + old + "`");
  return text.replace(at, old.size(), replacement);
}

/// A beam that bends under its own weight, fixed at one end.
const std::string kBeam = R"(
title = "Cantilever under its own weight"
analysis = "static"
duration = "1 s"
[[body]]
name = "wall"
kind = "fixed"
[[body]]
name = "beam"
kind = "tissue"
geometry = { box = { size = "100 10 10 mm", cells = [40, 4, 4] } }
density = "1000 kg/m^3"
material = { law = "linear", young_modulus = "1 MPa", poisson_ratio = 0.3 }
[[attach]]
body = "beam"
to = "wall"
region = { box = ["-51 -6 -6 mm", "-49.9 6 6 mm"] }
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "tip"
kind = "point"
body = "beam"
point = "50 0 0 mm"
)";

/// A rigid ball that is pressed into a block.
const std::string kPress = R"(
analysis = "static"
duration = "1 s"
[[body]]
name = "floor"
kind = "fixed"
[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "20 20 10 mm", cells = [4, 4, 2], center = "0 0 -5 mm" } }
density = "1000 kg/m^3"
material = { law = "neo-hookean", young_modulus = "20 kPa", poisson_ratio = 0.45 }
[[attach]]
body = "block"
to = "floor"
region = { box = ["-11 -11 -11 mm", "11 11 -9.9 mm"] }
[[body]]
name = "ball"
kind = "fixed"
geometry = { sphere = { radius = "5 mm", element_size = "2 mm", center = "0 0 5 mm" } }
[[load]]
kind = "motion"
body = "ball"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 -1 mm"]
[[probe]]
name = "press"
kind = "contact"
bodies = ["ball", "block"]
)";

/// A weight that hangs on a muscle.
const std::string kLift = R"(
duration = "1 s"
[[body]]
name = "ceiling"
kind = "fixed"
[[body]]
name = "weight"
kind = "rigid"
geometry = { sphere = { radius = "10 mm", element_size = "5 mm", center = "0 0 -110 mm" } }
mass = "1 kg"
[[muscle]]
name = "lifter"
path = [{ body = "ceiling", point = "0 0 0 mm" }, { body = "weight", point = "0 0 -100 mm" }]
max_force = "50 N"
excitation = { time = ["0 s", "0.1 s"], value = [0, 0.5] }
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "lifter"
kind = "line"
line = "lifter"
)";

/// A cube that falls by half a millimetre onto a table.
const std::string kCube = R"(
duration = "0.5 s"
[[body]]
name = "table"
kind = "fixed"
geometry = { box = { size = "40 40 5 mm", cells = [4, 4, 1], center = "0 0 -2.5 mm" } }
[[body]]
name = "cube"
kind = "rigid"
geometry = { box = { size = "10 10 10 mm", cells = [2, 2, 2], center = "0 0 5.5 mm" } }
density = "2000 kg/m^3"
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[contact]]
bodies = ["table", "cube"]
friction = 0.5
[[probe]]
name = "rest"
kind = "contact"
bodies = ["cube", "table"]
)";

// ρ g A L⁴/(8 E I), and 0.8 % by shear. Four elements across are 5 % too stiff at most.
TEST(FirstScenes, ABeamBendsUnderItsWeightAsBeamsDo) {
  expect_value(kBeam, "tip.position.z [mm]", -14.8, 0.05);
}

// P L³/(3 E I).
TEST(FirstScenes, ABeamBendsUnderALoadAtItsEnd) {
  const std::size_t load = kBeam.find("[[load]]"), probe = kBeam.find("[[probe]]");
  expect_value(kBeam.substr(0, load) + R"([[load]]
kind = "force"
body = "beam"
region = { box = ["49.9 -6 -6 mm", "51 6 6 mm"] }
force = "0 0 -0.01 N"
)" + kBeam.substr(probe),
               "tip.position.z [mm]", -4.0, 0.05);
}

// So soft that small strain is no answer, and so heavy that it is no tissue.
TEST(FirstScenes, ALawBeyondItsRangeGivesAWarning) {
  expect_warned(with(kBeam, "1 MPa", "10 kPa"), "takes a rotation for a strain");
}

TEST(FirstScenes, ASoftBeamHangsFromItsWall) {
  const std::string soft = with(with(kBeam, "1 MPa", "10 kPa"), "\"linear\"", "\"neo-hookean\"");
  const Outcome outcome = outcome_of(soft);
  ASSERT_EQ(outcome.exit, Outcome::Exit::Finished) << outcome.words;
  EXPECT_LT(outcome.results->last("tip.position.z [mm]"), -90);
  EXPECT_LT(outcome.results->count("newton_iterations"), 60);
}

TEST(FirstScenes, AUnitThatWasNotMeantIsDoubted) {
  expect_warned(with(kBeam, "1000 kg/m^3", "1000 g/cm^3"), "is its unit the one that was meant?");
  expect_warned(with(kPress, "20 kPa", "20 Pa"), "is its unit the one that was meant?");
}

TEST(FirstScenes, AVectorIsNoList) {
  expect_refused(with(kBeam, "\"0 0 -9.81 m/s^2\"", "[0, 0, -9.81]"),
                 "expected an acceleration as three numbers and one unit in quotes");
}

TEST(FirstScenes, ANumberHasItsUnit) {
  expect_refused(with(kBeam, "\"1 MPa\"", "1e6"), "expected a quantity with its unit");
}

TEST(FirstScenes, ARegionBesideTheTissueIsRefused) {
  expect_refused(with(kBeam, "\"-51 -6 -6 mm\", \"-49.9 6 6 mm\"",
                      "\"-0.051 -0.006 -0.006 mm\", \"-0.0499 0.006 0.006 mm\""),
                 "no node of tissue `beam` lies in the region attached to `wall`");
}

TEST(FirstScenes, ABodyThatNothingHoldsIsNamed) {
  const std::size_t attach = kBeam.find("[[attach]]"), load = kBeam.find("[[load]]");
  expect_words(kBeam.substr(0, attach) + kBeam.substr(load), Outcome::Exit::CannotGoOn,
               "body `beam` can shift");
}

TEST(FirstScenes, IncompressibleIsSaidByAnotherLaw) {
  expect_refused(with(kBeam, "poisson_ratio = 0.3", "poisson_ratio = 0.5"),
                 "Poisson's ratio must lie between -1 and 0.5 (exclusive), found 0.5");
}

TEST(FirstScenes, AProbeInTheAirIsRefused) {
  expect_refused(with(kBeam, "\"50 0 0 mm\"", "\"500 0 0 mm\""), "lies 450 mm from `beam`");
}

TEST(FirstScenes, ASettingBelowATableIsToldWhereItBelongs) {
  expect_refused("[output]\ninterval = \"0.1 s\"\n" + kBeam, "above the first [table] of the file");
}

TEST(FirstScenes, FrictionInStaticsIsRefused) {
  expect_refused(kPress + "[[contact]]\nbodies = [\"ball\", \"block\"]\nfriction = 0.3\n",
                 "needs a dynamic analysis");
}

TEST(FirstScenes, ATissueIsAttachedToBonesOnly) {
  expect_refused(with(kPress, "to = \"floor\"", "to = \"block\""),
                 "expected a fixed or rigid body to attach to");
}

TEST(FirstScenes, ABodyWithoutASurfaceTouchesNothing) {
  expect_refused(with(kPress, "bodies = [\"ball\", \"block\"]", "bodies = [\"ball\", \"floor\"]"),
                 "body `floor` has no surface that could touch");
}

// Elements of 5 mm under a contact 4 mm wide: the force is not to be trusted.
TEST(FirstScenes, AContactThatTheMeshDoesNotResolveGivesAWarning) {
  expect_warned(kPress, "is not resolved");
}

TEST(FirstScenes, AnElementLargerThanTheBallThatPressesItGivesAWarning) {
  const Outcome outcome =
      outcome_of(with(with(kPress, "[4, 4, 2]", "[1, 1, 1]"), "0 0 -1 mm", "0 0 -0.4 mm"));
  EXPECT_NE(outcome.words.find("is not resolved"), std::string::npos) << outcome.words;
}

TEST(FirstScenes, AWeightHangsOnItsMuscle) { expect_value(kLift, "lifter.force [N]", 9.81, 1e-4); }

TEST(FirstScenes, AnExcitationInPerCentIsRefused) {
  expect_refused(with(kLift, "[0, 0.5]", "[0, 50]"), "must lie between 0 and 1, found 50");
}

TEST(FirstScenes, AMisspeltNameIsToldTheNearest) {
  expect_refused(with(kLift, "line = \"lifter\"", "line = \"Lifter\""), "did you mean `lifter`?");
}

TEST(FirstScenes, AnotherProgramsKeyIsAnsweredWithOurs) {
  const std::string ligament =
      with(with(with(kLift, "[[muscle]]", "[[ligament]]"), "max_force = \"50 N\"",
                "stiffness = \"10 N/mm\"\nslack = \"95 mm\""),
           "excitation = { time = [\"0 s\", \"0.1 s\"], value = [0, 0.5] }\n", "");
  expect_refused(ligament, "unknown key `slack`; expected one of");
}

// ρ V g. That it falls first, and that the steps take what it falls with, is told.
TEST(FirstScenes, ACubeRestsOnATableWithItsWeight) {
  const Outcome outcome = outcome_of(kCube);
  ASSERT_EQ(outcome.exit, Outcome::Exit::Finished) << outcome.words;
  EXPECT_NEAR(outcome.results->last("rest.force.z [N]"), 0.01962, 1e-3 * 0.01962);
}

}  // namespace articular::first_scenes_test
