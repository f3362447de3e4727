// What nothing holds, and what attachments hold whatever the stiffness is.
#include "sim/assembly/rigid_body_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::rigid_body_modes_test {

using Element = TissueMaterial::Element;

struct Shape {
  const char* name;
  Vec3 size;  // [m]
  Eigen::Vector3i cells;
};

const std::vector<Shape> kShapes = {{"bar", {0.01, 0.01, 0.06}, {2, 2, 8}},
                                    {"sheet", {0.03, 0.03, 0.002}, {5, 5, 1}},
                                    {"cube", {0.02, 0.02, 0.02}, {3, 3, 3}}};

/// Attaches the body `tissue` of the scene, of this size about the origin.
struct Ties {
  const char* name;
  std::function<void(Scenario&, const Vec3& size)> attach;
};

constexpr double kSlight = 1e-6;  // [m] around nodes

void tie(Scenario& s, const std::string& tissue, const std::string& to, const Vec3& low,
         const Vec3& high) {
  const Vec3 around = Vec3::Constant(kSlight);
  s.attachments.push_back(attach(tissue, to, low - around, high + around));
}

void tie_lower_end(Scenario& s, const Vec3& size, const std::string& to) {
  tie(s, "tissue", to, -size / 2, {size.x() / 2, size.y() / 2, -size.z() / 2});
}

void tie_upper_end(Scenario& s, const Vec3& size, const std::string& to) {
  tie(s, "tissue", to, {-size.x() / 2, -size.y() / 2, size.z() / 2}, size / 2);
}

void tie_corner(Scenario& s, const Vec3& size, const Vec3& signs) {
  const Vec3 corner = 0.5 * size.cwiseProduct(signs);
  tie(s, "tissue", "wall", corner, corner);
}

const Vec3 kInertia = Vec3::Constant(1e-7);  // [kg m²]

/// Rows of what tissues and rigid bodies hold one another by, down to the wall.
void chain(Scenario& s, const Vec3& size, const Body& middle) {
  tie_lower_end(s, size, "wall");
  s.bodies.push_back(middle);
  tie_upper_end(s, size, "middle");
  Body second = s.bodies[0];
  second.name = "second";
  std::get<BoxGeometry>(second.geometry).center = {0, 0, size.z()};
  s.bodies.push_back(second);
  tie(s, "second", "middle", {-size.x() / 2, -size.y() / 2, size.z() / 2}, size / 2);
}

const std::vector<Ties> kHolds = {
    {"one end", [](Scenario& s, const Vec3& size) { tie_lower_end(s, size, "wall"); }},
    {"both ends",
     [](Scenario& s, const Vec3& size) {
       tie_lower_end(s, size, "wall");
       tie_upper_end(s, size, "wall");
     }},
    {"three corners",
     [](Scenario& s, const Vec3& size) {
       tie_corner(s, size, {-1, -1, -1});
       tie_corner(s, size, {1, -1, -1});
       tie_corner(s, size, {-1, 1, 1});
     }},
    {"a corner and a rigid body without a freedom",
     [](Scenario& s, const Vec3& size) {
       tie_corner(s, size, {-1, -1, 1});
       s.bodies.push_back(mass_body("plate", 1e-3, {0, 0, -size.z() / 2}, kInertia));
       s.bodies.back().hold.emplace().held.fill(true);
       tie_lower_end(s, size, "plate");
     }},
    {"another tissue and a rigid body", [](Scenario& s, const Vec3& size) {
       chain(s, size, mass_body("middle", 1e-3, {0, 0, size.z() / 2}, kInertia));
     }}};

const std::vector<Ties> kTooLittle = {
    {"nothing", [](Scenario&, const Vec3&) {}},
    {"one corner",
     [](Scenario& s, const Vec3& size) {
       tie_corner(s, size, {1, 1, 1});
     }},
    {"two corners",
     [](Scenario& s, const Vec3& size) {
       tie_corner(s, size, {1, 1, 1});
       tie_corner(s, size, {-1, 1, 1});
     }},
    {"a free rigid body",
     [](Scenario& s, const Vec3& size) {
       s.bodies.push_back(mass_body("plate", 1e-3, {0, 0, -size.z() / 2}, kInertia));
       tie_lower_end(s, size, "plate");
     }},
    {"a rigid body that may turn", [](Scenario& s, const Vec3& size) {
       s.bodies.push_back(mass_body("plate", 1e-3, {0, 0, -size.z() / 2}, kInertia));
       s.bodies.back().hold.emplace().held = {true, true, true, true, true, false};
       tie_lower_end(s, size, "plate");
     }}};

