#include "collision/blocks/still_covers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/collision/support/rule_oracle.hpp"

namespace articular::collision::testing::still_covers_test {

/// Every node moved by exactly the distance [m], in random directions.
Eigen::Matrix3Xd moved_by(Eigen::Matrix3Xd x, double distance, std::mt19937& random) {
  for (auto p : x.colwise()) p += distance * random_vector(random, 1).normalized();
  return x;
}

bool is_among(const std::vector<Penetration>& pairs, const std::vector<Penetration>& candidates) {
  return std::includes(candidates.begin(), candidates.end(), pairs.begin(), pairs.end());
}

// In several units of length and places, against the rule on all pairs.
TEST(StillCovers, NoPairAppearsThatWasNotACandidate) {
  std::mt19937 random(1);
  const Mesh a = box_mesh(4, 3, 2, 1), b = box_mesh(3, 3, 3, 1.1);
  std::size_t met = 0, appeared = 0;
  for (const double unit : {1e-12, 1.0, 1e9})
    for (const double margin : {0.02 * unit, 0.5 * unit})
      for (const NarrowTest narrow : {NarrowTest::SeparatingAxes, NarrowTest::Gjk})
        for (int trial = 0; trial < 4; ++trial) {
          const Eigen::Matrix3Xd x_a = unit * jittered(a.X, 0.2, random);
          // Faces of the two boxes nearly in one plane: the worst for what is just beyond the
          // margin.
          const Eigen::Vector3d shift(4.1 * unit + margin, 0, 0.1 * unit);
          const Eigen::Matrix3Xd x_b = (unit * jittered(b.X, 0.2, random)).colwise() + shift;
          const BlockTree A = tree_of(a, x_a, margin), B = tree_of(b, x_b, margin);
          const std::vector<Penetration> candidates = faces_in(A, B, {narrow}).pairs;
          for (const double part : {0.5, 0.999, 1 - 1e-9}) {
            Eigen::Matrix3Xd y_a = moved_by(x_a, 0.5 * margin * part, random), y_b = x_b;
            if (trial % 2 == 0) {  // straight towards each other
              y_a = x_a.colwise() + Eigen::Vector3d(0.5 * margin * part, 0, 0);
              y_b.row(0).array() -= 0.5 * margin * part;
            }
            ASSERT_TRUE(still_covers(A, y_a)) << unit << " " << margin << " " << part;
            ASSERT_TRUE(still_covers(B, y_b));
            const auto pairs = by_rule(a, y_a, b, y_b, 0, narrow);
            EXPECT_TRUE(is_among(pairs, candidates));
            met += pairs.size();
            appeared += is_among(pairs, by_rule(a, x_a, b, x_b, 0, narrow)) ? 0 : 1;
          }
        }
  EXPECT_GT(met, 500u);
  EXPECT_GT(appeared, 10u);
}

TEST(StillCovers, SaysNoAsSoonAsOneNodeIsTooFar) {
  std::mt19937 random(2);
  const Mesh mesh = box_mesh(3, 3, 3, 1);
  for (const double margin : {1e-200, 1e-6, 0.1, 1e3}) {
    const double unit = margin < 1e-100 ? 1e-195 : 1;
    const BlockTree tree = tree_of(mesh, unit * mesh.X, margin);
    EXPECT_TRUE(still_covers(tree, unit * mesh.X));
    for (int trial = 0; trial < 10; ++trial) {
      Eigen::Matrix3Xd x = moved_by(unit * mesh.X, 0.49 * margin, random);
      EXPECT_TRUE(still_covers(tree, x));
      const auto node = static_cast<Eigen::Index>(random() % 64);
      x.col(node) =
          unit * mesh.X.col(node) + 0.50001 * margin * random_vector(random, 1).stableNormalized();
      EXPECT_FALSE(still_covers(tree, x));
    }
  }
}

TEST(StillCovers, WithoutAMarginNothingIsCovered) {
  const Mesh mesh = box_mesh(2, 2, 2, 1);
  EXPECT_FALSE(still_covers(tree_of(mesh, mesh.X), mesh.X));
  EXPECT_FALSE(still_covers(tree_of(mesh, mesh.X, 1e-15), mesh.X));
  EXPECT_FALSE(still_covers(BlockTree(mesh.tets, mesh.surface, mesh.X), mesh.X));
}

TEST(StillCovers, APositionThatIsNoNumberIsNotCovered) {
  const Mesh mesh = box_mesh(2, 2, 2, 1);
  const BlockTree tree = tree_of(mesh, mesh.X, 0.1);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Eigen::Matrix3Xd x = mesh.X;
    x(1, 4) = bad;
    EXPECT_FALSE(still_covers(tree, x));
  }
  EXPECT_THROW(still_covers(tree, mesh.X.leftCols(3)), std::invalid_argument);
}

}  // namespace articular::collision::testing::still_covers_test
