#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sim/mesh/mesh_continue.hpp"

namespace articular::sim::mesh_continue_test {

constexpr double kRadius = 0.01, kHalfWidth = 0.008;
constexpr int kAlong = 24, kAcross = 16;

/// A quarter of a cylinder about the x axis that looks down (-z), from straight behind (+y) to
/// lowest, 5 degrees past it, as a fossa's slope that ends at the crest. Its rows are ragged, so
/// that no plane meets a row of nodes.
MeshData slope() {
  MeshData mesh;
  mesh.X.resize(3, (kAlong + 1) * (kAcross + 1));
  const auto node = [](int i, int j) { return j * (kAlong + 1) + i; };
  for (int j = 0; j <= kAcross; ++j)
    for (int i = 0; i <= kAlong; ++i) {
      const double ragged = 0.4 * std::sin(2.4 * i + 1.7 * j);
      const double angle = (95 * (i + ragged) / kAlong) * std::numbers::pi / 180;
      mesh.X.col(node(i, j)) = Vec3(kHalfWidth * (2.0 * j / kAcross - 1), kRadius * std::cos(angle),
                                    -kRadius * std::sin(angle));
    }
  mesh.triangles.resize(3, 2 * kAlong * kAcross);
  Eigen::Index f = 0;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAlong; ++i) {
      mesh.triangles.col(f++) << node(i, j), node(i, j + 1), node(i + 1, j);
      mesh.triangles.col(f++) << node(i + 1, j), node(i, j + 1), node(i + 1, j + 1);
    }
  return mesh;
}

/// Cut where the slope is 30 degrees.
Continuation forward() {
  return {{0, kRadius * std::sin(std::numbers::pi / 6), 0}, {0, -1, 0}, 0.006, 0.002};
}

Vec3 area(const MeshData& mesh, Eigen::Index f) {
  const Vec3 a = mesh.X.col(mesh.triangles(0, f));
  return 0.5 * (Vec3(mesh.X.col(mesh.triangles(1, f))) - a)
                   .cross(Vec3(mesh.X.col(mesh.triangles(2, f))) - a);
}

double facets_sagitta() { return kRadius * (1 - std::cos(0.5 * 95.0 / kAlong * 2 / 57.3)); }

TEST(MeshContinue, TheSheetGoesOnFromTheCutWithItsSlopeWhichFadesOut) {
  const Continuation c = forward();
  const MeshData mesh = continued(slope(), c);
  const double sigma = std::tan(std::numbers::pi / 6);
  const double z0 = -kRadius * std::cos(std::numbers::pi / 6);
  double farthest = 0;
  for (Eigen::Index i = 0; i < mesh.X.cols(); ++i) {
    const Vec3 x = mesh.X.col(i);
    const double u = c.at.y() - x.y();
    farthest = std::max(farthest, u);
    if (u <= 1e-12) {  // still the cylinder
      EXPECT_NEAR(std::hypot(x.y(), x.z()), kRadius, facets_sagitta());
      continue;
    }
    const double fall = u < c.easing ? u - u * u / (2 * c.easing) : 0.5 * c.easing;
    EXPECT_NEAR(x.z(), z0 - sigma * fall, 0.1 * sigma * fall + facets_sagitta()) << u;
  }
  EXPECT_NEAR(farthest, c.length, 1e-12);
}

TEST(MeshContinue, NothingGapesAndNothingIsTurnedOver) {
  const MeshData mesh = continued(slope(), forward());
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index f = 0; f < mesh.triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) ++edges[{mesh.triangles(k, f), mesh.triangles((k + 1) % 3, f)}];
  const Eigen::Vector3d low = mesh.X.rowwise().minCoeff(), high = mesh.X.rowwise().maxCoeff();
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    if (edges.contains({edge.second, edge.first})) continue;
    // The border: at the sides, in front, and behind, where the sheet's own rim is ragged.
    const Vec3 middle = 0.5 * (mesh.X.col(edge.first) + mesh.X.col(edge.second));
    const bool side = std::abs(std::abs(middle.x()) - kHalfWidth) < 2e-5;
    const bool front = std::abs(middle.y() - low.y()) < 1e-12;
    EXPECT_TRUE(side || front || middle.y() > 0.9 * high.y()) << middle.transpose();
  }
  double least = 1;
  for (Eigen::Index f = 0; f < mesh.triangles.cols(); ++f) {
    EXPECT_LT(area(mesh, f).z(), 1e-12);
    least = std::min(least, area(mesh, f).norm());
  }
  const double mean = 2 * kHalfWidth * kRadius * 1.6 / (2 * kAlong * kAcross);
  EXPECT_GT(least, 0.1 * mean);  // no slivers at the cut
}

TEST(MeshContinue, ASheetThatStandsAcrossTheDirectionIsRefused) {
  Continuation c = forward();
  c.at.y() = kRadius * std::cos(3 * std::numbers::pi / 180);
  EXPECT_THROW(continued(slope(), c), std::invalid_argument);
}

TEST(MeshContinue, ALengthOfMoreRowsThanAnyoneWantsIsRefused) {
  Continuation c = forward();
  c.length = 1e4;
  EXPECT_THROW(continued(slope(), c), std::invalid_argument);
}

TEST(MeshContinue, APlaneThatMissesTheSheetIsRefused) {
  Continuation c = forward();
  c.at.y() = -0.1;
  EXPECT_THROW(continued(slope(), c), std::invalid_argument);
}

}  // namespace articular::sim::mesh_continue_test
