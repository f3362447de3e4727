// Balls that are too small, layers that are too stiff, contact meshes beside the body, masses of
// others.
#include "sim/build/body_doubts.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/base/error.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::body_doubts_test {

/// Of one body.
std::vector<std::string> doubts_of(const Body& body) {
  Scenario s = scene(1e-3);
  s.bodies = {body};
  return body_doubts(s, {read_geometry(body)});
}

Body ball(Body::Kind kind, double element_size) {
  Body body;
  body.name = "ball";
  body.kind = kind;
  body.geometry = SphereGeometry{0.01, element_size, {0.1, 0, 0}};
  body.density = 1000;
  body.where = {"scene.toml", 3, 1};
  return body;
}

// 4/3 π (10 mm)³ = 4189 mm³.
TEST(BodyDoubts, AreOfABallThatLacksATenthOfItsVolume) {
  EXPECT_TRUE(doubts_of(ball(Body::Kind::Rigid, 2e-3)).empty());
  EXPECT_TRUE(doubts_of(ball(Body::Kind::Fixed, 1e-2)).empty());
  for (const Body::Kind kind : {Body::Kind::Rigid, Body::Kind::Tissue}) {
    const std::vector<std::string> doubts = doubts_of(ball(kind, 1e-2));
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_NE(doubts[0].find("scene.toml:3:1: the ball `ball` has a volume of "),
              std::string::npos);
    EXPECT_NE(doubts[0].find(" mm^3 for 4189 mm^3 "), std::string::npos) << doubts[0];
    EXPECT_NE(doubts[0].find(" g for 4.189 g"), std::string::npos) << doubts[0];
  }
}

// Twice as large, eight times the volume: no other part of it is missing.
TEST(BodyDoubts, AreOfAPlacedBallByItsOwnSize) {
  Body body = ball(Body::Kind::Rigid, 2e-3);
  body.placement.scale = 2;
  EXPECT_TRUE(doubts_of(body).empty());
  body.geometry = SphereGeometry{0.01, 1e-2, {0.1, 0, 0}};
  ASSERT_EQ(doubts_of(body).size(), 1U);
  EXPECT_NE(doubts_of(body)[0].find(" mm^3 for 3.351e+04 mm^3 "), std::string::npos)
      << doubts_of(body)[0];
}

// (1 − ν)/((1 + ν)(1 − 2ν)) is 17 at 0.49 and 167 at 0.499.
TEST(BodyDoubts, AreOfALayerThatCannotGiveWay) {
  Body bone = box_body("bone", Body::Kind::Fixed, {0.05, 0.05, 0.02});
  bone.layer = Layer{1e-3, 1e6, 0.49};
  EXPECT_TRUE(doubts_of(bone).empty());
  bone.layer->poisson_ratio = 0.499;
  ASSERT_EQ(doubts_of(bone).size(), 1U);
  EXPECT_NE(doubts_of(bone)[0].find("the layer of `bone` is 167 times as stiff"), std::string::npos)
      << doubts_of(bone)[0];
}

// A surface in metres that was drawn in millimetres, and one in millimetres drawn in metres.
TEST(BodyDoubts, AreOfContactMeshesOfAnotherUnit) {
  const TemporaryFolder folder;
  const MeshData block = box_mesh({Vec3(0.04, 0.02, 0.02), {1, 1, 1}, Vec3(0.01, 0, 0)});
  Body bone = mesh_body("bone", Body::Kind::Fixed, block, folder);
  MeshFile touching = std::get<MeshFile>(bone.geometry);
  for (const double factor : {1.0, 0.1, 1.4}) {  // a part of it, and a sheet that goes on
    touching.unit = factor;
    bone.contact_meshes = {touching};
    EXPECT_TRUE(doubts_of(bone).empty()) << factor;
  }
  for (const double factor : {10.0, 1000.0, 0.001}) {
    touching.unit = factor;
    bone.contact_meshes = {touching};
    ASSERT_EQ(doubts_of(bone).size(), 1U) << factor;
    EXPECT_NE(doubts_of(bone)[0].find("the contact meshes of `bone` are "), std::string::npos);
  }
}

// A cube of edge a has the radius of gyration a/√6 = 8.2 mm about each axis.
TEST(BodyDoubts, AreOfAMassThatIsNotThatOfItsMesh) {
  Body bone = box_body("bone", Body::Kind::Rigid, Vec3::Constant(0.02), {0.1, 0, 0});
  bone.density.reset();
  const auto num = [&](double away, double gyration) {
    bone.mass = 0.1;
    bone.center_of_mass = Vec3(0.1 + away, 0, 0);
    bone.inertia = 0.1 * gyration * gyration * Mat3::Identity();
    return doubts_of(bone).size();
  };
  EXPECT_EQ(num(0, 0.0082), 0U);
  EXPECT_EQ(num(0.039, 0.0082), 0U);
  EXPECT_EQ(num(0.041, 0.0082), 1U);
  EXPECT_EQ(num(0, 0.32), 0U);
  EXPECT_EQ(num(0, 0.34), 1U);
  EXPECT_EQ(num(0, 0.0008), 1U);
  bone.mass.reset();
  bone.density = 12500;  // 0.1 kg too
  bone.center_of_mass.reset();
  for (const double gyration : {0.32, 0.34}) {
    bone.inertia = 0.1 * gyration * gyration * Mat3::Identity();
    EXPECT_EQ(doubts_of(bone).size(), gyration < 0.33 ? 0U : 1U) << gyration;
  }
}

// 8 cm³ weigh 8 mg of next to nothing, or 8 kg of more than a weight that is drawn small.
TEST(BodyDoubts, AreOfAMassThatItsMeshCannotHold) {
  for (const double mass : {7e-6, 9e-6, 7.9, 8.1}) {
    Body bone = box_body("bone", Body::Kind::Rigid, Vec3::Constant(0.02), {0.1, 0, 0});
    bone.density.reset();
    bone.mass = mass;
    EXPECT_EQ(doubts_of(bone).size(), mass > 8e-6 && mass < 8 ? 0U : 1U) << mass;
  }
  const TemporaryFolder folder;
  const MeshData block = box_mesh({Vec3::Constant(0.02), {1, 1, 1}, Vec3(0.01, 0, 0)});
  MeshData shell;
  shell.X = block.X;
  shell.triangles =
      read_geometry(mesh_body("bone", Body::Kind::Rigid, block, folder)).mesh.triangles;
  Body bone = mesh_body("bone", Body::Kind::Rigid, shell, folder);
  bone.density.reset();
  bone.mass = 10.4;
  ASSERT_EQ(doubts_of(bone).size(), 1U);
  EXPECT_NE(doubts_of(bone)[0].find("1.3e+03 times that of as much water"), std::string::npos)
      << doubts_of(bone)[0];
  // An open surface holds nothing, wherever it lies.
  shell.X.colwise() += Vec3(1, 1, 1);
  shell.triangles = shell.triangles.leftCols(shell.triangles.cols() - 1).eval();
  Body open = mesh_body("open", Body::Kind::Rigid, shell, folder);
  open.density.reset();
  open.mass = 1e-6;
  EXPECT_TRUE(doubts_of(open).empty());
}

}  // namespace articular::sim::body_doubts_test
