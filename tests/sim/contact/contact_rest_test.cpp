// Bodies that lie on others at rest.
#include <gtest/gtest.h>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_rest_test {

constexpr double kGravity = 9.81;  // [m/s²]

// A rigid block of 1e5 times the mass of the pad that it lies on, which is squeezed by 4 MPa. The
// pad is tied to the floor: without friction a light pad between a floor and a heavy block is
// shot out sideways by the slightest tilt (rate F / √(K m), K the pad's stiffness against tilt).
TEST(ContactAtRest, AHeavyBlockOnAPadComesToRestWithItsWeight) {
  constexpr double kPad = 0.02, kHeight = 0.004, kRatio = 1e5;  // [m], [m], [-]
  Scenario s = contact_scene(5e-3);
  s.bodies = {
      box_body("floor", Body::Kind::Fixed, {2 * kPad, 2 * kPad, kPad}, {0, 0, -kPad / 2},
               {4, 4, 2}),
      box_body("pad", Body::Kind::Tissue, {kPad, kPad, kHeight}, {0, 0, kHeight / 2}, {10, 10, 2}),
      box_body("block", Body::Kind::Rigid, {1.5 * kPad, 1.5 * kPad, kPad},
               {0, 0, kHeight + kPad / 2}, {4, 4, 2})};
  s.bodies[1].material = neo_hookean(40e6, 0.4);
  const double pad_mass = 1000 * kPad * kPad * kHeight;
  s.bodies[2].mass = kRatio * pad_mass;
  s.attachments = {attach("pad", "floor", {-1, -1, -1}, {1, 1, 1e-9})};
  s.loads = {gravity({0, 0, -kGravity})};
  Simulation run(s);
  double most_kinetic = 0;
  run.advance(0.6, [&] { most_kinetic = std::max(most_kinetic, kinetic_energy(run)); });
  EXPECT_LT(kinetic_energy(run), 1e-8 * most_kinetic);
  const double weight = (kRatio + 1) * pad_mass * kGravity;
  EXPECT_NEAR(run.force_on(bone_of(run, "floor")).z(), -weight, 1e-4 * weight);
  EXPECT_LT(run.force_on(bone_of(run, "block")).norm(), 1e-4 * weight);  // its own weight included
  EXPECT_GT(least_volume_ratio(run), 0.7);

  // How far the pad is in the block's underside on average.
  const Positions x = nodes_of(run, 0);
  const Pose& block = run.now().poses[static_cast<std::size_t>(bone_of(run, "block"))];
  const double underside = block.p.z() - kPad / 2;
  double penetration = 0;
  int nodes = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    if (run.model.tissues[0].X(2, i) < kHeight - 1e-9) continue;
    penetration += x(2, i) - underside;
    ++nodes;
  }
  const double element = kHeight / 2;
  EXPECT_GT(penetration, 0);  // they touch
  EXPECT_LT(penetration / nodes, 0.01 * element);
}

// Between rigid bodies contact is so stiff that its depth at rest is far below the tolerance of
// positions: what Newton's iteration may leave of the forces must be small against them, or the
// block drifts and rocks.
TEST(ContactAtRest, ARigidBlockOnARigidFloorStaysWhereItWasPut) {
  constexpr double kSide = 0.01;
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Rigid, Vec3::Constant(kSide)),
              box_body("floor", Body::Kind::Fixed, {3 * kSide, 3 * kSide, kSide}, {0, 0, -kSide})};
  s.loads = {gravity({0, 0, -kGravity})};
  Simulation run(s);
  const int block = bone_of(run, "block");
  run.advance(1);
  const Pose& pose = run.now().poses[static_cast<std::size_t>(block)];
  EXPECT_LT(pose.p.norm(), 1e-7 * kSide);
  EXPECT_LT((pose.R - Mat3::Identity()).norm(), 1e-7);
  EXPECT_LT(kinetic_energy(run), 1e-20 * kGravity * kSide);  // [J], of 1 g
  const double weight = 1000 * kSide * kSide * kSide * kGravity;
  EXPECT_NEAR(run.force_on(bone_of(run, "floor")).z(), -weight, 1e-6 * weight);
}

