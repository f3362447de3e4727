// Surfaces that go through each other between two states.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/contact/crossing.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::crossing_test {

constexpr double kSide = 0.02, kThick = 0.004;  // [m]
constexpr int kCells = 5;

Body tissue_box(const std::string& name, const Vec3& size, const Vec3& center,
                const Eigen::Vector3i& cells) {
  Body body = box_body(name, Body::Kind::Tissue, size, center, cells);
  body.material->element = TissueMaterial::Element::Plain;
  return body;
}

/// A sheet in the plane z = 0, and a plate 1 mm above it.
Scenario sheet_and_plate(Body::Kind plate = Body::Kind::Fixed) {
  Scenario s = contact_scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {tissue_box("sheet", {kSide, kSide, kThick}, {0, 0, -kThick / 2}, {kCells, kCells, 1}),
              box_body("plate", plate, {0.0091, 0.0083, kThick}, {1e-4, 2e-4, 1e-3 + kThick / 2},
                       {3, 3, 1})};
  if (plate == Body::Kind::Tissue) s.bodies[1].material->element = TissueMaterial::Element::Plain;
  s.contacts = {{"sheet", "plate", {}}};
  return s;
}

/// Moves the nodes and poses of a body of a configuration.
void move(const Model& model, const std::string& name, const Pose& by, Configuration& now) {
  for (const BodyModel& body : model.bodies) {
    if (body.name != name) continue;
    if (body.rigid >= 0) {
      Pose& pose = now.poses[static_cast<std::size_t>(body.rigid)];
      pose = {by.R * pose.p + by.p, by.R * pose.R};
      continue;
    }
    for (const NodeRef& node : model.tissues[static_cast<std::size_t>(body.tissue)].nodes)
      if (node.rigid < 0) now.x.col(node.block) = by.R * now.x.col(node.block) + by.p;
  }
}

Pose shifted(const Vec3& p) { return {p, Mat3::Identity()}; }

/// A model that is moved by hand.
struct Scene {
  explicit Scene(const Scenario& scenario) : model(build_model(scenario)), search(model) {
    const Eigen::VectorXd y = initial_state(model);
    read_state(model, y.data(), 0, start);
  }

  Configuration after(const std::string& body, const Pose& by) const {
    Configuration end = start;
    move(model, body, by, end);
    return end;
  }
  std::optional<Crossing> find(const Configuration& from, const Configuration& to,
                               double depth = 0) {
    ContactDepths depths;
    for (const ContactId contact : model.contacts.all()) depths.add(contact, depth);
    return search.find(from, to, depths);
  }
  std::optional<Crossing> find(const std::string& body, const Pose& by) {
    return find(start, after(body, by));
  }

  Model model;
  CrossingSearch search;
  Configuration start;
};

// Straight down, from above: by less than to the middle of the sheet it has pressed in, by more it
// is through, and the place is where it came in.
TEST(Crossing, APlateIsThroughASheetFromItsMiddleOn) {
  for (const auto kind : {Body::Kind::Fixed, Body::Kind::Tissue}) {
    Scene scene(sheet_and_plate(kind));
    for (const double way : {5e-4, 1e-3, 1.5e-3, 2.9e-3})
      EXPECT_FALSE(scene.find("plate", shifted({0, 0, -way}))) << way;
    for (const double way : {3.1e-3, 4e-3, 5.1e-3, 8e-3, 9.5e-3, 0.1}) {
      const auto crossing = scene.find("plate", shifted({2e-4, 1e-4, -way}));
      ASSERT_TRUE(crossing) << way;
      EXPECT_NE(crossing->body, crossing->through);
      EXPECT_LT(std::abs(crossing->place.x()), 0.01);
      EXPECT_GT(crossing->place.z(), -kThick);
      EXPECT_LT(crossing->place.z(), 1e-3 + 1e-12);
    }
  }
}

// However the scene lies in space, and whichever of the two moves.
TEST(Crossing, IsTheSameInEveryFrameAndForEitherBody) {
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    Scene scene(sheet_and_plate(Body::Kind::Tissue));
    const Pose turn{random.vec3(), rotation_matrix(2 * random.vec3())};
    for (const char* body : {"sheet", "plate"}) move(scene.model, body, turn, scene.start);
    const bool through = k % 2 == 0;
    const double way = through ? 0.006 : 0.0025;
    const Vec3 down = turn.R * Vec3(0, 0, -way);
    EXPECT_EQ(scene.find("plate", shifted(down)).has_value(), through);
    EXPECT_EQ(scene.find("sheet", shifted(-down)).has_value(), through);
  }
}

