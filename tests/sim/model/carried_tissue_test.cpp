// Tissue that driven fixed bodies carry: its momentum and energy are in reactions and in the
// ledger. Beside a rigid body that is held: driven_rigid_body_test.cpp.
#include "sim/model/carried_tissue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::carried_tissue_test {

using Scheme = Integrator::Scheme;

constexpr double kSide = 0.02, kMass = 1000 * kSide * kSide * kSide;  // [m], [kg]

/// A block of tissue on a plate that moves; tied to it up to a height.
Scenario carried_block(double h, double tied_height, const MotionLoad& load) {
  Scenario s = scene(h, Scheme::TrBdf2);
  s.bodies = {
      box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), {0, 0, kSide / 2}, {2, 2, 2}),
      box_body("plate", Body::Kind::Fixed, {kSide, kSide, 0.004}, {0.01, 0, -0.002})};
  s.attachments = {attach("block", "plate", {-1, -1, -1e-6}, {1, 1, tied_height})};
  s.loads = {load};
  return s;
}

MotionLoad smooth_drive(const Vec3& way, const Vec3& turn) {
  MotionLoad load = shift("plate", 0.1, way);
  load.motion.interpolation = Motion::Interpolation::Smooth;
  load.motion.rotation = {Vec3::Zero(), turn};
  load.motion.about = {0.03, -0.01, 0.02};
  return load;
}

/// Of all nodes: momentum, and about a point of space the angular one.
Vec6 momentum(const Simulation& run, const Vec3& point) {
  Vec6 sum = Vec6::Zero();
  const Tissue& tissue = run.model.tissues[0];
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const Vec3 p =
        tissue.lumped_mass[static_cast<Eigen::Index>(i)] * run.now().velocity(tissue.nodes[i]);
    sum.head<3>() += p;
    sum.tail<3>() += (run.now().position(tissue.nodes[i]) - point).cross(p);
  }
  return sum;
}

double energy_of_motion(const Simulation& run) {
  double sum = 0;
  const Tissue& tissue = run.model.tissues[0];
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
    sum += 0.5 * tissue.lumped_mass[static_cast<Eigen::Index>(i)] *
           run.now().velocity(tissue.nodes[i]).squaredNorm();
  return sum;
}

/// Of the plate, about the origin.
Vec6 about_origin(const Simulation& run, Vec6 reaction) {
  reaction.tail<3>() += run.now().poses[0].p.cross(reaction.head<3>());
  return reaction;
}

// Σ m a of a block that is carried whole, by central differences of its momentum over time.
TEST(CarriedTissue, ReactionIsTheRateOfItsMomentum) {
  const MotionLoad load = smooth_drive({0.03, -0.02, 0.01}, {0.4, 0.9, -0.6});
  const auto momentum_at = [&](double t) {
    Simulation run(carried_block(1e-3, 1, load));
    run.advance(t);
    return momentum(run, Vec3::Zero());
  };
  Simulation run(carried_block(1e-3, 1, load));
  for (const double t : {0.013, 0.05, 0.087}) {
    constexpr double h = 1e-6;
    run.advance(t);
    const Vec6 rate = (momentum_at(t + h) - momentum_at(t - h)) / (2 * h);
    const Vec6 reaction = about_origin(run, reaction_of(run.stepper.now(), 0));
    EXPECT_GT(rate.head<3>().norm(), 0.02);  // [N]
    EXPECT_LT((reaction + rate).head<3>().norm(), 1e-6 * rate.head<3>().norm()) << t;
    EXPECT_LT((reaction + rate).tail<3>().norm(), 1e-6 * rate.tail<3>().norm()) << t;
    EXPECT_NEAR(kinetic_energy(run.stepper.now()), energy_of_motion(run), 1e-17);
    EXPECT_NEAR(run.state.energy.motion_work, energy_of_motion(run), 1e-9 * kMass);
  }
}

// A linear motion starts, takes a corner and stops at once. Each time the force is the mean over a
// step.
TEST(CarriedTissue, AJumpOfVelocityIsAnImpulse) {
  constexpr double kSpeed = 0.5, kTime = 0.1;
  MotionLoad load = shift("plate", kTime, {kSpeed * kTime / 2, kSpeed * kTime / 2, 0});
  load.motion.time.insert(load.motion.time.begin() + 1, kTime / 2);
  load.motion.translation.insert(load.motion.translation.begin() + 1,
                                 Vec3(kSpeed * kTime / 2, 0, 0));
  Simulation run(carried_block(7e-3, 1, load));
  Vec6 impulse = Vec6::Zero();  // about the origin
  double t = 0, strongest = 0;
  const auto add = [&] {
    const Vec6 reaction = about_origin(run, reaction_of(run.stepper.now(), 0));
    impulse += (run.state.t - t) * reaction;
    strongest = std::max(strongest, reaction.head<3>().norm());
    t = run.state.t;
  };
  run.advance(0.07, add);
  EXPECT_GT(std::abs(momentum(run, Vec3::Zero())[5]), 0.009 * kMass * kSpeed);
  EXPECT_LT((impulse + momentum(run, Vec3::Zero())).norm(), 1e-12 * kMass);
  EXPECT_NEAR(strongest, std::numbers::sqrt2 * kMass * kSpeed / 7e-3, 1e-9);
  EXPECT_NEAR(kinetic_energy(run.stepper.now()), 0.5 * kMass * kSpeed * kSpeed, 1e-15);
  EXPECT_NEAR(run.state.energy.motion_work, 0.5 * kMass * kSpeed * kSpeed, 1e-15);
  run.advance(kTime, add);
  EXPECT_LT(impulse.norm(), 1e-12 * kMass);
  EXPECT_NEAR(run.state.energy.motion_work, 0, 1e-15);
}

