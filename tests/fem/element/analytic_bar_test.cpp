#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/fixed_nodes.hpp"

namespace articular::fem::analytic_bar_test {

constexpr double kE = 2e4, kDensity = 1060, kGravity = 9.81;  // [Pa], [kg/m³], [m/s²]
const Vec3 kSize(0.01, 0.01, 0.04);                           // [m]

/// Displacements of a bar that hangs from its end at z = 0 and is pulled along z by its weight.
Positions hang(const TetMesh& mesh) {
  const Elasticity elasticity(mesh.X, mesh.tets, Linear(kE, 0));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
  Positions f = Positions::Zero(3, mesh.X.cols()), u = f;
  f.row(2) = kGravity * lumped_mass(mesh.X, mesh.tets, kDensity).transpose();
  std::vector<bool> fixed;
  for (const auto& X : mesh.X.colwise()) fixed.push_back(X.z() < 1e-9);
  solve_with_fixed_nodes(K, f, fixed, u);
  return u;
}

/// The mean of u_z over the cross section at z: that of the linear interpolation on its triangles.
double section_mean(const TetMesh& mesh, const Positions& u, double z) {
  double integral = 0, area = 0;
  for (const auto& tet : mesh.tets.colwise()) {
    for (int omitted = 0; omitted < 4; ++omitted) {
      const std::array<int, 3> face{tet[(omitted + 1) % 4], tet[(omitted + 2) % 4],
                                    tet[(omitted + 3) % 4]};
      double mean = 0;
      bool in_section = true;
      for (const int a : face) {
        in_section = in_section && std::abs(mesh.X(2, a) - z) < 1e-9;
        mean += u(2, a) / 3;
      }
      if (!in_section) continue;
      const Vec3 p = mesh.X.col(face[0]), q = mesh.X.col(face[1]), r = mesh.X.col(face[2]);
      const double face_area = (q - p).cross(r - p).norm() / 2;
      area += face_area;
      integral += face_area * mean;
    }
  }
  return integral / area;
}

// At ν = 0 nothing strains across, and with z measured down from the fixed end
//
//   E u'' + ρ g = 0,  u(0) = 0,  u'(L) = 0   =>   u(z) = ρ g (L z − z²/2)/E,  u(L) = ρ g L²/2E
//
// Six tetrahedra a cell load the nodes of a section unevenly, which warps it. But functions of z
// alone, linear between the sections, are among the test functions, and tested with them the
// equations are those of linear elements in one dimension, for the mean of u over a section. Those
// are exact at their nodes: so are the means, on the coarsest mesh. The tolerance is that of the
// linear solution.
TEST(HangingBar, SectionsMoveExactlyInTheMean) {
  for (const int refinement : {1, 2, 4}) {
    const TetMesh mesh = box_mesh({refinement, refinement, 4 * refinement}, kSize);
    const Positions u = hang(mesh);
    const double L = kSize.z(), tip = kDensity * kGravity * L * L / (2 * kE);
    for (const double z : {0.25 * L, 0.5 * L, 0.75 * L, L}) {
      const double expected = kDensity * kGravity * (L * z - z * z / 2) / kE;
      EXPECT_NEAR(section_mean(mesh, u, z), expected, 1e-12 * tip) << refinement << ' ' << z;
    }
  }
}

// And the warping vanishes with the mesh.
TEST(HangingBar, WarpingOfTheSectionsFallsWithTheMesh) {
  const double L = kSize.z(), tip = kDensity * kGravity * L * L / (2 * kE);
  std::vector<double> error;
  for (const int refinement : {2, 4, 8}) {
    const TetMesh mesh = box_mesh({refinement, refinement, 4 * refinement}, kSize);
    const Positions u = hang(mesh);
    error.push_back(0);
    for (Eigen::Index a = 0; a < u.cols(); ++a) {
      const double s = mesh.X(2, a) / L;
      error.back() = std::max(error.back(), std::abs(u(2, a) - tip * (2 * s - s * s)) / tip);
    }
  }
  std::printf("largest axial error / tip displacement: %.2e %.2e %.2e\n", error[0], error[1],
              error[2]);
  EXPECT_GT(error[0] / error[1], 2);
  EXPECT_GT(error[1] / error[2], 3);
}

}  // namespace articular::fem::analytic_bar_test