// From state to state by small steps: what is behind a face keeps the side that it
// came in from.
TEST(Crossing, ASlowPassageIsSeenAtTheMiddleOfTheSheet) {
  Scene scene(sheet_and_plate());
  Configuration from = scene.start;
  double way = 0;
  constexpr double kStep = 2.3e-4;
  while (way < 0.02) {
    const Configuration to = scene.after("plate", shifted({0, 0, -way - kStep}));
    if (scene.find(from, to, std::max(0.0, way - 1e-3))) break;
    from = to;
    way += kStep;
  }
  EXPECT_NEAR(way, 1e-3 + kThick / 2, kStep);
}

TEST(Crossing, BodiesThatSlidePastSeparateAndMeetAgainHaveNotCrossed) {
  Scene scene(sheet_and_plate());
  Configuration pressed = scene.after("plate", shifted({0, 0, -1.2e-3}));  // 0.2 mm deep
  const auto at = [&](const Vec3& p) { return scene.after("plate", shifted(p)); };
  EXPECT_FALSE(scene.find(pressed, at({0.005, 0.003, -1.2e-3}), 2e-4));  // along the sheet
  EXPECT_FALSE(scene.find(pressed, at({0.04, 0, -1.2e-3}), 2e-4));       // off its end
  EXPECT_FALSE(scene.find(pressed, at({0, 0, 0.05}), 2e-4));             // away
  EXPECT_FALSE(scene.find(at({0, 0, 0.05}), pressed, 0));                // and back
  EXPECT_FALSE(scene.find(at({0.04, 0, 0}), at({0.04, 0, -0.02})));      // past its side
  EXPECT_FALSE(scene.find(at({0.04, 0, -0.02}), at({0, 0, -0.02})));     // beneath it
}

// A straight path from above the rim to beside it cuts the corner.
TEST(Crossing, APathThatCutsACornerIsNone) {
  Scene scene(sheet_and_plate());
  for (const double beyond : {2e-4, 1e-3, 5e-3}) {
    const double off = kSide / 2 + 0.0091 / 2 + beyond;
    EXPECT_FALSE(scene.find("plate", shifted({off, 0, -1.5e-3})));
  }
}

// A ball as deep as half its radius in a thick block: the search follows it there.
TEST(Crossing, ADeepPressIsNone) {
  Scenario s = sheet_and_plate();
  s.bodies[0] = tissue_box("sheet", {0.04, 0.04, 0.02}, {0, 0, -0.01}, {10, 10, 5});
  s.bodies[1] = Body{};
  s.bodies[1].name = "plate";
  s.bodies[1].kind = Body::Kind::Fixed;
  s.bodies[1].geometry = SphereGeometry{0.008, 3e-3, {0, 0, 0.0081}};
  Scene scene(s);
  EXPECT_FALSE(scene.find("plate", shifted({0, 0, -4e-3})));
  EXPECT_TRUE(scene.find("plate", shifted({0, 0, -0.03})));
}

// A socket turns around the ball in it by 30 degrees: chords of its motion cut into the ball. (By
// 60 degrees they cut so deep that the step is halved.)
TEST(Crossing, AClosedLoopThatTurnsInAnotherHasNotCrossed) {
  const TemporaryFolder folder;
  Scenario s = sheet_and_plate();
  const auto ring = [](double inner) {
    return bent({{2 * M_PI, 1, 1}, {24, 2, 2}, {M_PI, 0.5, 0.5}}, [=](const Vec3& X) {
      const double r = inner + 0.004 * X.z();
      return Vec3(r * std::sin(X.x()), 0.006 * X.y(), r * std::cos(X.x()));
    });
  };
  s.bodies[0] = mesh_body("sheet", Body::Kind::Tissue, ring(0.0101), folder);
  s.bodies[0].material->element = TissueMaterial::Element::Plain;
  s.bodies[1] = mesh_body("plate", Body::Kind::Fixed, ring(0.006), folder);
  Scene scene(s);
  for (const double angle : {0.1, 0.3, 0.5}) {
    EXPECT_FALSE(scene.find("sheet", {Vec3::Zero(), rotation_matrix({0, angle, 0})}));
    EXPECT_FALSE(scene.find("plate", {Vec3::Zero(), rotation_matrix({0, angle, 0})}));
  }
  EXPECT_FALSE(scene.find("plate", shifted({0, 0.012, 0})));  // drawn out along the axis
  EXPECT_TRUE(scene.find("plate", shifted({0.02, 0, 0})));    // through the wall
}

