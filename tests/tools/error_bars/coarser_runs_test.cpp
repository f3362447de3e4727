// What is made coarser in time, contact and iteration, and what is said where nothing can be.
#include "tools/error_bars/coarser_runs.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::coarser_runs_test {

using Words = std::vector<std::string>;

sim::Scenario scenario_of(const std::string& settings, const std::string& tables = "") {
  const TemporaryFolder folder;
  return sim::read_scenario(folder.file(
      "scene.toml",
      "duration = '1 s'\n" + settings + tables +
          "[[body]]\nname = 'floor'\nkind = 'fixed'\ngeometry = { box = { size = '1 1 1 mm', cells "
          "= [1, 1, 1] } }\n[[body]]\nname = 'block'\nkind = 'tissue'\ngeometry = { box = { size = "
          "'1 1 1 mm', cells = [1, 1, 1], center = '0 0 1 mm' } }\ndensity = '1 "
          "g/cm^3'\nmaterial = { law = 'linear', young_modulus = '1 kPa', poisson_ratio = 0, "
          "element = 'plain' }\n"));
}

// Frames and restart points are as much rarer, so that the steps between them are as many.
TEST(CoarserSteps, AreTwiceAndFourTimesAsLong) {
  const Direction steps = coarser_steps(
      scenario_of("", "[integrator]\nstep = '2 ms'\n[output]\ncheckpoint_interval = '100 ms'\n"));
  ASSERT_EQ(steps.runs.size(), 2U);
  EXPECT_EQ(steps.formal_order, 1);
  EXPECT_EQ(steps.runs[0].overrides,
            (Words{"integrator.step=\"0.004 s\"", "output.interval=\"0.02 s\"",
                   "output.checkpoint_interval=\"0.2 s\""}));
  EXPECT_EQ(steps.runs[1].overrides[0], "integrator.step=\"0.008 s\"");
}

TEST(CoarserSteps, HaveTheOrderOfTheScheme) {
  const auto order = [](const std::string& scheme) {
    return coarser_steps(scenario_of("", "[integrator]\nscheme = '" + scheme + "'\n")).formal_order;
  };
  EXPECT_EQ(order("implicit-euler"), 1);
  EXPECT_EQ(order("tr-bdf2"), 2);
  EXPECT_EQ(order("dirk-3"), 3);
}

TEST(CoarserSteps, OfTheExplicitSchemeAreThoseOfItsTolerance) {
  const Direction steps = coarser_steps(
      scenario_of("", "[integrator]\nscheme = 'explicit'\nposition_tolerance = '1 um'\n"));
  ASSERT_EQ(steps.runs.size(), 2U);
  EXPECT_EQ(steps.runs[1].overrides, Words{"integrator.position_tolerance=\"0.0001 m\""});
  EXPECT_EQ(steps.runs[1].size, 100);
}

TEST(CoarserSteps, OfStaticsAreTwiceAsLongOnce) {
  const Direction steps =
      coarser_steps(scenario_of("analysis = 'static'\n", "[integrator]\nstep = '0.1 s'\n"));
  ASSERT_EQ(steps.runs.size(), 1U);
  EXPECT_EQ(steps.wanted_runs, 1);
  EXPECT_EQ(steps.runs[0].overrides[0], "integrator.step=\"0.2 s\"");
}

TEST(CoarserSteps, AreNotLongerThanTheRun) {
  const std::string statics = "analysis = 'static'\n";
  EXPECT_EQ(coarser_steps(scenario_of(statics, "[integrator]\nstep = '0.5 s'\n")).runs.size(), 1U);
  const Direction one = coarser_steps(scenario_of(statics, "[integrator]\nstep = '1 s'\n"));
  EXPECT_TRUE(one.runs.empty());
  EXPECT_EQ(one.left_out, "the run is one step, which can't be longer");
}

TEST(SofterContact, IsThreeAndNineTimesAsSoftAsTheRuns) {
  const Direction contact = softer_contact(scenario_of(""), true);
  ASSERT_EQ(contact.runs.size(), 2U);
  EXPECT_EQ(contact.runs[0].overrides[0].rfind("contact_stiffness_factor=33.3", 0), 0U);
  EXPECT_EQ(contact.runs[0].size, 3);
  EXPECT_EQ(contact.runs[1].size, 9);
  const Direction accurate = softer_contact(scenario_of("accuracy = 'accurate'\n"), true);
  EXPECT_EQ(accurate.runs[0].overrides[0].rfind("contact_stiffness_factor=333.3", 0), 0U);
}

// The block presses the floor as softly as it should; what two bones do is not varied, and is told.
TEST(SofterContact, OfRigidBodiesIsToldToBeLeftOut) {
  const std::string bones =
      "[[body]]\nname = 'a'\nkind = 'rigid'\ndensity = '1 g/cm^3'\ngeometry = { box = { size = '1 "
      "1 "
      "1 mm', cells = [1, 1, 1], center = '9 0 0 mm' } }\n[[body]]\nname = 'b'\nkind = "
      "'rigid'\ndensity = '1 g/cm^3'\ngeometry = { box = { size = '1 1 1 mm', cells = [1, 1, 1], "
      "center = '9 0 3 mm' } }\n";
  const std::string with_floor = "[[contact]]\nbodies = ['block', 'floor']\n";
  const Direction all = softer_contact(scenario_of("", bones), true);
  EXPECT_EQ(all.runs.size(), 2U);
  EXPECT_EQ(all.left_out, "two rigid bodies press each other with a fixed stiffness");
  EXPECT_EQ(softer_contact(scenario_of("", bones + with_floor), true).left_out, "");
  const Direction only =
      softer_contact(scenario_of("", bones + "[[contact]]\nbodies = ['a', 'b']\n"), true);
  EXPECT_TRUE(only.runs.empty());
  EXPECT_EQ(only.left_out, all.left_out);
}

TEST(SofterContact, SaysWhereThereIsNothingToVary) {
  EXPECT_EQ(softer_contact(scenario_of(""), false).remark, "nothing touches");
  EXPECT_EQ(softer_contact(scenario_of("contact = false\n"), true).remark, "nothing touches");
  const Direction statics = softer_contact(scenario_of("analysis = 'static'\n"), true);
  EXPECT_TRUE(statics.runs.empty());
  EXPECT_EQ(statics.left_out, "");
  EXPECT_NE(statics.remark, "");
  const Direction pointwise = softer_contact(scenario_of("contact_response = 'pointwise'\n"), true);
  EXPECT_TRUE(pointwise.runs.empty());
  EXPECT_NE(pointwise.left_out, "");
}

TEST(LooserIteration, HasTenTimesTheTolerance) {
  EXPECT_EQ(looser_iteration(scenario_of("")).runs[0].overrides,
            Words{"integrator.element_tolerance=0.005"});
  EXPECT_EQ(looser_iteration(scenario_of("", "[integrator]\nposition_tolerance = '1 um'\n"))
                .runs[0]
                .overrides,
            Words{"integrator.position_tolerance=\"1e-05 m\""});
  EXPECT_TRUE(looser_iteration(scenario_of("analysis = 'static'\n")).runs.empty());
}

}  // namespace articular::tools::coarser_runs_test
