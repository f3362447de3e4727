// A body that stands in the scene twice.
#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::coincident_bodies_test {

constexpr double kSide = 0.01;  // [m]

Scenario two_boxes(const Vec3& apart, Body::Kind second) {
  Scenario s = contact_scene(1e-3);
  const Vec3 size = Vec3::Constant(kSide);
  s.bodies = {box_body("one", Body::Kind::Tissue, size, {0.1, 0.2, 0.3}, {2, 2, 2}),
              box_body("two", second, size, Vec3(0.1, 0.2, 0.3) + apart, {2, 2, 2})};
  return s;
}

std::string error_of(const Scenario& scenario) {
  try {
    (void)build_model(scenario);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CoincidentBodies, TheSameMeshAtTheSamePlaceIsRefusedWithBothNames) {
  for (const Body::Kind kind : {Body::Kind::Tissue, Body::Kind::Rigid, Body::Kind::Fixed})
    for (const double rounding : {0.0, 1e-13, 1e-6}) {
      const std::string message = error_of(two_boxes(Vec3::Constant(rounding), kind));
      EXPECT_NE(message.find("bodies `one` and `two` are the same body at the same place"),
                std::string::npos)
          << message;
    }
}

TEST(CoincidentBodies, TheSameShapeInOtherElementsIsRefusedToo) {
  for (const Eigen::Vector3i& cells : {Eigen::Vector3i(3, 3, 3), Eigen::Vector3i(1, 5, 2)}) {
    Scenario s = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
    std::get<BoxGeometry>(s.bodies[1].geometry).cells = cells;
    EXPECT_NE(error_of(s).find("`one` and `two` are the same body"), std::string::npos);
  }
  Scenario balls = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
  balls.bodies[0].geometry = SphereGeometry{kSide, 3e-3, Vec3::Zero()};
  balls.bodies[1].geometry = SphereGeometry{kSide, 2e-3, Vec3::Zero()};
  EXPECT_NE(error_of(balls).find("`one` and `two` are the same body"), std::string::npos);
  balls.bodies[1].geometry = SphereGeometry{kSide, 2e-3, {0, 0, 1.9 * kSide}};
  EXPECT_EQ(error_of(balls), "");
}

// Two rigid sheets face to face, with nothing between: a joint in which they touch everywhere.
TEST(CoincidentBodies, SheetsThatFaceEachOtherAreTwo) {
  const TemporaryFolder folder;
  MeshData sheet;
  sheet.X.resize(3, 4);
  sheet.X << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  sheet.X *= kSide;
  sheet.triangles.resize(3, 2);
  sheet.triangles << 0, 0, 1, 2, 2, 3;
  MeshData other = sheet;
  other.triangles.row(0).swap(other.triangles.row(1));
  Scenario s = two_boxes(Vec3::Zero(), Body::Kind::Fixed);
  s.bodies = {mesh_body("one", Body::Kind::Rigid, sheet, folder),
              mesh_body("two", Body::Kind::Rigid, other, folder)};
  for (Body& body : s.bodies) {
    body.density.reset();
    body.mass = 1;
    body.center_of_mass = Vec3::Zero();
    body.inertia = Mat3::Identity();
  }
  EXPECT_EQ(error_of(s), "");
  s.bodies[1] = mesh_body("two", Body::Kind::Fixed, sheet, folder);
  EXPECT_NE(error_of(s).find("`one` and `two` are the same body"), std::string::npos);
}

// Tissue in tissue, bone in tissue, tissue in a bone that is a surface alone.
TEST(CoincidentBodies, ABodyWhollyInsideAnotherIsRefusedWithBothNames) {
  const TemporaryFolder folder;
  Scenario s = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
  const BoxGeometry around{Vec3::Constant(0.1), {10, 10, 10}, {0.1, 0.2, 0.3}};
  for (const Body& large :
       {box_body("large", Body::Kind::Tissue, around.size, around.center, around.cells),
        box_body("large", Body::Kind::Fixed, around.size, around.center, around.cells),
        mesh_body("large", Body::Kind::Fixed, skin_of(around), folder)})
    for (const Body::Kind kind : {Body::Kind::Tissue, Body::Kind::Rigid})
      for (const bool first : {true, false}) {
        const Body small = box_body("small", kind, Vec3::Constant(0.01), {0.12, 0.19, 0.3});
        s.bodies = first ? std::vector{small, large} : std::vector{large, small};
        if (kind == Body::Kind::Rigid && large.kind == Body::Kind::Fixed && first) continue;
        EXPECT_NE(error_of(s).find("body `small` lies wholly inside `large`"), std::string::npos)
            << error_of(s);
        for (Body& body : s.bodies)
          if (body.name == "small")
            std::get<BoxGeometry>(body.geometry).center.x() = 0.146;  // looks out
        EXPECT_EQ(error_of(s), "");
      }
}

// Wherever in a box of few large faces: near a face the sum of solid angles is mostly that face's.
TEST(CoincidentBodies, ASmallBodyNearAFaceOfALargeOneIsInsideOrNot) {
  Random random(5);
  Scenario s = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
  s.bodies = {box_body("large", Body::Kind::Fixed, Vec3::Constant(0.1), Vec3::Zero(), {1, 1, 1}),
              box_body("small", Body::Kind::Tissue, Vec3::Constant(2e-3), Vec3::Zero())};
  for (int k = 0; k < 40; ++k) {
    Vec3 center = 0.048 * random.vec3();
    center[k % 3] = k % 2 == 0 ? 0.0488 : -0.0488;  // 0.2 mm below the face
    std::get<BoxGeometry>(s.bodies[1].geometry).center = center;
    EXPECT_NE(error_of(s).find("body `small` lies wholly inside `large`"), std::string::npos)
        << center.transpose();
    center[k % 3] *= 0.0512 / 0.0488;  // as far above it
    std::get<BoxGeometry>(s.bodies[1].geometry).center = center;
    EXPECT_EQ(error_of(s), "") << center.transpose();
  }
}

// A plug in a hole lies within the other's box, and on its faces, but not inside.
TEST(CoincidentBodies, APlugInAHoleIsNotInside) {
  const TemporaryFolder folder;
  const auto in_hole = [](const Vec3& c) {
    return std::max(std::abs(c.x()), std::abs(c.y())) < 0.005;
  };
  const BoxGeometry box{{0.03, 0.03, 0.01}, {6, 6, 2}, Vec3::Zero()};
  Scenario s = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
  for (const double shorter : {0.0, 0.002}) {
    s.bodies = {mesh_body("ring", Body::Kind::Tissue,
                          carved(box, [&](const Vec3& c) { return !in_hole(c); }), folder),
                box_body("plug", Body::Kind::Tissue, {0.01, 0.01, 0.01 - shorter}, Vec3::Zero(),
                         {2, 2, 2})};
    EXPECT_EQ(error_of(s), "");
  }
}

TEST(CoincidentBodies, BodiesThatLieFlushOrAreTiedOrCannotMeetAreNot) {
  EXPECT_EQ(error_of(two_boxes({kSide, 0, 0}, Body::Kind::Tissue)), "");
  EXPECT_EQ(error_of(two_boxes({0, 0, 1e-3}, Body::Kind::Tissue)), "");
  Scenario tied = two_boxes(Vec3::Zero(), Body::Kind::Fixed);
  tied.attachments = {attach("one", "two", {-1, -1, -1}, {1, 1, 0.2951})};
  EXPECT_EQ(error_of(tied), "");
  Scenario without_contact = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
  without_contact.contact = false;
  EXPECT_EQ(error_of(without_contact), "");
}

TEST(CoincidentBodies, AContactProbeOfABodyWithItselfNeedsSelfContact) {
  Scenario s = two_boxes({2 * kSide, 0, 0}, Body::Kind::Tissue);
  Probe probe;
  probe.name = "fold";
  probe.what = ContactProbe{"one", "one", {}};
  s.probes = {probe};
  EXPECT_NE(error_of(s).find("probe `fold` observes contact of `one` with itself"),
            std::string::npos);
  ContactPair self;
  self.a = self.b = "one";
  s.contacts = {self};
  EXPECT_EQ(error_of(s), "");
}

}  // namespace articular::sim::coincident_bodies_test