// Of a bone that is a surface alone nothing is found below its shell, however thick it is.
TEST(Crossing, ASurfaceWithoutElementsIsCrossedBelowItsReach) {
  const TemporaryFolder folder;
  Scenario s = sheet_and_plate();
  s.bodies[1] = mesh_body("plate", Body::Kind::Fixed,
                          skin_of({{0.04, 0.04, 0.04}, {8, 8, 8}, {0, 0, 0.021}}), folder);
  Scene scene(s);
  const double reach = scene.model.bodies[1].collider->reach;
  ASSERT_LT(reach, 0.012);
  EXPECT_FALSE(scene.find("plate", shifted({0, 0, -1e-3 - 0.3 * reach})));
  EXPECT_TRUE(scene.find("plate", shifted({0, 0, -1e-3 - kThick - 1.2 * reach})));
}

// A thin post that comes in between the points of that bone: nothing of the bone meets the post.
TEST(Crossing, APostIsLostBelowTheShellOfASurfaceWithoutElements) {
  const TemporaryFolder folder;
  Scenario s = sheet_and_plate();
  s.bodies[0] = tissue_box("sheet", {8e-4, 8e-4, 0.02}, {1.1e-3, 1.1e-3, -0.01}, {1, 1, 10});
  s.bodies[1] = mesh_body("plate", Body::Kind::Fixed,
                          skin_of({{0.04, 0.04, 0.04}, {8, 8, 8}, {0, 0, 0.021}}), folder);
  Scene scene(s);
  const double reach = scene.model.bodies[1].collider->reach;
  EXPECT_FALSE(scene.find("plate", shifted({0, 0, -1e-3 - 0.9 * reach})));
  const auto crossing = scene.find("plate", shifted({0, 0, -1e-3 - 1.1 * reach}));
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->body, 0);
  EXPECT_EQ(crossing->through, 1);
}

// Tissue that is tied to a bone lies in it, and moves with it.
TEST(Crossing, WhatIsTiedDoesNotCross) {
  Scenario s = sheet_and_plate();
  s.attachments = {attach("sheet", "plate", {-1, -1, -1}, {1, 1, 1})};
  Scene scene(s);
  EXPECT_FALSE(scene.find("plate", shifted({0, 0, -8e-3})));
}

// Two arms of a U: the upper one goes through the lower one.
TEST(Crossing, ABodyThatGoesThroughItselfIsSeen) {
  const TemporaryFolder folder;
  Scenario s = sheet_and_plate();
  const BoxGeometry box{{0.024, 0.006, 0.010}, {12, 3, 5}, {0.012, 0, 0.005}};
  const MeshData u =
      carved(box, [](const Vec3& c) { return c.x() < 0.004 || std::abs(c.z() - 0.005) > 0.003; });
  s.bodies = {mesh_body("u", Body::Kind::Tissue, u, folder)};
  s.bodies[0].material->element = TissueMaterial::Element::Plain;
  s.contacts = {{"u", "u", {}}};
  Scene scene(s);
  const auto sunk = [&](double way) {
    Configuration end = scene.start;
    for (const NodeRef& node : scene.model.tissues[0].nodes) {
      auto x = end.x.col(node.block);
      if (x.z() > 0.007) x.z() -= way * std::max(0.0, (x.x() - 0.004) / 0.020);
    }
    return end;
  };
  EXPECT_FALSE(scene.find(scene.start, sunk(0.005)));
  const auto crossing = scene.find(scene.start, sunk(0.012));
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->body, crossing->through);
  EXPECT_NE(words_for(scene.model, *crossing).find("`u` goes through itself at ("),
            std::string::npos);
}

TEST(Crossing, PairsThatMoveTooLittleAreNotLookedAt) {
  Scene scene(sheet_and_plate());
  (void)scene.find("plate", shifted({0, 0, -5e-4}));  // below half of the reach of 1.8 mm
  EXPECT_EQ(scene.search.pairs_looked_at(), 0);
  (void)scene.find("plate", shifted({0, 0, 0.05}));  // and back
  (void)scene.find("plate", shifted({0.05, 0, 0.05}));
  EXPECT_EQ(scene.search.pairs_looked_at(), 0);
  (void)scene.find("plate", shifted({0, 0, -2e-3}));
  EXPECT_EQ(scene.search.pairs_looked_at(), 1);
}

