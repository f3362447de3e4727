#include "fem/element/fibre_drag.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::fibre_drag_test {

const Vec3 kSize(0.04, 0.02, 0.01);  // [m]
const MuscleFibre kFibre(
    {.max_stress = 2e5, .optimal_stretch = 1.1, .tendon_ratio = 0.3, .max_velocity = 8});

const AnyMaterial kMuscle = BlemkerMuscle<LogVolumeChange>(kFibre, {});

/// Fibres that turn from element to element, of different densities.
FibreDirections turning_fibres(const Tetrahedra& tets) {
  Random random;
  return (Vec3(2, -1, 2) / 3).replicate(1, tets.cols()) +
         0.3 * random.matrix<FibreDirections>(3, tets.cols());
}

struct Block {
  TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  BlockMatrix matrix;
  FibreDrag drag;

  explicit Block(const Vec3& fibre)
      : matrix(Elasticity(mesh.X, mesh.tets, Linear(1e4, 0.3)).make_matrix()),
        drag(mesh.X, mesh.tets, fibre.replicate(1, mesh.tets.cols()), kFibre, matrix) {}
  explicit Block(const SmoothedElasticity& smoothed)
      : matrix(smoothed.make_matrix()), drag(smoothed, kFibre) {}

  Positions force(const Positions& x, const Positions& v, double activation) const {
    Positions f = Positions::Zero(3, x.cols());
    drag.add_force(x, v, activation, f);
    return f;
  }
};

// Where all of it lengthens or shortens alike, a face across the fibres pulls with its area times
// what one fibre has: Hill's curve at the rate of the fibres without their tendon.
TEST(FibreDrag, PullsOnAFaceWithItsAreaTimesHillsCurve) {
  constexpr double kDensity = 1.5, kActivation = 0.6, kStretch = 1.05;
  const TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  const FibreDirections fibres = (kDensity * Vec3::UnitX()).replicate(1, mesh.tets.cols());
  const Block plain(kDensity * Vec3::UnitX()),
      smoothed(SmoothedElasticity(mesh.X, mesh.tets, kMuscle, {}, fibres));
  for (const Block* each : {&plain, &smoothed})
    for (const double rate : {-9.0, -2.0, -0.5, 0.0, 0.5, 4.0}) {
      const Block& block = *each;
      const Positions x = Vec3(kStretch, 1, 1).asDiagonal() * block.mesh.X,
                      v = Vec3(rate, 0, 0).asDiagonal() * block.mesh.X;
      const Positions f = block.force(x, v, kActivation);
      double pull = 0;
      for (Eigen::Index a = 0; a < f.cols(); ++a)
        if (block.mesh.X(0, a) > kSize.x() - 1e-9) pull += f(0, a);
      const double w = rate / (1.1 * 0.7 * 8), n = (kStretch / 1.1 - 0.3) / 0.7;
      const double hill = w <= -1 ? 0 : w < 0 ? (1 + w) / (1 - 4 * w) : 1 + 5 * w / (1 + 12.5 * w);
      const double expected = kDensity * kSize.y() * kSize.z() * kActivation * 2e5 / 1.1 *
                              MuscleFibre::active(n) * (hill - 1);
      EXPECT_NEAR(pull, expected, 1e-9 * std::max(1.0, std::abs(expected))) << rate;
    }
}

SmoothedElasticity smoothed_muscle() {
  const TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  return {mesh.X, mesh.tets, kMuscle, {.active_bulk = 0}, turning_fibres(mesh.tets)};
}

struct Moving {
  explicit Moving(Block moving) : block(std::move(moving)) {}

  Block block;
  Random random{};
  Positions x = block.mesh.X + 3e-4 * random.matrix<Positions>(3, block.mesh.X.cols()),
            v = 0.02 * random.matrix<Positions>(3, block.mesh.X.cols()),
            u = random.matrix<Positions>(3, block.mesh.X.cols());
};

/// Of plain elements, and of smoothed ones.
class MovingFibres : public testing::TestWithParam<bool> {
 protected:
  Moving m{GetParam() ? Block(smoothed_muscle()) : Block(Vec3(2, -1, 2) / 3)};
};
INSTANTIATE_TEST_SUITE_P(Of, MovingFibres, testing::Bool(), [](const auto& smoothed) {
  return smoothed.param ? "SmoothedElements" : "PlainElements";
});

// By central differences: their error is of the square of the step.
TEST_P(MovingFibres, DampingIsTheSlopeOfTheForce) {
  constexpr double kStep = 1e-6, kScale = 3;
  const Positions slope =
      (m.block.force(m.x, m.v + kStep * m.u, 0.7) - m.block.force(m.x, m.v - kStep * m.u, 0.7)) /
      (2 * kStep);
  Positions product = Positions::Zero(3, m.x.cols());
  m.block.drag.add_product(m.x, m.v, 0.7, m.u, product);
  EXPECT_LT((product - slope).norm(), 1e-6 * slope.norm());
  FibreDrag::Lines lines;
  m.block.drag.add_tangent(m.x, m.v, 0.7, kScale, 0, lines, m.block.matrix);
  const Eigen::VectorXd by_matrix = dense(m.block.matrix) * m.u.reshaped();
  EXPECT_LT((by_matrix - kScale * product.reshaped()).norm(), 1e-12 * by_matrix.norm());
}

