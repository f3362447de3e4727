// Mass of rigid bodies from their surfaces, and the parts of surfaces that touch.
#include "sim/build/body_geometry.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <variant>

#include "sim/base/error.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/wrap/wrap_shapes.hpp"

namespace articular::sim::body_geometry_test {

MeshData surface(const wrap_test::Shape& shape) {
  MeshData mesh;
  mesh.X = shape.X;
  mesh.triangles = shape.triangles;
  return mesh;
}

std::string refusal(const Body& body) {
  try {
    read_geometry(body);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const MeshData& mesh) {
  const TemporaryFolder folder;
  return refusal(mesh_body("bone", Body::Kind::Fixed, mesh, folder));
}

TEST(RigidMass, OfABallIsThatOfItsVolume) {
  Body body;
  body.density = 2000;
  const double r = 0.03;
  const MassProperties mass =
      rigid_mass(body, surface(wrap_test::ellipsoid(24, Vec3::Constant(r))));
  EXPECT_NEAR(mass.mass, 2000 * 4 / 3 * wrap_test::kPi * r * r * r, 0.005 * mass.mass);
  EXPECT_NEAR(mass.inertia(0, 0), 0.4 * mass.mass * r * r, 0.005 * mass.inertia(0, 0));
}

// The divergence theorem gives an open tube two thirds of its volume, or any other part of it.
TEST(RigidMass, OfAnOpenSurfaceIsRefusedUnlessItIsGiven) {
  Body body;
  body.density = 2000;
  const MeshData tube = surface(wrap_test::cylinder(16, 4, 0.01, 0.05));
  EXPECT_THROW(rigid_mass(body, tube), InputError);
  body.density.reset();
  body.mass = 0.1;
  EXPECT_THROW(rigid_mass(body, tube), InputError);  // the inertia would come from it
  body.center_of_mass = Vec3(0, 0, 0.01);
  body.inertia = 1e-5 * Mat3::Identity();
  EXPECT_EQ(rigid_mass(body, tube).mass, 0.1);
}

// Its inside would be what lies around it.
TEST(BodyGeometry, ASurfaceThatIsInsideOutIsRefusedAndAnOpenOneIsNot) {
  MeshData ball = surface(wrap_test::ellipsoid(8, Vec3::Constant(0.03)));
  EXPECT_EQ(refusal(ball), "");
  ball.triangles.row(1).swap(ball.triangles.row(2));
  EXPECT_NE(refusal(ball).find("of `bone` is inside out"), std::string::npos) << refusal(ball);
  ball.triangles.conservativeResize(3, ball.triangles.cols() - 1);
  EXPECT_EQ(refusal(ball), "");
}

// It would weigh twice as much. A triangle and its other side, as scans have them, enclose nothing.
TEST(BodyGeometry, ATriangleThatIsThereTwiceIsRefusedWhateverItsNodes) {
  const TemporaryFolder folder;
  const MeshData once = surface(wrap_test::ellipsoid(8, Vec3::Constant(0.03)));
  MeshData twice = once;
  const auto nodes = static_cast<int>(once.X.cols());
  const Eigen::Index faces = once.triangles.cols();
  twice.X.conservativeResize(3, nodes + 3);
  twice.triangles.conservativeResize(3, faces + 1);
  for (int k = 0; k < 3; ++k) {
    twice.X.col(nodes + k) = once.X.col(once.triangles((k + 1) % 3, 5));
    twice.triangles(k, faces) = nodes + k;
  }
  EXPECT_NE(refusal(twice).find("the surface of `bone` has a triangle twice"), std::string::npos);
  std::swap(twice.triangles(0, faces), twice.triangles(1, faces));
  EXPECT_EQ(refusal(twice), "");
  Body bone = mesh_body("bone", Body::Kind::Fixed, once, folder);
  bone.contact_meshes.assign(2, std::get<MeshFile>(bone.geometry));
  EXPECT_THROW(read_geometry(bone), InputError);
  bone.contact_meshes.pop_back();
  EXPECT_EQ(read_geometry(bone).contact.triangles.cols(), faces);
}

/// A fixed ball of radius 30 mm that touches with a part of itself.
class PartOfABall : public testing::Test {
 protected:
  Body touching(const std::function<void(MeshFile&)>& change) const {
    Body bone = mesh_body("bone", Body::Kind::Fixed, ball_, folder_);
    MeshFile part = std::get<MeshFile>(bone.geometry);
    change(part);
    bone.contact_meshes = {part};
    return bone;
  }

  MeshData ball_ = surface(wrap_test::ellipsoid(16, Vec3::Constant(0.03)));
  TemporaryFolder folder_;
};

TEST_F(PartOfABall, IsOfFacesWhoseMiddlesLieInTheBoxAfterItsPlace) {
  const Vec3 lower(-1, 0.011, -1), upper(0.002, 1, 1);
  const Body bone = touching([&](MeshFile& file) {
    file.placement.translation = Vec3(0, 0.01, 0);
    file.box = {lower, upper};
  });
  const MeshData part = read_geometry(bone).contact;
  Eigen::Index expected = 0;
  for (const auto& t : ball_.triangles.colwise()) {
    const Vec3 middle = ball_.X(Eigen::all, t).rowwise().mean() + Vec3(0, 0.01, 0);
    if (middle.y() >= lower.y() && middle.x() <= upper.x()) ++expected;
  }
  EXPECT_EQ(part.triangles.cols(), expected);
  EXPECT_GT(expected, 0);
  for (const auto& t : part.triangles.colwise()) {
    const Vec3 middle = part.X(Eigen::all, t).rowwise().mean();
    EXPECT_GE(middle.y(), lower.y());
    EXPECT_LE(middle.x(), upper.x());
  }
}

TEST_F(PartOfABall, NeedsAFace) {
  const std::pair<Vec3, Vec3> beside(Vec3(0.04, -1, -1), Vec3(1, 1, 1));
  const std::pair<Vec3, Vec3> below(Vec3(-1, -1, -1), Vec3(1, 1, -0.02));
  EXPECT_NE(refusal(touching([&](MeshFile& file) { file.box = beside; })).find("is left by `box`"),
            std::string::npos);
  const auto up_below = [&](MeshFile& file) {
    file.box = below;
    file.facing = Vec3::UnitZ();
  };
  EXPECT_NE(refusal(touching(up_below)).find("is left by `facing` and `box`"), std::string::npos);
}

}  // namespace articular::sim::body_geometry_test
