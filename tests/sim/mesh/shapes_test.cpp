#include "sim/mesh/shapes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace articular::sim::shapes_test {

Eigen::VectorXd volumes(const MeshData& mesh) {
  Eigen::VectorXd volume(mesh.tets.cols());
  for (Eigen::Index t = 0; t < mesh.tets.cols(); ++t) {
    const Eigen::Vector4i n = mesh.tets.col(t);
    const Vec3 a = mesh.X.col(n[0]);
    volume[t] = (mesh.X.col(n[1]) - a).cross(mesh.X.col(n[2]) - a).dot(mesh.X.col(n[3]) - a) / 6;
  }
  return volume;
}

TEST(Shapes, ABoxIsFilledByPositiveTetrahedraToRoundOff) {
  const Eigen::VectorXd volume = volumes(box_mesh({{0.02, 0.03, 0.05}, {3, 2, 4}, {1, 2, 3}}));
  EXPECT_EQ(volume.size(), 6 * 3 * 2 * 4);
  EXPECT_GT(volume.minCoeff(), 0);
  EXPECT_NEAR(volume.sum(), 0.02 * 0.03 * 0.05, 1e-12 * 0.02 * 0.03 * 0.05);
}

TEST(Shapes, ABoxLiesAroundItsCentre) {
  const MeshData mesh = box_mesh({{2, 4, 6}, {2, 2, 2}, {1, 2, 3}});
  EXPECT_NEAR((mesh.X.rowwise().minCoeff() - Vec3(0, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((mesh.X.rowwise().maxCoeff() - Vec3(2, 4, 6)).norm(), 0, 1e-14);
}

TEST(Shapes, AHexahedronWithTheCornersOfABoxIsThatBox) {
  const BoxGeometry box{{2, 4, 6}, {3, 2, 4}, {1, 2, 3}};
  HexahedronGeometry hexahedron;
  hexahedron.corners << 0, 2, 2, 0, 0, 2, 2, 0,  //
      0, 0, 4, 4, 0, 0, 4, 4,                    //
      0, 0, 0, 0, 6, 6, 6, 6;
  hexahedron.cells = box.cells;
  const MeshData expected = box_mesh(box), mesh = hexahedron_mesh(hexahedron);
  EXPECT_LT((mesh.X - expected.X).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(mesh.tets, expected.tets);
}

// Cook's membrane: 48 long, 44 high at one end and 16 at the other. Its cells are planar
// trapezoids, so that tetrahedra fill it to round-off.
TEST(Shapes, AHexahedronMayTaper) {
  HexahedronGeometry cook;
  cook.corners << 0, 48, 48, 0, 0, 48, 48, 0,  //
      0, 44, 60, 44, 0, 44, 60, 44,            //
      0, 0, 0, 0, 1, 1, 1, 1;
  cook.cells = {4, 4, 2};
  const Eigen::VectorXd volume = volumes(hexahedron_mesh(cook));
  EXPECT_GT(volume.minCoeff(), 0);
  EXPECT_NEAR(volume.sum(), 48 * (44 + 16) / 2.0, 1e-10);
}

// The nodes on the surface lie on the sphere, so that the volume is too small by the sagittae of
// the faces: second order in the element size.
TEST(Shapes, ASpheresVolumeConvergesWithTheSquareOfTheElementSize) {
  const auto error = [](double size) {
    const Eigen::VectorXd volume = volumes(sphere_mesh({1, size, Vec3::Zero()}));
    EXPECT_GT(volume.minCoeff(), 0);
    return 4.0 / 3 * std::numbers::pi - volume.sum();
  };
  const double coarse = error(1.0 / 4), fine = error(1.0 / 8);
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(Shapes, ASpheresOutermostNodesLieOnIt) {
  const Vec3 center(1, 2, 3);
  const MeshData mesh = sphere_mesh({0.5, 0.25, center});
  // 2 cells a radius: 5³ nodes, of which 3³ lie inside.
  const Eigen::VectorXd r = (mesh.X.colwise() - center).colwise().norm();
  EXPECT_EQ((r.array() > 0.5 - 1e-12).count(), 125 - 27);
  EXPECT_LT(r.maxCoeff(), 0.5 + 1e-12);
}

// Each leg is a prism with the square section of side w. The mitre takes from its inner side what
// it leaves on the outer one, so that its middle line of length L counts.
TEST(Shapes, AVShapeHasTheVolumeOfItsTwoMitredLegs) {
  const double L = 0.03, w = 0.01, angle = 0.8;
  const Eigen::VectorXd volume = volumes(v_shape_mesh({L, w, angle, {6, 2}}));
  const double expected = 2 * w * w * L;
  EXPECT_GT(volume.minCoeff(), 0);
  EXPECT_NEAR(volume.sum(), expected, 1e-12 * expected);
}

TEST(Shapes, AVShapeIsTheSameOnBothSides) {
  const MeshData mesh = v_shape_mesh({0.03, 0.01, 0.8, {4, 2}});
  EXPECT_NEAR(mesh.X.row(0).minCoeff(), -mesh.X.row(0).maxCoeff(), 1e-17);
  // A corner of a leg's end: L along it, half a width to each side.
  EXPECT_NEAR(mesh.X.col(0).norm(), std::hypot(0.03, 0.005, 0.005), 1e-15);
}

TEST(Shapes, PlacementTurnsAndScalesAboutItsPointAndThenShifts) {
  Placement placement;
  placement.rotation = Vec3(0, 0, std::numbers::pi / 2);
  placement.about = Vec3(1, 0, 0);
  placement.translation = Vec3(0, 0, 5);
  placement.scale = 2;
  Positions X(3, 2);
  X << 1, 2, 0, 0, 0, 1;
  place(placement, X);
  EXPECT_NEAR((X.col(0) - Vec3(1, 0, 5)).norm(), 0, 1e-15);  // the point itself only shifts
  EXPECT_NEAR((X.col(1) - Vec3(1, 2, 7)).norm(), 0, 1e-15);
}

}  // namespace articular::sim::shapes_test