struct Balance {
  double momentum = 0;  // missing [N s]
  double loss = 0;      // [J]
};

/// Half way of a block that is carried by its lower face, with the impulse by the trapezoidal rule.
Balance half_way(double h) {
  Simulation run(carried_block(h, 1e-6, smooth_drive({0.03, 0, 0.01}, {0, 0.5, 0})));
  Vec6 impulse = Vec6::Zero();
  double t = 0;
  Vec6 before = about_origin(run, reaction_as_step_begins(run.stepper.now(), 0));
  run.advance(0.05, [&] {
    impulse +=
        0.5 * (run.state.t - t) * (before + about_origin(run, reaction_of(run.stepper.now(), 0)));
    before = about_origin(run, reaction_as_step_begins(run.stepper.now(), 0));
    t = run.state.t;
  });
  const Vec6 gained = momentum(run, Vec3::Zero());
  EXPECT_NEAR(kinetic_energy(run.stepper.now()), energy_of_motion(run), 1e-15);
  EXPECT_GT(run.state.energy.motion_work, 1e-4);
  EXPECT_LT((impulse + gained).head<3>().norm(), 0.02 * gained.head<3>().norm());
  EXPECT_LT((impulse + gained).tail<3>().norm(), 0.02 * gained.tail<3>().norm());
  return {(impulse + gained).norm(), std::abs(run.loss())};
}

// What the plate gives is what the block has in all: momentum, motion and strain.
TEST(CarriedTissue, ImpulseAndWorkOfTheDriveAreWhatTheBlockGains) {
  const Balance coarse = half_way(5e-4), fine = half_way(2.5e-4);
  EXPECT_NEAR(std::log2(coarse.momentum / fine.momentum), 2, 0.4);
  EXPECT_LT(fine.loss, 0.4 * coarse.loss);
  EXPECT_LT(fine.loss, 1e-6);
}

// In equilibrium nothing has inertia.
TEST(CarriedTissue, HasNoInertiaInStatics) {
  Scenario s = carried_block(1e-2, 1, smooth_drive({0.03, 0, 0}, Vec3::Zero()));
  s.analysis = Scenario::Analysis::Static;
  Simulation run(s);
  run.advance(0.02);
  EXPECT_LT(reaction_of(run.stepper.now(), 0).norm(), 1e-12);
  EXPECT_EQ(kinetic_energy(run.stepper.now()), 0);
}

// A disc with a rim of tissue turns on as one body: nothing pulls at the rim but what keeps it on
// its circle.
TEST(CarriedTissue, BeginsToMoveWithTheBodyThatItIsTiedTo) {
  Scenario s = scene(1e-4, Scheme::TrBdf2);
  const Vec3 middle(0.1, 0, 0);
  Body hub = box_body("hub", Body::Kind::Rigid, Vec3::Constant(kSide), middle);
  hub.velocity = {0.3, -0.2, 0.1};
  hub.angular_velocity = {1, -2, 5};
  s.bodies = {
      box_body("rim", Body::Kind::Tissue, Vec3::Constant(kSide), {0.1 + kSide, 0, 0}, {2, 2, 2}),
      hub};
  s.attachments = {attach("rim", "hub", {0, -1, -1}, {0.1 + kSide / 2 + 1e-6, 1, 1})};
  const Simulation run(s);
  const Tissue& rim = run.model.tissues[0];
  for (std::size_t i = 0; i < rim.nodes.size(); ++i) {
    const Vec3 x = rim.X.col(static_cast<Eigen::Index>(i));
    const Vec3 expected = hub.velocity + hub.angular_velocity.cross(x - middle);
    EXPECT_LT((run.now().velocity(rim.nodes[i]) - expected).norm(), 1e-12) << x.transpose();
  }
}

TEST(CarriedTissue, BeginsAsItIsTold) {
  Scenario s = scene(1e-4, Scheme::TrBdf2);
  Body hub = box_body("hub", Body::Kind::Rigid, Vec3::Constant(kSide));
  hub.velocity = {0.3, 0, 0};
  Body rim = box_body("rim", Body::Kind::Tissue, Vec3::Constant(kSide), {kSide, 0, 0}, {2, 2, 2});
  s.bodies = {rim, hub};
  s.attachments = {attach("rim", "hub", {-1, -1, -1}, {kSide / 2 + 1e-6, 1, 1})};
  const auto velocity_at_the_end = [&] {
    const Simulation run(s);
    return Vec3(run.now().velocity(run.model.tissues[0].nodes.back()));
  };
  EXPECT_EQ(velocity_at_the_end(), hub.velocity);
  s.bodies[0].velocity = {0, 0.4, 0};
  EXPECT_EQ(velocity_at_the_end(), s.bodies[0].velocity);
  // Between two bodies it could not move as both do.
  s.bodies[0].velocity = Vec3::Zero();
  s.bodies.push_back(stand("wall"));
  s.attachments.push_back(attach("rim", "wall", {1.5 * kSide - 1e-6, -1, -1}, {1, 1, -0.009}));
  EXPECT_EQ(velocity_at_the_end(), Vec3::Zero());
}

}  // namespace articular::sim::carried_tissue_test
