// The contact scenes of scenarios/verification and scenarios/v-shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::contact_scenes_test {

void expect_contact_was_searched(const ScenarioResults& results) {
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_GT(results.count("sundials_steps"), 0);
  EXPECT_GT(results.count("tree_updates"), 0);
  EXPECT_GT(results.count("narrow_tests"), 0);
  EXPECT_GT(results.count("reported_pairs"), 0);
}

TEST(BlockOnBlock, ContactCarriesTheWeightOfTheUpperBlock) {
  const ScenarioResults results = run_scenario("verification/block_on_block.toml");
  expect_contact_was_searched(results);
  const double weight = 1060 * 9.81 * 1e-6;  // [N]
  const auto& time = results.column("time [s]");
  const auto& force = results.column("between.force.z [N]");
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < 0.3) continue;
    EXPECT_NEAR(force[i], weight, 2e-3 * weight) << "at " << time[i] << " s";
  }
  EXPECT_NEAR(results.last("between.force.x [N]"), 0, 1e-3 * weight);
  EXPECT_NEAR(results.last("between.force.y [N]"), 0, 1e-3 * weight);
  const double both = 1060 * 9.81 * (1e-6 + 16 * 16 * 8e-9);  // [N]
  EXPECT_NEAR(results.last("floor.force.z [N]"), -both, 2e-3 * both);
  EXPECT_NEAR(results.last("between.area [mm^2]"), 100, 2);   // a little more: it bulges
  EXPECT_NEAR(results.last("top.position.x [mm]"), 0, 1e-3);  // slides nowhere
}

// Force of a rigid ball on a layer bonded to a rigid base. [Dimitriadis 2002, Biophys J 82:2798,
// eq. 11]
double bonded_layer_force(double E, double nu, double R, double h, double depth) {
  constexpr double pi = std::numbers::pi;
  const double a0 = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1 - nu);
  const double b0 = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1 - nu);
  const double chi = std::sqrt(R * depth) / h;
  const double series =
      1 - 2 * a0 / pi * chi + 4 * a0 * a0 / (pi * pi) * chi * chi -
      8 / std::pow(pi, 3) * (std::pow(a0, 3) + 4 * pi * pi / 15 * b0) * std::pow(chi, 3) +
      16 * a0 / std::pow(pi, 4) * (std::pow(a0, 3) + 3 * pi * pi / 5 * b0) * std::pow(chi, 4);
  return 4.0 / 3 * E / (1 - nu * nu) * std::sqrt(R) * std::pow(depth, 1.5) * series;
}

// The tolerance covers plain tetrahedra of 1.5 mm under a contact of 3 mm radius (too stiff), a
// strain of 10 % that the series takes for small, and the facets of the ball.
TEST(ToolOnTissue, ForceIsThatOfABallOnABondedLayer) {
  const ScenarioResults results = run_scenario("verification/tool_on_tissue.toml");
  expect_contact_was_searched(results);
  const double expected = bonded_layer_force(15e3, 0.3, 0.01, 0.01, 0.001);
  const double force = std::abs(results.at("tool.force.z [N]", 0.4));
  std::printf("force of the tool: %.4f N, series %.4f N\n", force, expected);
  EXPECT_NEAR(force, expected, 0.1 * expected);
  // Held still, the plate carries what the tool presses.
  EXPECT_NEAR(std::abs(results.at("plate.force.z [N]", 0.4)), force, 1e-3 * force);
  EXPECT_NEAR(results.last("tool.force.z [N]"), 0, 1e-3 * force);
  // An elastic tissue gives the work back but for what the time integration loses.
  EXPECT_LT(std::abs(results.last("energy.motion_work [J]")),
            0.1 * results.largest("energy.motion_work [J]"));
}

