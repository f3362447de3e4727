#include "tools/report/run_scene.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "sim/mesh/shapes.hpp"
#include "sim/mesh/vtk_files.hpp"
#include "tests/tools/report/unpacked.hpp"
#include "tools/report/page_scene.hpp"
#include "tools/report/page_skin.hpp"
#include "tools/report/rigid_pose.hpp"

namespace articular::tools::report_test {

using Numbers = std::vector<std::size_t>;

TEST(SpreadFrames, AreAllWhereTheyFitAndElseEvenlyApart) {
  EXPECT_EQ(spread_frames(5, 100), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(spread_frames(5, 5.9), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(spread_frames(9, 5), (Numbers{0, 2, 4, 6, 8}));
  EXPECT_EQ(spread_frames(92, 3.5), (Numbers{0, 46, 91}));
}

TEST(SpreadFrames, HaveTheFirstAndTheLastHoweverLittleRoomThereIs) {
  EXPECT_EQ(spread_frames(91, 0.01), (Numbers{0, 90}));
  EXPECT_EQ(spread_frames(1, 0.01), (Numbers{0}));
}

TEST(RigidPose, IsTheMotionOfABone) {
  Positions before = Positions::Random(3, 20);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d t(3, -40, 0.5);
  const auto pose = rigid_pose(before, (R * before).colwise() + t);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(pose[static_cast<std::size_t>(4 * row + column)], R(row, column), 1e-12);
    EXPECT_NEAR(pose[static_cast<std::size_t>(4 * row + 3)], t[row], 1e-12);
  }
}

/// A block of 3 x 3 x 3 cells: 64 nodes, 8 of them inside, 9 * 2 triangles a side.
vtkSmartPointer<vtkPointSet> block() {
  const sim::MeshData mesh = sim::box_mesh({Vec3(3, 3, 3), {3, 3, 3}, Vec3::Zero()});
  return sim::make_grid(mesh.X, 1, mesh.tets, {});
}

TEST(PageSkin, HasTheOuterFacesAndTheirNodesOnly) {
  const PageSkin skin = page_skin(*block());
  EXPECT_EQ(skin.nodes.size(), 56U);
  ASSERT_EQ(skin.corners.size(), 3U * 108);
  // Counterclockwise from outside: the volume within comes out, with its sign.
  const Positions x = positions_at(*block(), skin.nodes);
  double volume = 0;
  for (std::size_t t = 0; t < skin.corners.size(); t += 3)
    volume +=
        x.col(skin.corners[t]).dot(x.col(skin.corners[t + 1]).cross(x.col(skin.corners[t + 2])));
  EXPECT_NEAR(volume / 6, 27, 1e-12);
}

TEST(PageSkin, ASimplerSurfaceHasFewerTrianglesAndNearlyTheSameVolume) {
  const sim::MeshData mesh = sim::box_mesh({Vec3(3, 3, 3), {12, 12, 12}, Vec3::Zero()});
  const auto set = sim::make_grid(mesh.X, 1, mesh.tets, {});
  const auto simple = simplified_surface(*set, 300);
  const PageSkin skin = page_skin(*simple);
  EXPECT_LE(skin.corners.size() / 3, 301U);
  EXPECT_GE(skin.corners.size() / 3, 12U);
  const Positions x = positions_at(*simple, skin.nodes);
  double volume = 0;
  for (std::size_t t = 0; t < skin.corners.size(); t += 3)
    volume +=
        x.col(skin.corners[t]).dot(x.col(skin.corners[t + 1]).cross(x.col(skin.corners[t + 2])));
  EXPECT_NEAR(std::abs(volume) / 6, 27, 0.1);
}

TEST(PageScene, HasPositionsOfEachFrameAndRefusesAnotherMesh) {
  PageScene scene;
  const auto set = block();
  scene.add({0, 0, {{"block", PartKind::Tissue, set}}});
  set->GetPoints()->SetPoint(0, -100, 0, 0);
  scene.add({1, 0.1, {{"block", PartKind::Tissue, set}}});
  const Json body = scene.json({})["bodies"][0];
  const std::vector<double> x = unquantised(body["points"], 3U * 56);
  ASSERT_EQ(x.size(), 2U * 3 * 56);
  EXPECT_NEAR(x[0], -1.5, 1e-3);
  EXPECT_NEAR(x[3U * 56], -100, 1e-3);
  const sim::MeshData other = sim::box_mesh({Vec3(1, 1, 1), {1, 1, 1}, Vec3::Zero()});
  EXPECT_THROW(
      scene.add(
          {2, 0.2, {{"block", PartKind::Tissue, sim::make_grid(other.X, 1, other.tets, {})}}}),
      sim::InputError);
}

}  // namespace articular::tools::report_test
