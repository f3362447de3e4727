// Contact from the scenario to the forces, through the Stepper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/mesh/surface.hpp"
#include "sim/build/build_model.hpp"
#include "sim/contact/initial_overlap.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/probes.hpp"

namespace articular::sim::contact_test {

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
  s.bodies[0].material = linear(kYoung, 0);
  s.attachments = {attach("block", "wall", {-1, -1, -1}, {1, 1, -0.49 * kSide})};
  s.contacts = {{"plate", "block", {}}};
  s.loads = {shift("plate", 0.2, {0, 0, -kPress})};
  s.probes = {{"pressed", ContactProbe{"block", "plate"}}, {"plate", ReactionProbe{"plate"}}};
  return s;
}

/// Pressure of a plate on the block, which without lateral contraction is uniform: block and
/// contact are springs in series, p = δ / (H/E + 1/k).
constexpr double kPressure = kPress / (kSide / kYoung + 1 / kStiffness);

void press_to_rest(Simulation& run) {
  run.advance(0.2);
  run.advance(3);  // at rest to 1e-8 by implicit Euler's damping
}

TEST(Contact, AUniformlyPressedBlockHasTheUniformPressureOfSpringsInSeries) {
  Simulation run(press(), contact_stiffness_of(kStiffness));
  press_to_rest(run);
  const Probes probes(run);
  const double area = kSide * kSide, p = kPressure, force = p * area;
  const Vec3 on_block(0, 0, -force);  // named first
  EXPECT_LT((probes.vec3("pressed.force", "N") - on_block).norm(), 1e-6 * force);
  EXPECT_LT(probes.vec3("pressed.moment", "N m").norm(), 1e-6 * force * kSide);
  // On the surface of tissue, whose triangles look for the plate.
  const Vec3 middle(0, 0, kSide / 2 - p * kSide / kYoung);
  EXPECT_LT((probes.vec3("pressed.center", "mm") - 1e3 * middle).norm(), 1e3 * 1e-6 * kSide);
  EXPECT_NEAR(probes("pressed.area [mm^2]"), area * 1e6, 1e-6 * area * 1e6);
  EXPECT_NEAR(probes("pressed.max_pressure [Pa]"), p, 1e-6 * p);
  EXPECT_NEAR(probes("pressed.max_face_pressure [Pa]"), p, 1e-2 * p);  // faces have grown
  const double depth = 1e3 * p / kStiffness;                           // [mm]
  EXPECT_NEAR(probes("pressed.max_penetration [mm]"), depth, 1e-6 * depth);
  EXPECT_NEAR(probes("pressed.max_penetration_at.z [mm]"), 1e3 * middle.z(), 1e3 * 1e-6 * kSide);
  EXPECT_NEAR(probes("pressed.max_point_penetration [mm]"), depth, 1e-6 * depth);
  EXPECT_NEAR(probes("plate.force.z [N]"), force, 1e-6 * force);
  Positions x;
  positions_of(run.now(), run.model.tissues[0].nodes, x);
  const Eigen::MatrixXd stress = run.model.tissues[0].elements.cauchy_stress(x, 0);
  EXPECT_LT((stress.row(2).array() + p).abs().maxCoeff(), 0.02 * p);  // Cauchy's, at 0.9 % strain
}

