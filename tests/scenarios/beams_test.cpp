// The beams of scenarios/verification against their closed forms, by way of the scenario file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::beams_test {

constexpr double kGravity = 9.81;  // [m/s²]

// ρgL²/2E with L = 0.1 m, E = 20 kPa, ρ = 1000 kg/m³. At ν = 0 the exact displacement depends on z
// only.
constexpr double kHangingDrop = 1000 * kGravity * 0.1 * 0.1 / (2 * 20e3) * 1e3;  // [mm]

double hanging_drop(const std::string& cells) {
  const ScenarioResults results =
      run_scenario("verification/hanging_beam.toml", {"body.beam.geometry.box.cells=" + cells});
  return -100 - results.last("end.position.z [mm]");
}

TEST(HangingBeam, EndGoesDownByItsClosedForm) {
  const ScenarioResults results = run_scenario("verification/hanging_beam.toml");
  const double drop = -100 - results.last("end.position.z [mm]");
  EXPECT_NEAR(drop, kHangingDrop, 1e-3 * kHangingDrop);
  EXPECT_NEAR(results.last("end.position.x [mm]"), 0, 1e-3 * kHangingDrop);
  const double weight = 1000 * kGravity * 0.1 * 1e-4;  // [N]
  EXPECT_NEAR(results.last("clamp.force.z [N]"), -weight, 1e-3 * weight);
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_GT(results.count("sundials_steps"), 0);
}

// Half of ρgL²/2E is stored, the other half of gravity's work was lost in coming to rest (implicit
// Euler): W = ρ²g²L³A/6E.
TEST(HangingBeam, StoresTheEnergyOfItsClosedForm) {
  const ScenarioResults results = run_scenario("verification/hanging_beam.toml");
  const double stored = std::pow(1000 * kGravity, 2) * 1e-3 * 1e-4 / (6 * 20e3);  // [J]
  EXPECT_NEAR(results.last("energy.elastic [J]"), stored, 2e-3 * stored);
  EXPECT_NEAR(results.last("energy.numerical_loss [J]"), stored, 2e-3 * stored);
  EXPECT_LT(results.last("energy.kinetic [J]"), 1e-9 * stored);
}

TEST(HangingBeam, ErrorFallsWithTheSquareOfTheElementSize) {
  const double coarse = std::abs(hanging_drop("[2, 2, 10]") / kHangingDrop - 1);
  const double fine = std::abs(hanging_drop("[4, 4, 20]") / kHangingDrop - 1);
  std::printf("relative error of the drop: %.2e %.2e\n", coarse, fine);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

// A cell override costs nothing where nothing asks for it: the scene names no contact.
TEST(HangingBeam, DetectsNoContact) {
  const ScenarioResults results =
      run_scenario("verification/hanging_beam.toml", {"duration=0.1 s"});
  EXPECT_EQ(results.count("tree_updates"), 0);
  EXPECT_EQ(results.count("reported_pairs"), 0);
}

// The state is uniform, so that only the iteration's tolerance is left: forces balance to 1e-6.
TEST(UniaxialTension, ForceWidthAndWorkAreThoseOfTheClosedForm) {
  const ScenarioResults results = run_scenario("verification/uniaxial_tension.toml");
  EXPECT_NEAR(results.last("grip.force.z [N]"), -10, 1e-5);
  EXPECT_NEAR(results.last("grip.force.x [N]"), 0, 1e-5);
  EXPECT_NEAR(results.last("corner.position.x [mm]"), 9.7, 1e-6);
  EXPECT_NEAR(results.last("corner.position.z [mm]"), 22, 1e-12);
  EXPECT_NEAR(results.last("energy.motion_work [J]"), 0.01, 1e-8);
  EXPECT_NEAR(results.last("energy.elastic [J]"), 0.01, 1e-8);
}

// Timoshenko's beam with ν = 0, L = 60 mm, depth d = 10 mm, E = 1 MPa, ρ = 1000 kg/m³, see the
// file.
constexpr double kBendingDrop =
    1000 * kGravity * (1.5 * 0.06 * 0.06 * 0.06 * 0.06 / (1e6 * 1e-4) + 1.2 * 0.06 * 0.06 / 1e6) *
    1e3;  // [mm]

double bending_drop(const std::string& cells) {
  const ScenarioResults results =
      run_scenario("verification/bending_beam.toml", {"body.beam.geometry.box.cells=" + cells});
  return -results.last("end.position.z [mm]");
}

TEST(BendingBeam, EndConvergesToTimoshenkosBeamFromTheStiffSide) {
  const double coarse = bending_drop("[24, 2, 4]"), fine = bending_drop("[48, 4, 8]");
  const double coarse_error = 1 - coarse / kBendingDrop, fine_error = 1 - fine / kBendingDrop;
  std::printf("relative error of the drop: %.2e %.2e\n", coarse_error, fine_error);
  EXPECT_GT(fine_error, 0);
  EXPECT_LT(fine_error, 0.05);
  EXPECT_NEAR(std::log2(coarse_error / fine_error), 2, 0.3);
  // What both meshes say of an infinitely fine one; beam theory itself is good for some (d/L)²/10.
  const double limit = fine + (fine - coarse) / 3;
  EXPECT_NEAR(limit, kBendingDrop, 0.01 * kBendingDrop);
}

// ρgA L²/2 about the middle of the clamped end.
TEST(BendingBeam, WallCarriesTheMoment) {
  const ScenarioResults results =
      run_scenario("verification/bending_beam.toml", {"body.beam.geometry.box.cells=[24, 2, 4]"});
  const double moment = 1000 * kGravity * 0.01 * 0.005 * 0.06 * 0.06 / 2;  // [N m]
  EXPECT_NEAR(std::abs(results.last("wall.moment.y [N m]")), moment, 2e-3 * moment);
  EXPECT_NEAR(results.last("wall.moment.x [N m]"), 0, 1e-6 * moment);
  EXPECT_NEAR(results.last("wall.moment.z [N m]"), 0, 1e-6 * moment);
}

}  // namespace articular::beams_test