// The same, by positions, of which the matrix has the symmetric part.
TEST_P(MovingFibres, StiffnessIsTheSymmetricPartOfTheSlopeByPositions) {
  constexpr double kStep = 1e-8;
  const auto dot = [](const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); };
  const auto change = [&](const Positions& by) -> Positions {
    return (m.block.force(m.x + kStep * by, m.v, 0.7) - m.block.force(m.x - kStep * by, m.v, 0.7)) /
           (2 * kStep);
  };
  const Positions w = m.random.matrix<Positions>(3, m.x.cols());
  FibreDrag::Lines lines;
  m.block.drag.add_tangent(m.x, m.v, 0.7, 0, 2, lines, m.block.matrix);
  const double of_u = dot(w, change(m.u)), of_w = dot(m.u, change(w));
  const double found = w.reshaped().dot(dense(m.block.matrix) * m.u.reshaped());
  EXPECT_GT(std::abs(of_u - of_w), 1e-4 * std::abs(of_u));  // it is not symmetric
  EXPECT_NEAR(found, of_u + of_w, 1e-6 * (std::abs(of_u) + std::abs(of_w)));
}

// Where all fibres shorten faster than they can, their pull is gone, at each point where the law
// has it: nothing is left of what the activation adds.
TEST(FibreDrag, OfSmoothedElementsTakesThePullAway) {
  const SmoothedElasticity muscle = smoothed_muscle();
  const Moving m(Block{muscle});
  Positions passive = Positions::Zero(3, m.x.cols()), active = passive;
  muscle.add_internal_force(m.x, passive, 0);
  muscle.add_internal_force(m.x, active, 0.7);
  const Positions drag = m.block.force(m.x, -20 * m.x, 0.7);
  EXPECT_GT(drag.norm(), 1e-3);
  EXPECT_LT((active - passive + drag).norm(), 1e-9 * drag.norm());
}

// A preconditioner has it in the elements alone.
TEST(FibreDrag, OfSmoothedElementsHasAPlainMatrixThatIsThatOfPlainOnes) {
  const SmoothedElasticity muscle = smoothed_muscle();
  const Moving m(Block{muscle});
  BlockMatrix all = muscle.make_matrix(), found = muscle.make_plain_matrix(), expected = found;
  FibreDrag::Lines lines, of_plain;
  m.block.drag.add_tangent(m.x, m.v, 0.7, 3, 0, lines, all);
  m.block.drag.add_plain_damping(m.x, m.v, 0.7, 3, lines, found);
  FibreDrag(m.block.mesh.X, m.block.mesh.tets, muscle.fibres(), kFibre, expected)
      .add_tangent(m.x, m.v, 0.7, 3, 0, of_plain, expected);
  EXPECT_GT(dense(expected).norm(), 0);
  EXPECT_LT((dense(found) - dense(expected)).norm(), 1e-12 * dense(expected).norm());
}

/// Newton's iteration for the rate at which a block shortens under its own fibres, a spring of
/// rates and a force, from a rate at which fibres no longer pull. @return iterations, or 40
int iterations_to_rest(bool keeps_lines) {
  constexpr double kPull = 0.02, kForce = -16;  // [N s], [N]
  Block block(Vec3::UnitX());
  const Positions& X = block.mesh.X;
  const Positions along = Vec3::UnitX().asDiagonal() * X;  // v at a rate of 1/s
  const auto dot = [](const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); };
  FibreDrag::Lines lines;
  double rate = -40;
  for (int k = 0; k < 40; ++k) {
    const double residual =
        dot(block.force(X, rate * along, 1), along) + kPull * rate - kForce * 1e-3;
    BlockMatrix D = block.matrix;
    D.set_zero();
    if (!keeps_lines) lines.clear();
    block.drag.add_tangent(X, rate * along, 1, 1, 0, lines, D);
    const double slope = along.reshaped().dot(dense(D) * along.reshaped()) + kPull;
    const double change = -residual / slope;
    if (std::abs(change) < 1e-10) return k;
    rate += change;
  }
  return 40;
}

TEST(FibreDrag, LinesEndTheCyclesOfNewtonsIteration) {
  EXPECT_EQ(iterations_to_rest(false), 40);
  EXPECT_LT(iterations_to_rest(true), 12);
}

// The matrix of one motion does not depend on how often it is asked for.
TEST_P(MovingFibres, OfTheSameMotionHaveTheSameMatrix) {
  FibreDrag::Lines lines;
  BlockMatrix first = m.block.matrix, again = first;
  m.block.drag.add_tangent(m.x, -3 * m.v, 0.7, 1, 0, lines, m.block.matrix);
  m.block.drag.add_tangent(m.x, m.v, 0.7, 1, 0, lines, first);
  m.block.drag.add_tangent(m.x, m.v, 0.7, 1, 0, lines, again);
  EXPECT_EQ(dense(first), dense(again));
  FibreDrag::Lines none;
  BlockMatrix own = m.block.matrix;
  own.set_zero();
  m.block.drag.add_tangent(m.x, m.v, 0.7, 1, 0, none, own);
  EXPECT_GT((dense(own) - dense(first)).norm(), 1e-3 * dense(own).norm());
}

TEST_P(MovingFibres, HaveAPowerThatIsTheirForceTimesTheVelocity) {
  const double expected = m.block.force(m.x, m.v, 0.7).cwiseProduct(m.v).sum();
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(m.block.drag.power(m.x, m.v, 0.7), expected, 1e-12 * expected);
}

TEST_P(MovingFibres, RestWhereNothingIsActive) { EXPECT_EQ(m.block.force(m.x, m.v, 0).norm(), 0); }

}  // namespace articular::fem::fibre_drag_test
