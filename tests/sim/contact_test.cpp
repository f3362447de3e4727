// Contact from the scenario to the forces, through the Stepper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene.hpp"
#include "sim/history.hpp"

namespace articular::sim {
namespace {

constexpr double kSide = 0.02;  // of the blocks [m]

/// A tissue block on a wall, under a larger rigid plate that is pressed down.
constexpr double kPress = 2e-4;     // [m]
constexpr double kStiffness = 1e7;  // of the contact [Pa/m]
constexpr double kYoung = 20e3;     // [Pa]

Scenario press() {
  Scenario s = scene(0.02);
  s.contact = true;
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, Vec3::Zero(), {2, 2, 2}),
      box_body("plate", Body::Kind::Fixed, {2 * kSide, 2 * kSide, kSide}, {0, 0, kSide}, {2, 2, 1}),
      stand("wall")};
  s.bodies[0].material = material_of(fem::Linear(kYoung, 0));
  s.attachments = {attach("block", "wall", {-1, -1, -1}, {1, 1, -0.49 * kSide})};
  s.contacts = {{"plate", "block", kStiffness, {}}};
  s.loads = {shift("plate", 0.2, {0, 0, -kPress})};
  Probe contact;
  contact.name = "pressed";
  contact.kind = Probe::Kind::Contact;
  contact.body = "block";
  contact.other = "plate";
  Probe reaction;
  reaction.name = "plate";
  reaction.kind = Probe::Kind::Reaction;
  reaction.body = "plate";
  s.probes = {contact, reaction};
  return s;
}

// Without lateral contraction the block and the contact are springs in series:
// p = δ / (H/E + 1/k), uniform, because R7 passes the patch test.
TEST(Contact, AUniformlyPressedBlockHasTheUniformPressureOfSpringsInSeries) {
  Simulation run(press());
  run.advance(0.2);
  run.advance(3);  // at rest to 1e-8 by implicit Euler's damping
  History history(run.model);
  history.record(run.state, run.stepper);
  const std::vector<double>& row = history.last();
  const double area = kSide * kSide, p = kPress / (kSide / kYoung + 1 / kStiffness);
  ASSERT_EQ(row.size(), 1U + 6U + 6U);
  EXPECT_NEAR(row[1], 0, 1e-6 * p * area);
  EXPECT_NEAR(row[2], 0, 1e-6 * p * area);
  EXPECT_NEAR(row[3], -p * area, 1e-6 * p * area);     // force on the block, named first
  EXPECT_NEAR(row[4], area * 1e6, 1e-6 * area * 1e6);  // [mm²]
  EXPECT_NEAR(row[5], p, 1e-6 * p);
  EXPECT_NEAR(row[6], 1e3 * p / kStiffness, 1e-6 * 1e3 * p / kStiffness);  // [mm]
  EXPECT_NEAR(row[9], p * area, 1e-6 * p * area);                          // reaction on the plate
  Positions x;
  positions_of(run.now(), run.model.tissues[0].nodes, x);
  const Eigen::MatrixXd stress = run.model.tissues[0].elements.cauchy_stress(x, 0);
  EXPECT_LT((stress.row(2).array() + p).abs().maxCoeff(), 0.02 * p);  // Cauchy's, at 0.9 % strain
}

TEST(Contact, NodalContactForcesOfBothBodiesBalanceTheProbe) {
  Simulation run(press());
  run.advance(0.2);
  const std::vector<Positions> forces = run.stepper.contact_forces();
  const Vec3 on_block = forces[0].rowwise().sum(), on_plate = forces[1].rowwise().sum();
  const Vec3 probe = run.stepper.dynamics().contacts()[0].force;  // on the plate, named first
  EXPECT_GT(probe.z(), 0);
  EXPECT_NEAR((on_plate - probe).norm(), 0, 1e-12 * probe.norm());
  EXPECT_NEAR((on_block + probe).norm(), 0, 1e-12 * probe.norm());
}

