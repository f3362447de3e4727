#include "sim/assembly/load_work.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::load_work_test {

// A rigid body goes some way and turns: a dead force works at its point, a moment by the angle
// about its axis, changing gravity by the fall. Factors are those at the times that are asked for.
TEST(LoadWork, IsThatOfEachLoadByItsMeanFactor) {
  const Vec3 centre(0.1, -0.2, 0.3), at(0.15, -0.1, 0.3), force(3, -2, 5);
  constexpr double kMass = 2, kMoment = 0.6, kAngle = 0.7;
  const Curve grows{{0, 2}, {0, 4}}, falls{{0, 2}, {1, 0}};
  Scenario s = scene(1e-3, Integrator::Scheme::TrBdf2);
  s.bodies = {mass_body("top", kMass, centre)};
  s.loads = {ForceLoad{anchor("top", at), force, grows, {}},
             MomentLoad{"top", {0, 0, kMoment}, falls, {}}, GravityLoad{{0, 0, -10}, {}, grows}};
  const Simulation run(s);
  const Configuration from = run.now();
  Configuration to = from;
  const Vec3 way(0.02, 0.03, -0.05);
  const Mat3 R = Eigen::AngleAxisd(kAngle, Vec3::UnitZ()).toRotationMatrix();
  to.poses[0].p += way;
  to.poses[0].R = R * from.poses[0].R;
  const double mean_of_growing = 0.5 * (1 + 3), mean_of_falling = 0.5 * (0.75 + 0.25);
  const double by_force = force.dot(way + R * (at - centre) - (at - centre)),
               by_moment = kMoment * kAngle, by_weight = kMass * 10 * -way.z();
  EXPECT_NEAR(load_work(run.model, from, to, 0.5, 1.5),
              mean_of_growing * (by_force + by_weight) + mean_of_falling * by_moment, 1e-12);
}

}  // namespace articular::sim::load_work_test