// The contact force that a correction of the size of the tolerance makes is fifty times the weight
// of the light block.
TEST(ContactAtRest, ALightBlockPressesAHeavyOneWithItsWeight) {
  constexpr double kSide = 0.01, kHeavy = 1e6, kLight = 1;  // [m], [kg/m³]
  Scenario s = contact_scene(1e-3);
  s.integrator.position_tolerance = 1e-6;
  s.bodies = {
      box_body("below", Body::Kind::Tissue, Vec3::Constant(kSide), {0, 0, -kSide / 2}, {3, 3, 3}),
      box_body("above", Body::Kind::Tissue, {0.8 * kSide, 0.8 * kSide, kSide}, {0, 0, kSide / 2},
               {3, 3, 3}),
      stand("floor")};
  for (std::size_t b : {0U, 1U}) {
    s.bodies[b].material = neo_hookean(1e7, 0.3);
    s.bodies[b].material->mass_damping = 200;
  }
  s.bodies[0].density = kHeavy;
  s.bodies[1].density = kLight;
  s.attachments = {attach("below", "floor", {-1, -1, -1}, {1, 1, 1e-6 - kSide})};
  s.loads = {gravity({0, 0, -kGravity})};
  Simulation run(s);
  run.advance(0.2);
  const double weight = kLight * 0.64 * kSide * kSide * kSide * kGravity;
  EXPECT_NEAR(run.stepper.dynamics().contact_summary(0).force.norm(), weight, 0.01 * weight);
}

// A matrix from before has the stiffness of a contact that has opened since then, which would hold
// the block where it is.
TEST(ContactAtRest, ABlockThatIsLiftedWithMoreThanItsWeightRises) {
  constexpr double kSide = 0.01, kTime = 0.1, kStep = 1e-3;
  const double weight = 1000 * kSide * kSide * kSide * kGravity;
  for (const Scenario::Response response :
       {Scenario::Response::Pointwise, Scenario::Response::Averaged}) {
    Scenario s = contact_scene(kStep);
    s.contact_response = response;
    s.bodies = {
        box_body("block", Body::Kind::Rigid, Vec3::Constant(kSide)),
        box_body("floor", Body::Kind::Fixed, {3 * kSide, 3 * kSide, kSide}, {0, 0, -kSide})};
    ForceLoad lift;
    lift.at = anchor("block", Vec3::Zero());
    lift.force = {0, 0, 2 * weight};
    lift.profile = {{0, kTime}, {0, 1}};
    s.loads = {gravity({0, 0, -kGravity}), lift};
    Simulation run(s);
    run.advance(kTime);
    // From kTime/2 on: implicit Euler's sum of an acceleration that goes from 0 to g.
    const double expected = 0.25 * kGravity * (kTime + 2 * kStep);
    EXPECT_NEAR(run.now().velocities[0].linear.z(), expected, 1e-3 * expected);
  }
}

// Flush sides of cubes that stand on each other face each other across a whole side: nothing came
// in there. The bones have no elements smaller than themselves.
TEST(ContactAtRest, RigidCubesOfOneCellStandOnEachOther) {
  constexpr double kSide = 0.005;  // [m]
  Scenario s = contact_scene(1e-3);
  s.bodies = {box_body("floor", Body::Kind::Fixed, {0.02, 0.02, 0.005}, {0, 0, -0.0025}, {2, 2, 1}),
              box_body("below", Body::Kind::Rigid, Vec3::Constant(kSide), {0, 0, kSide / 2}),
              box_body("above", Body::Kind::Rigid, Vec3::Constant(kSide),
                       {0.1 * kSide, 0.1 * kSide, 1.5 * kSide})};
  s.loads = {gravity({0, 0, -kGravity})};
  Simulation run(s);
  run.advance(0.1);
  const double weight = 1000 * kSide * kSide * kSide * kGravity;
  EXPECT_LT(kinetic_energy(run), 1e-9 * weight * kSide);
  EXPECT_NEAR(run.force_on(bone_of(run, "floor")).z(), -2 * weight, 1e-3 * weight);
}

// It stands while its middle is over what it stands on. A mean around its four lower corners would
// let it tip as soon as a quarter of it stands out.
TEST(ContactAtRest, ACubeOfOneCellTipsOverAnEdgeWhereItsMiddleIsBeyondIt) {
  constexpr double kSide = 0.005;  // [m]
  for (const double out : {0.4, 0.6}) {
    Scenario s = contact_scene(1e-3);
    s.bodies = {
        box_body("table", Body::Kind::Fixed, {0.02, 0.02, 0.005}, {-0.01, 0, -0.0025}, {4, 4, 1}),
        box_body("cube", Body::Kind::Tissue, Vec3::Constant(kSide),
                 {(out - 0.5) * kSide, 0, 0.5 * kSide}, {1, 1, 1})};
    s.bodies[1].material = neo_hookean(1e5, 0.3);
    s.loads = {gravity({0, 0, -kGravity})};
    Simulation run(s);
    run.advance(0.1);
    const double weight = 1000 * kSide * kSide * kSide * kGravity;
    const double kinetic = kinetic_energy(run);
    if (out < 0.5)
      EXPECT_LT(kinetic, 1e-6 * weight * kSide);
    else
      EXPECT_GT(kinetic, 1e-2 * weight * kSide);
  }
}

}  // namespace articular::sim::contact_rest_test