// The lower block's sides sink in by the penetration too; seen from them the table's far sides are
// 30 mm deep, which must not count.
TEST(Contact, ABlockThatRestsOnAnotherCarriesItsWeight) {
  Scenario s = scene(5e-3);
  s.contact = true;
  s.bodies = {box_body("table", Body::Kind::Fixed, {2 * kSide, 2 * kSide, kSide}, {0, 0, -kSide}),
              box_body("lower", Body::Kind::Tissue, {kSide, kSide, kSide}, Vec3::Zero(), {2, 2, 2}),
              box_body("upper", Body::Kind::Tissue, {0.6 * kSide, 0.6 * kSide, 0.6 * kSide},
                       {0, 0, 0.8 * kSide}, {1, 1, 1})};
  s.loads = {gravity({0, 0, -10})};
  Simulation run(s);
  run.advance(1.5);
  EXPECT_LT(run.state.max_penetration, 1e-4);
  EXPECT_EQ(run.state.counts.rejected_newton, 0);
  const double lower = 1000 * 10 * std::pow(kSide, 3), upper = lower * std::pow(0.6, 3);
  for (std::size_t c = 0; c < run.model.contacts.size(); ++c) {
    const ContactModel& contact = run.model.contacts[c];
    const double force = run.stepper.dynamics().contacts()[c].force.z();  // on the first body
    if (contact.a == 0 && contact.b == 1) {
      EXPECT_NEAR(force, -(lower + upper), 1e-4 * lower);
    }
    if (contact.a == 1 && contact.b == 2) {
      EXPECT_NEAR(force, -upper, 1e-4 * upper);
    }
    if (contact.a == 0 && contact.b == 2) {
      EXPECT_EQ(force, 0);
    }
  }
  EXPECT_NEAR(run.force_on(0).z(), -(lower + upper), 1e-4 * lower);
}

Vec3 momentum(const Simulation& run) {
  Vec3 sum = Vec3::Zero();
  for (const Tissue& tissue : run.model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      sum += tissue.lumped_mass[static_cast<Eigen::Index>(i)] * run.now().velocity(tissue.nodes[i]);
  return sum;
}

// The columns of every Newton matrix sum to the masses, contact included: each iteration keeps the
// momentum, converged or not.
TEST(Contact, TwoBlocksThatCollideKeepTheirMomentumToRoundOff) {
  for (const auto scheme : {Integrator::Scheme::ImplicitEuler, Integrator::Scheme::TrBdf2}) {
    Scenario s = scene(1e-3, scheme);
    s.contact = true;
    s.integrator.position_tolerance = 1e-7;
    s.bodies = {
        box_body("a", Body::Kind::Tissue, {kSide, kSide, kSide}, {-1.05 * kSide, 0, 0}, {2, 2, 2}),
        box_body("b", Body::Kind::Tissue, {kSide, kSide, kSide}, {0, 0.3 * kSide, 0}, {2, 2, 2})};
    s.bodies[0].velocity = {0.5, 0, 0};
    Simulation run(s);
    const Vec3 start = momentum(run);
    double most = 0;
    run.advance(0.02,
                [&] { most = std::max(most, run.stepper.dynamics().contacts()[0].force.norm()); });
    EXPECT_GT(most, 0.01);  // they met
    EXPECT_LT((momentum(run) - start).norm(), 1e-10 * start.norm());
  }
}

// The outer edges of the legs' ends are drawn towards each other by 0.4 mm more than the gap
// between the inner sides.
TEST(Contact, TheLegsOfAClosingVMeetAndDoNotPassThroughEachOther) {
  Scenario s = scene(5e-3);
  s.contact = true;
  Body v;
  v.name = "v";
  v.v_shape = VShapeGeometry{0.02, 0.004, 0.5, {7, 2}};
  v.density = 1000;
  v.material = material_of(fem::NeoHookean(50e3, 0.3));
  s.bodies = {v, stand("left"), stand("right")};
  s.contacts = {{"v", "v", {}, {}}};
  s.attachments = {attach("v", "left", {-1, -1, 0}, {-0.0064, 1, 1}),
                   attach("v", "right", {0.0064, -1, 0}, {1, 1, 1})};
  s.integrator.position_tolerance = 1e-7;
  s.loads = {shift("left", 0.2, {3.4e-3, 0, 0}), shift("right", 0.2, {-3.4e-3, 0, 0})};
  Simulation run(s);
  const double element = 0.002;
  run.advance(0.2);
  EXPECT_GT(run.state.counts.reported_pairs, 0);
  const ContactSummary contact = run.stepper.dynamics().contacts()[0];
  EXPECT_GT(contact.area, 1e-6);  // [m²]
  EXPECT_LT(run.state.max_penetration, 0.25 * element);
  EXPECT_LT(Vec3(run.stepper.contact_forces()[0].rowwise().sum()).norm(), 1e-14);  // on itself
  // By symmetry the plane x = 0 parts the legs.
  const Tissue& tissue = run.model.tissues[0];
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const double X = tissue.X(0, static_cast<Eigen::Index>(i));
    if (X > 1e-9) {
      EXPECT_GT(run.now().position(tissue.nodes[i]).x(), -0.15 * element);
    }
  }
}

