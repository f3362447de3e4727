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

namespace articular::fem::analytic_cantilever_test {

// A cantilever of length L, depth 2c (along y) and width b carries a force Q across its end. At ν =
// 0 the plane solution of [Timoshenko 1970, art. 21] holds in three dimensions, too, so that the
// mesh is compared with the exact field and not with a theory of beams. With I = 2bc³/3:
//
//   σxx = −Q (L − x) y/I,   τxy = Q (c² − y²)/2I
//   u = −Q (L x − x²/2) y/EI − Q y³/3EI
//   v =  Q (L x²/2 − x³/6 + c² x)/EI             v(L) = Q L³/3EI + Q c² L/EI
//
// The first part of v(L) is that of Euler and Bernoulli, the second the shear. The section at x = 0
// is given the exact warping, the one at x = L the exact shear stress.
//
// [Timoshenko 1970] Timoshenko, Goodier. Theory of Elasticity, 3rd ed. McGraw-Hill.
constexpr double kE = 2e4;                           // [Pa]
constexpr double kL = 0.04, kC = 0.005, kB = 0.005;  // [m]
constexpr double kQ = 1e-3;                          // [N]
constexpr double kEI = kE * 2 * kB * kC * kC * kC / 3;

Vec3 exact_displacement(const Vec3& X) {
  const double x = X.x(), y = X.y();
  return {-kQ * ((kL * x - x * x / 2) * y + y * y * y / 3) / kEI,
          kQ * (kL * x * x / 2 - x * x * x / 6 + kC * kC * x) / kEI, 0};
}

/// Nodal forces of the shear stress on the faces at x = L, by the rule of the edge midpoints.
Positions end_load(const TetMesh& mesh, double y_centre) {
  Positions f = Positions::Zero(3, mesh.X.cols());
  for (const auto& tet : mesh.tets.colwise()) {
    for (int omitted = 0; omitted < 4; ++omitted) {
      std::array<int, 3> face{tet[(omitted + 1) % 4], tet[(omitted + 2) % 4],
                              tet[(omitted + 3) % 4]};
      if (std::any_of(face.begin(), face.end(), [&](int a) { return mesh.X(0, a) < kL - 1e-9; })) {
        continue;
      }
      const Vec3 p = mesh.X.col(face[0]), q = mesh.X.col(face[1]), r = mesh.X.col(face[2]);
      const double area = (q - p).cross(r - p).norm() / 2;
      for (int k = 0; k < 3; ++k) {
        const int a = face[k], b = face[(k + 1) % 3];
        const double y = (mesh.X(1, a) + mesh.X(1, b)) / 2 - y_centre;
        const double stress = kQ * (kC * kC - y * y) / (2 * kEI / kE);  // [Pa]
        f(1, a) += stress * area / 6;  // a third of the area, a half of the shape function
        f(1, b) += stress * area / 6;
      }
    }
  }
  return f;
}

/// Error of the deflection at the middle of the loaded end, relative to the exact one.
double cantilever_error(int refinement) {
  TetMesh mesh = box_mesh({8 * refinement, 2 * refinement, refinement}, Vec3(kL, 2 * kC, kB));
  const Positions f = end_load(mesh, kC);
  mesh.X.row(1).array() -= kC;  // y from the axis
  const Elasticity elasticity(mesh.X, mesh.tets, Linear(kE, 0));
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(mesh.X, Tangent::Consistent, 1, K);
  Positions u = Positions::Zero(3, mesh.X.cols());
  std::vector<bool> fixed;
  int end = 0;
  for (int a = 0; a < u.cols(); ++a) {
    fixed.push_back(mesh.X(0, a) < 1e-9);
    if (fixed.back()) u.col(a) = exact_displacement(mesh.X.col(a));
    const Vec3 from_end = mesh.X.col(a) - Vec3(kL, 0, 0);
    if (from_end.norm() < (mesh.X.col(end) - Vec3(kL, 0, 0)).norm()) end = a;
  }
  solve_with_fixed_nodes(K, f, fixed, u);
  const double expected = exact_displacement(Vec3(kL, 0, 0)).y();
  return (expected - u(1, end)) / expected;
}

TEST(Cantilever, DeflectionConvergesAtSecondOrderFromTheStiffSide) {
  const double coarse = cantilever_error(2), medium = cantilever_error(4),
               fine = cantilever_error(8);
  std::printf("error of the deflection: %.2e %.2e %.2e\n", coarse, medium, fine);
  EXPECT_GT(fine, 0);  // conforming elements are too stiff
  EXPECT_LT(fine, 0.05);
  EXPECT_NEAR(std::log2(coarse / medium), 2, 0.35);  // far from the limit the coarse mesh locks
  EXPECT_NEAR(std::log2(medium / fine), 2, 0.15);
}

}  // namespace articular::fem::analytic_cantilever_test
