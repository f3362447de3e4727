// Gravity with a profile: motion, work, equilibrium.
#include "sim/loads/gravity.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::gravity_test {

GravityLoad rising(const Vec3& acceleration, double duration) {
  GravityLoad load = gravity(acceleration);
  load.profile = {{0, duration}, {0, 1}};
  return load;
}

TEST(Gravity, IsTheSumOfItsLoadsAtATime) {
  Scenario s = scene(1e-3);
  s.bodies = {mass_body("mass", 2)};
  s.loads = {gravity({0, 0, -9}), rising({4, 0, 0}, 2), gravity(Vec3::Zero())};
  const Model model = build_model(s);
  EXPECT_EQ(gravity_at(model, 0.5), Vec3(1, 0, -9));
  EXPECT_EQ(steady_gravity(model), Vec3(0, 0, -9));
  EXPECT_EQ(mean_changing_gravity(model, 0.5, 1.5), Vec3(2, 0, 0));
}

// a = g t/T: v = g t²/(2 T), x = g t³/(6 T), of a bone and of tissue. Its work is what moves.
TEST(Gravity, ThatRisesMovesAllByTheClosedForm) {
  constexpr double kG = 9, kT = 0.1;
  Scenario s = scene(1e-3, Integrator::Scheme::Dirk3);
  s.bodies = {mass_body("mass", 2, {0.1, 0.2, 0.3}),
              box_body("block", Body::Kind::Tissue, Vec3::Constant(0.01))};
  s.loads = {rising({0, 0, -kG}, kT)};
  Simulation run(s);
  run.advance(kT);
  const double fallen = kG * kT * kT / 6, speed = kG * kT / 2;
  EXPECT_NEAR(run.now().poses[0].p.z(), 0.3 - fallen, 1e-9);
  EXPECT_NEAR(run.now().velocities[0].linear.z(), -speed, 1e-8);
  for (int b = 0; b < run.model.layout.num_free_nodes; ++b)
    EXPECT_NEAR(run.now().v(2, b), -speed, 1e-7);
  EXPECT_NEAR(run.state.energy.load_work, 0.5 * (2 + 1e-3) * speed * speed, 1e-4);
  EXPECT_EQ(run.stepper.stored_energy().gravity, 0);
  EXPECT_LT(std::abs(run.loss()), 1e-4);
}

// What hangs under half of the gravity is drawn out by half; work is stored.
TEST(Gravity, InStaticsHangsByItsFactor) {
  Scenario s = scene(0.5);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("bar", Body::Kind::Tissue, {0.02, 0.02, 0.08}, {0, 0, 0.04}, {1, 1, 4}),
              stand("wall")};
  s.bodies[0].material = linear(15e3, 0);
  s.attachments = {attach("bar", "wall", {-1, -1, 0.0799}, {1, 1, 0.0801})};
  s.loads = {rising({0, 0, -9.81}, 1)};
  Simulation run(s);
  run.advance(0.5);
  EXPECT_NEAR(run.force_on(0).z(), -0.5 * 9.81 * 0.032, 1e-6);
  run.advance(1);
  EXPECT_NEAR(run.force_on(0).z(), -9.81 * 0.032, 1e-6);
  EXPECT_NEAR(run.loss(), 0, 1e-6 * run.stepper.stored_energy().elastic);
}

// Steps end where a profile has a kink.
TEST(Gravity, AndPressureHaveKinksAtTheTimesOfTheirProfiles) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
  SurfaceLoad pressure;
  pressure.at.tissue = "block";
  pressure.stress = 1.0;
  pressure.profile = {{0, 0.3, 2}, {0, 1, 1}};
  s.loads = {rising({0, 0, -1}, 0.2), pressure};
  EXPECT_EQ(kink_times(build_model(s), 1), (std::vector<double>{0.2, 0.3}));
}

using GravityFile = ScenarioTest;

TEST_F(GravityFile, MayHaveAProfile) {
  const Scenario s = read(kStart + R"(
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
profile = { time = ["0 s", "1 s"], value = [0, 1] }
)");
  EXPECT_EQ(std::get<GravityLoad>(s.loads[0]).profile.value, (std::vector<double>{0, 1}));
}

}  // namespace articular::sim::gravity_test