TEST(Contact, WithoutContactThereAreNoTrees) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("a", Body::Kind::Tissue, {kSide, kSide, kSide}),
              box_body("b", Body::Kind::Fixed, {kSide, kSide, kSide}, {0, 0, -kSide})};
  Simulation run(s);
  run.advance(0.01);
  EXPECT_EQ(run.state.counts.tree_updates, 0);
  EXPECT_EQ(run.state.counts.reported_pairs, 0);
  EXPECT_FALSE(run.model.bodies[0].collider);
}

// Nothing moves faster than the margin covers, so that it stays as it is.
TEST(Contact, AFixedBodyIsMappedOnceForAMargin) {
  Scenario s = scene(1e-3);
  s.contact = true;
  s.detection.margin = 1e-3;
  s.bodies = {box_body("table", Body::Kind::Fixed, {kSide, kSide, kSide}, {0, 0, -kSide}),
              box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, {0, 0, 0.1 * kSide})};
  s.loads = {gravity({0, 0, -1})};
  Simulation run(s);
  run.advance(0.02);
  EXPECT_EQ(run.state.counts.steps, 20);
  EXPECT_EQ(run.state.counts.tree_updates, 20);
}

TEST(Contact, TwoFixedBodiesDoNotTouch) {
  Scenario s = scene(1e-3);
  s.contact = true;
  s.bodies = {box_body("a", Body::Kind::Fixed, Vec3::Ones()),
              box_body("b", Body::Kind::Fixed, Vec3::Ones())};
  EXPECT_TRUE(build_model(s).contacts.empty());
}

// A fast block in steps that carry it twice its own margin: the detection follows.
TEST(Contact, AFastBlockDoesNotFallThroughATable) {
  Scenario s = scene(2e-3);
  s.contact = true;
  s.bodies = {
      box_body("table", Body::Kind::Fixed, {2 * kSide, 2 * kSide, kSide}, {0, 0, -kSide},
               {2, 2, 1}),
      box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, {0, 0, 0.5 * kSide}, {2, 2, 2})};
  s.bodies[1].velocity = {0, 0, -1};
  Simulation run(s);
  run.advance(0.05);
  EXPECT_GT(run.state.max_penetration, 0);
  const Tissue& tissue = run.model.tissues[0];
  for (const NodeRef& node : tissue.nodes)
    EXPECT_GT(run.now().position(node).z(), -0.5 * kSide - 2e-3);
}

}  // namespace
}  // namespace articular::sim
