// A block of tissue that is dropped on another.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_drop_test {

constexpr double kGravity = 9.81;  // [m/s²]

/// A soft cube that falls onto a larger one; both meshes are symmetric (even numbers of cells).
struct Drop {
  int upper_cells, lower_cells;
  double step, duration;  // [s]
};
constexpr double kUpper = 0.1, kLower = 0.2, kFall = 0.01;  // [m]

Scenario dropped_block(const Drop& drop) {
  Scenario s = contact_scene(drop.step);
  s.bodies = {box_body("lower", Body::Kind::Tissue, Vec3::Constant(kLower), {0, 0, -kLower / 2},
                       Eigen::Vector3i::Constant(drop.lower_cells)),
              box_body("upper", Body::Kind::Tissue, Vec3::Constant(kUpper),
                       {0, 0, kFall + kUpper / 2}, Eigen::Vector3i::Constant(drop.upper_cells)),
              stand("floor")};
  for (std::size_t b : {0U, 1U}) s.bodies[b].material = neo_hookean(1e5, 0.45);
  s.attachments = {attach("lower", "floor", {-1, -1, -1}, {1, 1, -kLower + 1e-6})};
  s.loads = {gravity({0, 0, -kGravity})};
  return s;
}

/// Its centre of mass [m].
Vec3 center_of_upper(const Simulation& run) {
  const Eigen::VectorXd& mass = run.model.tissues[1].lumped_mass;
  return nodes_of(run, 1) * mass / mass.sum();
}

class DroppedBlock : public testing::TestWithParam<Drop> {};

// Without friction and without anything that turns it, the upper block keeps its place and its
// corners level: what rocks or slides would come from the contact.
TEST_P(DroppedBlock, ComesToRestLevelWhereItFell) {
  Simulation run(dropped_block(GetParam()));
  double most_kinetic = 0;
  run.advance(GetParam().duration,
              [&] { most_kinetic = std::max(most_kinetic, kinetic_energy(run)); });
  EXPECT_GT(most_kinetic, 0.9 * kGravity * kFall);  // [J], of 1 kg
  EXPECT_LT(kinetic_energy(run), 1e-8 * most_kinetic);

  const Tissue& upper = run.model.tissues[1];
  const Positions x = nodes_of(run, 1);
  double lowest = 1, highest = -1;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 X = upper.X.col(i);
    const bool corner = std::min(std::abs(X.x()), std::abs(X.y())) > 0.499 * kUpper &&
                        X.z() > kFall + 0.99 * kUpper;
    if (!corner) continue;
    lowest = std::min(lowest, x(2, i));
    highest = std::max(highest, x(2, i));
  }
  EXPECT_GT(highest, kUpper - kFall);  // there are corners, and they are above the lower block
  EXPECT_LT(highest - lowest, 1e-6);
  EXPECT_LT(center_of_upper(run).head<2>().norm(), 1e-6);

  const double weight = upper.lumped_mass.sum() * kGravity;
  EXPECT_NEAR(run.stepper.dynamics().contact_summary(0).force.norm(), weight, 1e-3 * weight);
  double deepest = 0;  // now, not at the impact
  for (const ContactSummary& contact : run.stepper.dynamics().contacts())
    deepest = std::max(deepest, contact.max_depth);
  EXPECT_LT(deepest, 0.01 * kUpper / GetParam().upper_cells);
  EXPECT_GT(least_volume_ratio(run), 0);
}

// Odd numbers of cells leave the mesh without symmetry, and the surface below tilted by what its
// elements are off. Without friction the block slides away, ever faster: nearer to the edge it
// sinks in deeper, so that its place in the middle is one of unstable equilibrium.
TEST(ABlockDropped, OnAMeshWithoutSymmetryRestsByFriction) {
  const Drop drop{7, 9, 5e-3, 2};
  Scenario s = dropped_block(drop);
  ContactPair pair;
  pair.a = "lower";
  pair.b = "upper";
  pair.friction = 0.3;
  s.contacts = {pair};
  Simulation run(s);
  double most_kinetic = 0;
  run.advance(drop.duration, [&] { most_kinetic = std::max(most_kinetic, kinetic_energy(run)); });
  EXPECT_LT(kinetic_energy(run), 1e-7 * most_kinetic);
  const Tissue& upper = run.model.tissues[1];
  EXPECT_LT(center_of_upper(run).head<2>().norm(), 1e-3 * kUpper);
  const ContactSummary contact = run.stepper.dynamics().contact_summary(0);
  EXPECT_LT(contact.max_depth, 0.01 * kUpper / drop.upper_cells);
  EXPECT_NEAR(contact.force.z(), -upper.lumped_mass.sum() * kGravity,
              1e-3 * upper.lumped_mass.sum() * kGravity);
}

INSTANTIATE_TEST_SUITE_P(Meshes, DroppedBlock,
                         testing::Values(Drop{4, 6, 5e-3, 2}, Drop{8, 10, 5e-3, 1},
                                         Drop{10, 12, 5e-3, 1}),
                         [](const auto& drop) {
                           return std::to_string(drop.param.upper_cells) + "And" +
                                  std::to_string(drop.param.lower_cells) + "Cells";
                         });

}  // namespace articular::sim::contact_drop_test