Scenario held_by(const Ties& ties, const Shape& shape, Element element, double nu) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("tissue", Body::Kind::Tissue, shape.size, Vec3::Zero(), shape.cells),
              stand("wall")};
  s.bodies[0].material = neo_hookean(20e3, nu);
  s.bodies[0].material->element = element;
  ties.attach(s, shape.size);
  return s;
}

void each_scene(const std::vector<Ties>& all,
                const std::function<void(Simulation&, const std::string& what)>& test) {
  for (const Ties& ties : all)
    for (const Shape& shape : kShapes)
      for (const Element element : {Element::Plain, Element::Smoothed})
        for (const double nu : {0.3, 0.4999}) {
          Simulation run(held_by(ties, shape, element, nu));
          test(run, std::string(shape.name) + " held by " + ties.name +
                        (element == Element::Plain ? ", plain" : ", smoothed"));
        }
}

/// Nodes at random within a fifth of an element: pressures so high that the stiffness is negative
/// in many directions, as where a load step begins.
void shake(Simulation& run) {
  Random random(7);
  const double reach = 0.2 * run.model.trusted_motion;
  Eigen::Ref<Eigen::VectorXd> x = run.state.y.head(3 * run.model.layout.num_free_nodes);
  x += reach * random.vector(x.size());
  run.stepper.restart(run.state);
}

TEST(RigidBodyModes, WhatAttachmentsHoldIsNotLooseWhateverItsStiffness) {
  each_scene(kHolds, [](Simulation& run, const std::string& what) {
    EXPECT_FALSE(run.stepper.loose()) << what;
    shake(run);
    EXPECT_FALSE(run.stepper.loose()) << what;
  });
}

TEST(RigidBodyModes, WhatTheyHoldTooLittleIsLooseAndSaysSo) {
  each_scene(kTooLittle, [](Simulation& run, const std::string& what) {
    const std::optional<RigidBodyMode> loose = run.stepper.loose();
    ASSERT_TRUE(loose) << what;
    EXPECT_NE(loose->words.find("body `"), std::string::npos) << what;
  });
}

/// A mass on two springs in a row along x, drawn out or pressed together.
Scenario between_springs(double slack) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {mass_body("mass", 1e-3), stand("wall")};
  s.bodies[0].inertia = kInertia.asDiagonal();
  s.bodies[0].hold.emplace().held = {false, false, true, true, true, true};
  for (const double side : {-1.0, 1.0}) {
    Ligament spring;
    spring.name = side < 0 ? "left" : "right";
    spring.path = {anchor("mass", Vec3::Zero()), anchor("wall", {side * 0.01, 0, 0})};
    spring.law = Ligament::Law::Linear;
    spring.stiffness = 100;
    spring.slack_length = slack;
    s.ligaments.push_back(spring);
  }
  return s;
}

// Taut, they hold it across too; slack, they do not.
TEST(RigidBodyModes, WhatTautLigamentsHoldIsNotLoose) {
  EXPECT_FALSE(Simulation(between_springs(0.009)).stepper.loose());
  EXPECT_TRUE(Simulation(between_springs(0.011)).stepper.loose());
}

/// Masses in a row that slide along x only, each tied to the next by a taut ligament pair, which
/// couples them; the first one to the wall if the row is held.
Scenario row_of_masses(int count, bool is_held) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {stand("wall")};
  for (int i = 0; i < count; ++i) {
    Body mass = mass_body("mass " + std::to_string(i), 1e-3, {0.01 * i, 0, 0});
    mass.inertia = kInertia.asDiagonal();
    mass.hold.emplace().held = {false, true, true, true, true, true};
    s.bodies.push_back(mass);
  }
  for (int i = is_held ? 0 : 1; i < count; ++i) {
    Ligament spring;
    spring.name = "spring " + std::to_string(i);
    spring.path = {anchor("mass " + std::to_string(i), {0.01 * i, 0, 0}),
                   i == 0 ? anchor("wall", {-0.01, 0, 0})
                          : anchor("mass " + std::to_string(i - 1), {0.01 * (i - 1), 0, 0})};
    spring.law = Ligament::Law::Linear;
    spring.stiffness = 100;
    spring.slack_length = 0.009;
    s.ligaments.push_back(spring);
  }
  return s;
}