// At nodes on the block's top and in the middle of the plate's bottom; around the plate's other
// nodes there the block covers too little. What goes through the faces is the force on the body.
TEST(Contact, UniformPressureIsUniformOnTheSurfacesOfBothBodies) {
  Simulation run(press(), contact_stiffness_of(kStiffness));
  press_to_rest(run);
  const double p = kPressure, force = p * kSide * kSide;
  const std::vector<SurfaceContact> surfaces =
      surface_contacts(run.model, run.stepper.now().contact, run.now());
  for (const std::size_t b : {0, 1}) {
    const Collider& collider = *run.model.bodies[b].collider;
    const double touching = kSide / 2, outward = b == 0 ? 1 : -1;
    const SurfaceContact& surface = surfaces[b];
    ASSERT_EQ(surface.node_pressure.size(), collider.X.cols());
    for (Eigen::Index i = 0; i < collider.X.cols(); ++i) {
      const bool touches = std::abs(collider.X(2, i) - touching) < 1e-9;
      const bool is_sliver = touches && b == 1 && collider.X.col(i).head<2>().norm() > 1e-9;
      if (is_sliver) {
        EXPECT_FALSE(surface.node_pressure[i] > 0.9 * p);
        continue;
      }
      EXPECT_NEAR(surface.node_pressure[i], touches ? p : 0, 1e-6 * p) << "body " << b;
    }
    Vec3 through_faces = Vec3::Zero();
    ASSERT_EQ(surface.face_pressure.size(), collider.surface.faces.cols());
    ASSERT_EQ(surface.face_gap.size(), collider.surface.faces.cols());
    for (Eigen::Index f = 0; f < collider.surface.faces.cols(); ++f) {
      Mat3 corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) = run.now().position(
            collider.nodes[static_cast<std::size_t>(collider.surface.faces(k, f))]);
      const FlatTriangle face = flat_triangle(corners);
      through_faces -= surface.face_pressure[f] * face.twice_area / 2 * face.normal;
      if (surface.face_pressure[f] > 1e-6 * p) {
        EXPECT_NEAR(face.normal.z(), outward, 1e-6);
        EXPECT_NEAR(surface.face_gap[f], -p / kStiffness, 1e-6 * p / kStiffness);
      } else {
        EXPECT_TRUE(std::isnan(surface.face_gap[f]));
      }
    }
    EXPECT_LT((through_faces - Vec3(0, 0, -outward * force)).norm(), 1e-6 * force) << "body " << b;
  }
}

// A plate tilted by θ sinks δ + θ x into a block that is stiff beside the contact: the centre of
// its pressure k (δ + θ x) lies at θ L²/12δ.
TEST(Contact, TheCentreOfPressureOfATiltedPlateIsWhereTheMomentVanishes) {
  constexpr double tilt = 0.01;
  Scenario s = press();
  std::get<BoxGeometry>(s.bodies[0].geometry).cells = {8, 8, 1};
  s.bodies[0].material = linear(1e5 * kStiffness * kSide, 0);
  Motion& motion = std::get<MotionLoad>(s.loads[0]).motion;
  motion.rotation = {Vec3::Zero(), tilt * Vec3::UnitY()};
  motion.about = {0, 0, kSide / 2};
  s.contact_response = Scenario::Response::Pointwise;  // linear from edge to edge
  Simulation run(s, contact_stiffness_of(kStiffness));
  press_to_rest(run);
  const Probes probes(run);
  const Vec3 force = probes.vec3("pressed.force", "N"),
             moment = probes.vec3("pressed.moment", "N m");
  const Vec3 center = 1e-3 * probes.vec3("pressed.center", "mm");
  const double expected = tilt * kSide * kSide / (12 * kPress);
  EXPECT_NEAR(center.x(), expected, 2e-3 * expected);
  EXPECT_NEAR(center.y(), 0, 1e-3 * expected);
  EXPECT_LT(moment.norm(), 5e-3 * force.norm() * expected);
  EXPECT_GT(probes("pressed.max_penetration_at.x [mm]"), 0.49e3 * kSide);
  // On the plate the opposite acts, at the same place.
  const int rigid = run.model.bodies[1].rigid;
  const Vec3 lever = center - run.now().poses[static_cast<std::size_t>(rigid)].p;
  const Vec3 on_plate = -(moment + lever.cross(force));
  EXPECT_LT((probes.vec3("plate.force", "N") + force).norm(), 1e-6 * force.norm());
  EXPECT_LT((probes.vec3("plate.moment", "N m") - on_plate).norm(),
            1e-6 * force.norm() * lever.norm());
}

TEST(Contact, AProbeOfBodiesThatDoNotTouchHasNoPlace) {
  Scenario s = press();
  s.loads[0] = shift("plate", 0.2, {0, 0, kPress});
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(0.2);
  const Probes probes(run);
  EXPECT_TRUE(probes.vec3("pressed.center", "mm").array().isNaN().all());
  EXPECT_TRUE(probes.vec3("pressed.max_penetration_at", "mm").array().isNaN().all());
  EXPECT_EQ(probes.vec3("pressed.force", "N"), Vec3::Zero());
  EXPECT_EQ(probes("pressed.max_point_penetration [mm]"), 0);
}

