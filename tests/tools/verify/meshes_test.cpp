#include "tools/verify/meshes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace articular::tools {

double volume_of(const sim::MeshData& mesh, const Eigen::Vector4i& tet) {
  const Vec3 a = mesh.X.col(tet[0]);
  return (Vec3(mesh.X.col(tet[1])) - a)
             .cross(Vec3(mesh.X.col(tet[2])) - a)
             .dot(Vec3(mesh.X.col(tet[3])) - a) /
         6;
}

/// ∫ (x² + y²) dV of linear tetrahedra: V/20 (Σ over nodes x_a² + (Σ x_a)²), and the same of y.
double moment_about_z(const sim::MeshData& mesh) {
  double sum = 0;
  for (const auto& tet : mesh.tets.colwise()) {
    const Eigen::Matrix<double, 3, 4> x = mesh.X(Eigen::all, tet);
    const Eigen::Matrix<double, 2, 4> xy = x.topRows<2>();
    sum += volume_of(mesh, tet) / 20 * (xy.squaredNorm() + xy.rowwise().sum().squaredNorm());
  }
  return sum;
}

TEST(VerifyMeshes, TheCylinderHasThePolarMomentOfTheCircleOnEveryMesh) {
  constexpr double R = 0.005, L = 0.02;
  for (const int across : {2, 4, 8}) {
    const double exact = std::numbers::pi * std::pow(R, 4) / 2 * L;
    EXPECT_NEAR(moment_about_z(cylinder(R, L, across, 2)), exact, 1e-12 * exact) << across;
  }
}

TEST(VerifyMeshes, NoElementOfTheCylinderIsFlat) {
  const sim::MeshData mesh = cylinder(1, 1, 8, 8);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& tet : mesh.tets.colwise()) {
    least = std::min(least, volume_of(mesh, tet));
    most = std::max(most, volume_of(mesh, tet));
  }
  EXPECT_GT(least, 0.7 * most);
}

TEST(VerifyMeshes, OfTheIrregularBoxOnlyInnerNodesLieBesideTheGrid) {
  const Vec3 size(3, 6, 9);
  const sim::MeshData mesh = irregular_box(size, {3, 3, 3});
  int aside = 0;
  double volume = 0;
  for (const auto& X : mesh.X.colwise()) {
    const Vec3 in_cells = X.cwiseQuotient(size / 3);
    const double off = (in_cells - in_cells.array().round().matrix()).cwiseAbs().maxCoeff();
    const bool is_inner = (X.array() > 0.5).all() && ((size - X).array() > 0.5).all();
    EXPECT_LE(off, 0.15);
    EXPECT_EQ(off > 1e-9, is_inner);
    if (off > 1e-9) ++aside;
  }
  for (const auto& tet : mesh.tets.colwise()) {
    EXPECT_GT(volume_of(mesh, tet), 0);
    volume += volume_of(mesh, tet);
  }
  EXPECT_EQ(aside, 8);
  EXPECT_NEAR(volume, size.prod(), 1e-12 * size.prod());
}

}  // namespace articular::tools