TEST(Incline, OneBlockCreepsAndTheOthersSlideWithWhatFrictionLeaves) {
  const ScenarioResults results = run_scenario("verification/incline.toml");
  expect_contact_was_searched(results);
  const double sine = 3.355218, cosine = 9.218385;  // times g [m/s²]
  const auto speed = [&](const std::string& block, double from, double to) {
    const std::string column = block + ".position.x [mm]";
    return 1e-3 * (results.at(column, to) - results.at(column, from)) / (to - from);
  };
  const auto acceleration = [&](const std::string& block) {
    return (speed(block, 0.08, 0.1) - speed(block, 0.04, 0.06)) / 0.04;
  };
  const double ratio = sine / cosine / 0.5, creep = 1e-4 * ratio / std::sqrt(1 - ratio * ratio);
  EXPECT_NEAR(speed("sticking", 0.05, 0.1), creep, 0.01 * creep);
  EXPECT_NEAR(acceleration("sliding"), sine - 0.3 * cosine, 0.01 * (sine - 0.3 * cosine));
  EXPECT_NEAR(acceleration("slippery"), sine, 0.01 * sine);
  EXPECT_NEAR(-results.last("slid.force.x [N]"), 0.3 * results.last("slid.force.z [N]"),
              1e-3 * results.last("slid.force.z [N]"));
  const double weight = 1000 * 16 * 16 * 8e-9;  // by g [kg]
  EXPECT_NEAR(-results.last("stuck.force.x [N]"), weight * sine, 0.01 * weight * sine);
  const double rubbed = 1e-3 * results.last("sliding.position.x [mm]") * 0.3 * weight * cosine +
                        1e-3 * results.last("sticking.position.x [mm]") * weight * sine;
  EXPECT_NEAR(results.last("energy.contact_loss [J]"), rubbed, 0.03 * rubbed);
}

TEST(TwoVShapes, PushEachOtherAsideWithEqualAndOppositeForces) {
  const ScenarioResults results = run_scenario("v-shapes/two.toml", {"duration=0.5 s"});
  expect_contact_was_searched(results);
  EXPECT_EQ(results.at("between.area [mm^2]", 0), 0);
  const double force = -results.last("lower hand.force.y [N]");
  EXPECT_GT(std::abs(force), 1e-2);
  // Dragged at 26 mm/s, inertia plays no part.
  EXPECT_NEAR(results.last("upper hand.force.y [N]"), force, 0.02 * std::abs(force));
  EXPECT_NEAR(results.last("upper hand.force.z [N]"), -results.last("lower hand.force.z [N]"),
              0.02 * std::abs(force));
  // Everything is symmetric about x = 0.
  EXPECT_NEAR(results.last("between.force.x [N]"), 0, 1e-6 * std::abs(force));
  EXPECT_LT(results.largest("between.max_penetration [mm]"), 0.2);  // 5 % of a leg
}

// Where edges slip off each other, opposing faces must not be taken for crossed ones at a depth of
// millimetres, and forces need the motion of the rims: else that would make energy out of nothing.
TEST(TwoVShapes, SlipOffEachOtherWithoutGainingEnergy) {
  for (const char* response : {"pointwise", "averaged"}) {
    const ScenarioResults results =
        run_scenario("v-shapes/two.toml", {std::string("contact_response=") + response});
    expect_contact_was_searched(results);
    EXPECT_EQ(results.last("between.area [mm^2]"), 0);
    EXPECT_LT(results.count("rejected_newton"), 100);
    EXPECT_LT(results.largest("between.max_penetration [mm]"), 0.7);
    EXPECT_GT(results.smallest("energy.numerical_loss [J]"),
              -1e-3 * results.largest("energy.motion_work [J]"));
  }
}

TEST(SelfV, LegsCloseOnEachOther) {
  const ScenarioResults results = run_scenario("v-shapes/self.toml");
  expect_contact_was_searched(results);
  EXPECT_EQ(results.at("legs.area [mm^2]", 0.1), 0);
  EXPECT_GT(results.last("legs.area [mm^2]"), 4);  // half the width of a leg, 2 mm high
  EXPECT_LT(results.largest("legs.max_penetration [mm]"), 0.4);  // 10 % of a leg
  const double force = results.last("left hand.force.x [N]");
  EXPECT_LT(force, -0.02);  // legs push the hands apart
  EXPECT_NEAR(results.last("right hand.force.x [N]"), -force, 1e-4 * std::abs(force));
}

}  // namespace articular::contact_scenes_test