TEST(Contact, NodalContactForcesOfBothBodiesBalanceTheProbe) {
  Simulation run(press(), contact_stiffness_of(kStiffness));
  run.advance(0.2);
  const std::vector<Positions> forces = run.stepper.contact_forces();
  const Vec3 on_block = forces[0].rowwise().sum(), on_plate = forces[1].rowwise().sum();
  const Vec3 probe = run.stepper.dynamics().contact_summary(0).force;  // on the plate, named first
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
  for (const ContactId c : run.model.contacts.all()) {
    const ContactModel contact = run.model.contacts[c];
    const double force = run.stepper.dynamics().contact_summary(c).force.z();  // on the first body
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
    run.advance(0.02, [&] {
      most = std::max(most, run.stepper.dynamics().contact_summary(0).force.norm());
    });
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
  v.geometry = VShapeGeometry{0.02, 0.004, 0.5, {7, 2}};
  v.density = 1000;
  v.material = neo_hookean(50e3, 0.3);
  s.bodies = {v, stand("left"), stand("right")};
  s.contacts = {{"v", "v", {}}};
  s.attachments = {attach("v", "left", {-1, -1, 0}, {-0.0064, 1, 1}),
                   attach("v", "right", {0.0064, -1, 0}, {1, 1, 1})};
  s.integrator.position_tolerance = 1e-7;
  s.loads = {shift("left", 0.2, {3.7e-3, 0, 0}), shift("right", 0.2, {-3.7e-3, 0, 0})};
  Simulation run(s);
  const double element = 0.002;
  run.advance(0.2);
  EXPECT_GT(run.state.counts.reported_pairs, 0);
  const ContactSummary contact = run.stepper.dynamics().contact_summary(0);
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
  s.bodies = {box_body("table", Body::Kind::Fixed, {kSide, kSide, kSide}, {0, 0, -kSide}),
              box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, {0, 0, 0.1 * kSide})};
  s.loads = {gravity({0, 0, -1})};
  Simulation run(s, detection_margin_of(1e-3));
  run.advance(0.02);
  EXPECT_EQ(run.state.counts.steps, 20);
  EXPECT_EQ(run.state.counts.tree_updates, 20);
}

// A plate from a surface file, thinner than its triangles are long: what collides under each of its
// faces does not come out on the other one.
TEST(Contact, ABallAboveAThinPlateDoesNotOverlapIt) {
  const TemporaryFolder folder;
  MeshData plate = box_mesh({Vec3(0.04, 0.04, 0.002), {4, 4, 1}, Vec3::Zero()});
  plate.triangles = collision::build_surface(plate.tets, static_cast<int>(plate.X.cols())).faces;
  plate.tets.resize(4, 0);
  Scenario s = scene(1e-3);
  s.contact = true;
  Body ball;
  ball.name = "ball";
  ball.kind = Body::Kind::Rigid;
  ball.density = 1000;
  for (const double gap : {0.5e-3, 5e-3}) {
    ball.geometry = SphereGeometry{0.005, 0.002, {0, 0, 0.001 + 0.005 + gap}};
    s.bodies = {mesh_body("plate", Body::Kind::Fixed, plate, folder), ball};
    EXPECT_TRUE(initial_overlaps(build_model(s)).empty()) << gap;
  }
  ball.geometry = SphereGeometry{0.005, 0.002, {0, 0, 0.001 + 0.005 - 0.5e-3}};
  s.bodies[1] = ball;
  EXPECT_EQ(initial_overlaps(build_model(s)).size(), 1U);
}

// A corner of the upper block, a hundredth of a side deep in the lower one; the third block, flush
// with the lower one, does not overlap it.
TEST(Contact, OverlapsAtTheStartAreFoundWithTheirDepth) {
  Scenario s = scene(1e-3);
  s.contact = true;
  const Vec3 size = Vec3::Constant(kSide);
  s.bodies = {box_body("lower", Body::Kind::Tissue, size, Vec3::Zero(), {3, 3, 3}),
              box_body("upper", Body::Kind::Tissue, size, Vec3(0.8, 0.7, 0.99) * kSide, {2, 2, 2}),
              box_body("flush", Body::Kind::Tissue, size, Vec3(-1, 0, 0) * kSide, {2, 2, 2})};
  const std::vector<InitialOverlap> overlaps = initial_overlaps(build_model(s));
  ASSERT_EQ(overlaps.size(), 1U);
  EXPECT_EQ(overlaps[0].a, 0);
  EXPECT_EQ(overlaps[0].b, 1);
  EXPECT_NEAR(overlaps[0].depth, 0.01 * kSide, 1e-12);
  // Its lower corner, and the upper corner of the lower block.
  EXPECT_EQ(overlaps[0].num_nodes, 2);
  EXPECT_NEAR(std::abs(overlaps[0].place.z() - 0.495 * kSide), 0.005 * kSide, 1e-12);
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

}  // namespace articular::sim::contact_test