TEST(RigidBodyModes, ARowIsLooseAsAWholeOrHeldByItsFirstMass) {
  for (const int count : {1, 2, 30}) {
    EXPECT_FALSE(Simulation(row_of_masses(count, true)).stepper.loose()) << count;
    const auto loose = Simulation(row_of_masses(count, false)).stepper.loose();
    ASSERT_TRUE(loose) << count;
    EXPECT_NE(loose->words.find("1.00 0.00 0.00)"), std::string::npos) << loose->words;
  }
}

// Of two rows the loose one is found, wherever it stands in the list of bodies.
TEST(RigidBodyModes, WhatIsNotCoupledIsLookedAtByItself) {
  for (const bool first : {true, false}) {
    Scenario s = row_of_masses(5, true);
    Body alone = mass_body("alone", 1e-3, {0, 1, 0});
    alone.inertia = kInertia.asDiagonal();
    alone.hold.emplace().held = {true, true, false, true, true, true};
    s.bodies.insert(first ? s.bodies.begin() : s.bodies.end(), alone);
    const auto loose = Simulation(s).stepper.loose();
    ASSERT_TRUE(loose);
    EXPECT_EQ(loose->words.find("body `alone` can shift along (0.00 0.00"), 0U) << loose->words;
  }
}

// The work grows as the cube of what hangs together.
TEST(RigidBodyModes, OfMoreThanAHundredCoupledBodiesNothingIsSaid) {
  EXPECT_TRUE(Simulation(row_of_masses(100, false)).stepper.loose());
  EXPECT_FALSE(Simulation(row_of_masses(101, false)).stepper.loose());
}

/// One rigid body in a static scene.
Scenario one_body(const std::string& name) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {mass_body(name, 1)};
  s.bodies[0].inertia = kInertia.asDiagonal();
  return s;
}

/// A rod that hangs from the wall on a ligament at its upper end. It moves in a plane.
Scenario hanging_rod(bool has_weight) {
  Scenario s = one_body("rod");
  s.bodies.push_back(stand("wall"));
  s.bodies[0].hold.emplace().held = {true, false, false, false, true, true};
  Ligament cord;
  cord.name = "cord";
  cord.path = {anchor("rod", {0, 0, 0.05}), anchor("wall", {0, 0, 0.1})};
  cord.law = Ligament::Law::Linear;
  cord.stiffness = 1e3;
  cord.slack_length = has_weight ? 0.05 - 9.81e-3 : 0.05;
  s.ligaments = {cord};
  if (has_weight) s.loads = {gravity({0, 0, -9.81})};
  return s;
}

// It swings about its upper end as a pendulum does: its weight pulls it upright.
TEST(RigidBodyModes, WhatHangsIsHeldByItsWeight) {
  EXPECT_FALSE(Simulation(hanging_rod(true)).stepper.loose());
  EXPECT_TRUE(Simulation(hanging_rod(false)).stepper.loose());
}

/// A rod on a hinge so far above its middle [m].
Scenario rod_on_a_hinge(double height) {
  Scenario s = one_body("rod");
  Hold& hinge = s.bodies[0].hold.emplace();
  hinge.held = {true, true, true, false, true, true};
  hinge.at = Vec3(0, 0, height);
  s.loads = {gravity({0, 0, -9.81})};
  return s;
}

// Below its hinge it hangs, above it falls over: neither is without a force.
TEST(RigidBodyModes, ARodIsFreeToTurnOnAHingeInItsMiddleAlone) {
  EXPECT_FALSE(Simulation(rod_on_a_hinge(0.05)).stepper.loose());
  EXPECT_TRUE(Simulation(rod_on_a_hinge(0)).stepper.loose());
  EXPECT_FALSE(Simulation(rod_on_a_hinge(-0.05)).stepper.loose());
}

// A slide that stands askew is told in the axes of the world.
TEST(RigidBodyModes, AMotionThatAHoldLeavesFreeIsToldInTheWorldsAxes) {
  Scenario s = one_body("slide");
  Hold& hold = s.bodies[0].hold.emplace();
  hold.held = {false, true, true, true, true, true};
  hold.axes = rotation_matrix({0, M_PI / 6, 0});
  const auto loose = Simulation(s).stepper.loose();
  ASSERT_TRUE(loose);
  EXPECT_NE(loose->words.find("shift along (0.87 0.00 -0.50)"), std::string::npos) << loose->words;
}

}  // namespace articular::sim::rigid_body_modes_test
