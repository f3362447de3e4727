#include "sim/build/linear_solver.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::linear_solver_test {

constexpr double kCell = 1e-3;  // [m]

/// Tissue of 30 x 30 cells in some layers, from z = 0 on. Its lower side is tied to a bone that
/// moves freely, and a floor lies below.
Scenario layers_on_a_bone(int layers) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.contact = true;
  const Eigen::Vector3i cells(30, 30, layers);
  const Vec3 size = kCell * cells.cast<double>();
  const Vec3 center(0, 0, 0.5 * size.z());
  s.bodies = {box_body("tissue", Body::Kind::Tissue, size, center, cells), mass_body("bone", 1),
              box_body("floor", Body::Kind::Fixed, {1, 1, 0.1}, {0, 0, -0.06})};
  s.attachments = {attach("tissue", "bone", {-1, -1, -1e-6}, {1, 1, 1e-6})};
  return s;
}

fem::SolverKind solver_of(const Scenario& s) { return build_model(s).linear_solver.kind; }

// Both have more blocks than are factored where tissue is thick. Twice the volume by the surface is
// 4.8 elements in seven layers and 6.7 in twelve; factors are taken up to 6.
TEST(LinearSolverChoice, ThinTissueOnABoneThatMovesIsFactoredAndThickIsNot) {
  EXPECT_EQ(solver_of(layers_on_a_bone(7)), fem::SolverKind::Cholesky);
  EXPECT_EQ(solver_of(layers_on_a_bone(12)), fem::SolverKind::Multigrid);
}

TEST(LinearSolverChoice, OneThickTissueAmongThinOnesCounts) {
  Scenario s = layers_on_a_bone(7);
  s.bodies.insert(s.bodies.begin(), box_body("cube", Body::Kind::Tissue, Vec3::Constant(20 * kCell),
                                             {0, 0, 0.1}, {20, 20, 20}));
  EXPECT_EQ(solver_of(s), fem::SolverKind::Multigrid);
  // Thin, and of about as many blocks.
  s.bodies.front() =
      box_body("sheet", Body::Kind::Tissue, Vec3(60, 60, 2) * kCell, {0, 0, 0.1}, {60, 60, 2});
  EXPECT_EQ(solver_of(s), fem::SolverKind::Cholesky);
}

// Its surface is not looked for.
TEST(LinearSolverChoice, TissueThatTouchesNothingCountsAsThick) {
  Scenario s = layers_on_a_bone(7);
  s.bodies.push_back(
      box_body("sheet", Body::Kind::Tissue, Vec3(60, 60, 2) * kCell, {0, 0, 0.1}, {60, 60, 2}));
  s.bodies.back().collides = false;
  EXPECT_EQ(solver_of(s), fem::SolverKind::Multigrid);
}

}  // namespace articular::sim::linear_solver_test