// The ends of a long plate swing fast, its middle above the sheet is slow.
TEST(Crossing, WhatIsSlowWhereItTouchesIsNotLookedAt) {
  Scenario s = sheet_and_plate();
  s.bodies[1] = box_body("plate", Body::Kind::Fixed, {0.2, 0.0083, kThick},
                         {1e-4, 2e-4, 1e-3 + kThick / 2}, {60, 3, 1});
  Scene scene(s);
  const auto swung = [](double angle, double way) {
    return Pose{{0, 0, -way}, rotation_matrix(Vec3(0, 0, angle))};
  };
  (void)scene.find("plate", swung(0.03, 0));  // its ends by 3 mm
  EXPECT_EQ(scene.search.pairs_looked_at(), 0);
  EXPECT_TRUE(scene.find("plate", swung(0.03, 6e-3)));
  EXPECT_EQ(scene.search.pairs_looked_at(), 1);
}

/// A sheet held at two of its rims, and a plate that a fixed body drives down into it.
Scenario pressed_sheet(double step, double way) {
  Scenario s = sheet_and_plate();
  s.integrator.step = step;
  s.bodies.push_back(stand("frame"));
  s.attachments = {attach("sheet", "frame", {-1, -1, -1}, {-0.0099, 1, 1}),
                   attach("sheet", "frame", {0.0099, -1, -1}, {1, 1, 1})};
  s.loads = {shift("plate", 1, {0, 0, -way})};
  return s;
}

// One large load step carries the plate to beyond the sheet: it is cut, and ends where many small
// ones end.
TEST(CrossingInStatics, ALoadStepThatPassesASheetIsCutAndEndsInTheRightForce) {
  for (const double way : {3e-3, 4e-3}) {
    Simulation at_once(pressed_sheet(1, way)), slowly(pressed_sheet(0.05, way));
    at_once.advance(1);
    slowly.advance(1);
    const int plate = bone_of(slowly, "plate");
    const double force = slowly.force_on(plate).z();
    EXPECT_GT(force, 0.02);  // [N]
    EXPECT_NEAR(at_once.force_on(plate).z(), force, 1e-3 * force) << way;
  }
}

std::string error_of(Simulation& run, double until) {
  try {
    run.advance(until);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

// Both are driven, nothing can give way.
TEST(Crossing, WhatNoShorterStepPreventsIsAnErrorThatNamesBothBodiesAndThePlace) {
  for (const auto analysis : {Scenario::Analysis::Static, Scenario::Analysis::Dynamic}) {
    Scenario s = sheet_and_plate();
    s.analysis = analysis;
    s.integrator.step = analysis == Scenario::Analysis::Static ? 0.25 : 1e-3;
    s.bodies.push_back(stand("frame"));
    s.attachments = {attach("sheet", "frame", {-1, -1, -1}, {1, 1, 1})};
    s.loads = {shift("plate", 1, {0, 0, -0.01})};
    Simulation run(s);
    const std::string error = error_of(run, 1);
    EXPECT_NE(error.find("surfaces go through each other in a step of"), std::string::npos)
        << error;
    for (const char* name : {"`sheet`", "`plate`", " goes through ", " at (", ") mm, by "})
      EXPECT_NE(error.find(name), std::string::npos) << error;
    const double fallen = 0.5 * kThick + 1e-3;  // of 10 mm
    EXPECT_LT(run.now().poses[0].p.z(), 1e-3 + kThick / 2 - 0.9 * fallen);
    EXPECT_GT(run.now().poses[0].p.z(), 1e-3 + kThick / 2 - 1.1 * fallen);
  }
}

// A light plate that a strong force throws at a sheet, with a step that would carry it through:
// the velocity at its start says nothing of it.
TEST(Crossing, AFastBodyInTimeIsNoticed) {
  Scenario s = pressed_sheet(2e-3, 0);
  s.analysis = Scenario::Analysis::Dynamic;
  s.bodies[1].kind = Body::Kind::Rigid;
  s.bodies[1].density = 1000;
  ForceLoad force;
  force.at = anchor("plate", {1e-4, 2e-4, 1e-3 + kThick / 2});
  force.force = {0, 0, -2};
  s.loads = {force};
  // Without the guard of long ways, which would shorten the step first.
  Simulation run(s, [](Model& model) { model.trusted_motion *= 100; });
  const std::string error = error_of(run, 0.02);
  EXPECT_GT(run.state.counts.rejected_motion, 0);
  if (error.empty()) {
    EXPECT_GT(run.now().poses[0].p.z(), -kThick / 2);
  }
}

}  // namespace articular::sim::crossing_test
