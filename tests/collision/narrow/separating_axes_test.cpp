#include "collision/narrow/separating_axes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/collision/support/exact_referee.hpp"
#include "tests/collision/support/meshes.hpp"
#include "tests/collision/support/oracles.hpp"
#include "tests/collision/support/rounds.hpp"

namespace articular::collision::testing::separating_axes_test {

// Shapes farther apart than this part of the pair's size must be told apart. The header promises
// some 1e-14; the callers need 1e-12.
constexpr double kResolved = 3e-14;

struct Pair {
  Triangle triangle;
  Tetrahedron tetrahedron;
};

std::ostream& operator<<(std::ostream& out, const Pair& pair) {
  const Eigen::IOFormat all_digits(Eigen::FullPrecision);
  return out << pair.triangle.format(all_digits) << "\n"
             << pair.tetrahedron.format(all_digits) << "\n";
}

double size(const Pair& pair) {
  const Eigen::Vector3d least =
      pair.triangle.rowwise().minCoeff().cwiseMin(pair.tetrahedron.rowwise().minCoeff());
  const Eigen::Vector3d most =
      pair.triangle.rowwise().maxCoeff().cwiseMax(pair.tetrahedron.rowwise().maxCoeff());
  return (most - least).maxCoeff();
}

bool overlap(const Pair& pair, double margin = 0) {
  return separating_axes_overlap(pair.triangle, pair.tetrahedron, margin);
}

/// x ↦ M x + offset.
Pair mapped(const Pair& pair, const Eigen::Matrix3d& M, const Eigen::Vector3d& offset) {
  return {(M * pair.triangle).colwise() + offset, (M * pair.tetrahedron).colwise() + offset};
}

Pair scaled(const Pair& pair, double scale) {
  return {scale * pair.triangle, scale * pair.tetrahedron};
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Eigen::Matrix3d random_rotation(std::mt19937& random) {
  return Eigen::AngleAxisd(uniform(random, 0, 3), random_vector(random, 1).normalized()).matrix();
}

Pair random_pair(std::mt19937& random) {
  Pair pair;
  for (int k = 0; k < 3; ++k) pair.triangle.col(k) = random_vector(random, 1);
  for (int k = 0; k < 4; ++k) pair.tetrahedron.col(k) = random_vector(random, 1);
  return pair;
}

/// Random direction along which shapes can touch: across a face, two edges, or any.
Eigen::Vector3d random_axis(const Pair& pair, std::mt19937& random) {
  const auto& [t, w] = pair;
  const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  Eigen::Vector3d axis;
  const int kind = pick(4), i = pick(3);
  if (kind == 0) axis = (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0));
  if (kind == 1) {
    const auto& [a, b, c] = kTetFaces[pick(4)];
    axis = (w.col(b) - w.col(a)).cross(w.col(c) - w.col(a));
  }
  if (kind == 2) {
    const auto& [a, b] = kTetEdges[pick(6)];
    axis = (t.col((i + 1) % 3) - t.col(i)).cross(w.col(b) - w.col(a));
  }
  if (kind == 3 || !(axis.norm() > 0)) axis = random_vector(random, 1);
  return (pick(2) == 0 ? 1 : -1) * axis.normalized();
}

/// The triangle moved so that its gap to the tetrahedron along the axis is the given one, with the
/// corners next to the gap over each other.
Pair brought_near(Pair pair, double gap, const Eigen::Vector3d& axis) {
  const auto front = [&](const auto& corners, double sign) {
    const Eigen::RowVectorXd along = sign * axis.transpose() * corners;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int num = 0;
    for (Eigen::Index k = 0; k < corners.cols(); ++k)
      if (along[k] > along.maxCoeff() - 1e-9) {
        sum += corners.col(k);
        ++num;
      }
    return Eigen::Vector3d(sum / num);
  };
  const Eigen::Vector3d move = front(pair.tetrahedron, 1) - front(pair.triangle, -1);
  pair.triangle.colwise() += move;
  const double is = (axis.transpose() * pair.triangle).minCoeff() -
                    (axis.transpose() * pair.tetrahedron).maxCoeff();
  pair.triangle.colwise() += Eigen::Vector3d((gap - is) * axis);
  return pair;
}

Pair brought_near(const Pair& pair, double gap, std::mt19937& random) {
  return brought_near(pair, gap, random_axis(pair, random));
}

/// ±1e-3 to ±1e-13, in turn.
double gap_of_case(int i) { return (i % 2 == 0 ? 1 : -1) * std::pow(10.0, -3 - (i / 2) % 11); }

/// Compares answers with the referee's and counts them.
class Comparison {
 public:
  void check(const Pair& pair) {
    const bool meets = exact::overlap(pair.triangle, pair.tetrahedron), found = overlap(pair);
    ++(meets ? num_meeting_ : num_apart_);
    ASSERT_TRUE(found || !meets) << "lost:\n" << pair;
    if (meets || !found) return;
    const double distance = exact::distance(pair.triangle, pair.tetrahedron);
    ASSERT_LE(distance, kResolved * size(pair)) << "not told apart:\n" << pair;
  }

  void expect_both_outcomes() const {
    const int num = num_meeting_ + num_apart_;
    EXPECT_GT(num_meeting_, 0.15 * num);
    EXPECT_GT(num_apart_, 0.15 * num);
  }

 private:
  int num_meeting_ = 0, num_apart_ = 0;
};

// Of the exact referee itself: its two methods, where both apply.
TEST(ExactReferee, ClippingAgreesWithCaratheodory) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> digit(0, 3);
  int num_meeting = 0;
  for (int i = 0; i < 400; ++i) {
    Pair pair = brought_near(random_pair(random), gap_of_case(i), random);
    if (i % 2 == 0) {  // corners on a small grid: touching in many ways
      for (double& x : pair.triangle.reshaped()) x = digit(random);
      for (double& x : pair.tetrahedron.reshaped()) x = digit(random);
    }
    const exact::Pair integers = exact::integer_pair(pair.triangle, pair.tetrahedron);
    if (exact::volume(integers.tetrahedron) == 0) continue;
    const bool meets = exact::clipping_leaves_something(integers);
    ASSERT_EQ(meets, exact::differences_surround_origin(integers)) << pair;
    num_meeting += meets ? 1 : 0;
  }
  EXPECT_GT(num_meeting, 80);
  EXPECT_LT(num_meeting, 320);
}

TEST(ExactReferee, DistanceIsTheOneInDoublePrecisionForPlainShapes) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Pair pair = brought_near(random_pair(random), 0.3, random);
    EXPECT_NEAR(exact::distance(pair.triangle, pair.tetrahedron),
                triangle_tetrahedron_distance(pair.triangle, pair.tetrahedron), 1e-12);
  }
}

class SeparatingAxesScale : public ::testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(SeparatingAxes, SeparatingAxesScale,
                         ::testing::Values(1e-300, 1e-100, 1e-29, 1e-3, 1.0, 1e29, 1e100, 1e300));

TEST_P(SeparatingAxesScale, NearTouchingPairsAreDecidedAsInExactArithmetic) {
  std::mt19937 random(3);
  Comparison comparison;
  for (int i = 0; i < rounds(1100); ++i)
    ASSERT_NO_FATAL_FAILURE(comparison.check(
        scaled(brought_near(random_pair(random), gap_of_case(i), random), GetParam())));
  comparison.expect_both_outcomes();
}

TEST(SeparatingAxes, FarFromTheOriginPairsAreDecidedAsInExactArithmetic) {
  std::mt19937 random(4);
  Comparison comparison;
  for (int i = 0; i < rounds(1100); ++i) {
    const Pair pair = brought_near(random_pair(random), gap_of_case(i), random);
    const Eigen::Vector3d far = random_vector(random, std::pow(10.0, i % 7));
    ASSERT_NO_FATAL_FAILURE(comparison.check(mapped(pair, Eigen::Matrix3d::Identity(), far)));
  }
  comparison.expect_both_outcomes();
}

enum class Sliver { Needle, Cap, Wedge, Crossing, ThinTriangle, NumKinds };

/// A shape of the given thickness against one that is not, or (both) one alike.
Pair sliver_pair(Sliver kind, double thickness, bool both, std::mt19937& random) {
  Pair pair = random_pair(random);
  auto& [t, w] = pair;
  const auto speck = [&] { return random_vector(random, thickness); };
  const Eigen::Vector3d u = w.col(1) - w.col(0), v = w.col(2) - w.col(0);
  switch (kind) {
    case Sliver::Needle:  // all nodes along one line
      for (int k = 1; k < 4; ++k) w.col(k) = w.col(0) + uniform(random, 0, 1) * u + speck();
      break;
    case Sliver::Cap:  // a node over the inside of the opposite face
      w.col(3) = w.col(0) + 0.3 * u + 0.3 * v + speck();
      break;
    case Sliver::Wedge:  // a short edge
      w.col(3) = w.col(2) + speck();
      break;
    case Sliver::Crossing:  // two opposite edges that nearly meet
      w.col(3) = w.col(0) + uniform(random, 0.2, 0.8) * (u + v) + speck();
      break;
    case Sliver::ThinTriangle:
    case Sliver::NumKinds:
      break;
  }
  if (both || kind == Sliver::ThinTriangle)
    t.col(2) = t.col(0) + uniform(random, 0, 1) * (t.col(1) - t.col(0)) + speck();
  if (both)  // and nearly parallel to an edge, or in a face
    for (int k = 0; k < 2; ++k)
      t.col(k) = w.col(0) + uniform(random, -1, 1) * u + speck() +
                 (thickness < 1e-5 ? uniform(random, -1, 1) : 0) * v;
  return pair;
}

TEST(SeparatingAxes, SliversAreDecidedAsInExactArithmetic) {
  std::mt19937 random(5);
  constexpr int kKinds = static_cast<int>(Sliver::NumKinds);
  for (int kind = 0; kind < kKinds; ++kind) {
    Comparison comparison;
    for (int i = 0; i < rounds(1100); ++i) {
      const double thickness = std::pow(10.0, uniform(random, -11, -1));
      const Pair pair = sliver_pair(static_cast<Sliver>(kind), thickness, i % 3 == 0, random);
      ASSERT_NO_FATAL_FAILURE(comparison.check(brought_near(pair, gap_of_case(i), random)));
    }
    SCOPED_TRACE(kind);
    comparison.expect_both_outcomes();
  }
}

TEST(SeparatingAxes, ShapesOfVeryDifferentSizeAreDecidedAsInExactArithmetic) {
  std::mt19937 random(6);
  Comparison comparison;
  for (int i = 0; i < rounds(2200); ++i) {
    Pair pair = random_pair(random);
    const double ratio = std::pow(10.0, uniform(random, -6, -1));
    if (i % 4 < 2)
      pair.triangle *= ratio;
    else
      pair.tetrahedron *= ratio;
    ASSERT_NO_FATAL_FAILURE(comparison.check(brought_near(pair, ratio * gap_of_case(i), random)));
  }
  comparison.expect_both_outcomes();
}

// Corners on a small grid, in space, a plane, a line and a point of it: all ways to be flat and to
// touch. Not one of these pairs is a matter of round-off.
TEST(SeparatingAxes, DegenerateShapesOnAGridAreDecidedAsInExactArithmetic) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> digit(0, 3), shear(-2, 2);
  int num = 0, num_meeting = 0;
  for (int i = 0; i < rounds(6000); ++i) {
    Pair pair;
    for (double& x : pair.triangle.reshaped()) x = digit(random);
    for (double& x : pair.tetrahedron.reshaped()) x = digit(random);
    const int rank_t = i % 4, rank_w = (i / 4) % 4;
    for (int k = std::min(rank_t, 2); k < 3; ++k) pair.triangle.row(k).setConstant(1);
    for (int k = rank_w; k < 3; ++k) pair.tetrahedron.row(k).setConstant(1);
    Eigen::Matrix3d M;  // off the axes, but still integers
    for (double& x : M.reshaped()) x = shear(random);
    if (M.determinant() == 0) M.setIdentity();
    const double unit = std::pow(2.0, -20 * (i % 3));
    pair = mapped(pair, unit * M, unit * Eigen::Vector3d(digit(random), 7, -1000 * digit(random)));
    const bool meets = exact::overlap(pair.triangle, pair.tetrahedron);
    ASSERT_EQ(overlap(pair), meets) << pair;
    ++num;
    num_meeting += meets ? 1 : 0;
  }
  EXPECT_GT(num_meeting, 0.15 * num);
  EXPECT_LT(num_meeting, 0.85 * num);
}

/// Shapes of any two dimensions from 0 to 2 in the plane z = 0, with a gap along a line in it.
Pair pair_in_plane(int i, std::mt19937& random) {
  Pair pair = random_pair(random);
  auto& [t, w] = pair;
  t.row(2).setZero();
  w.row(2).setZero();
  const int kind = (i / 22) % 6;
  if (kind == 1) t.col(2) = t.col(1);
  if (kind == 2) w.col(3) = w.col(2) = w.col(1);
  if (kind == 3) t.row(1).setZero(), w.row(1).setZero();
  if (kind == 4) t.col(2) = t.col(1) = t.col(0);
  if (kind == 5) w.colwise() = Eigen::Vector3d(w.col(0));
  return pair;
}

TEST(SeparatingAxes, NearTouchingShapesInOnePlaneAreDecidedAsInExactArithmetic) {
  std::mt19937 random(8);
  int num_apart = 0, num_meeting = 0;
  for (int i = 0; i < rounds(2200); ++i) {
    Pair pair = pair_in_plane(i, random);
    // Along the perpendicular to an edge, or along any line.
    Eigen::Vector3d edge = random_vector(random, 1);
    if (i % 3 == 0) edge = pair.triangle.col(1) - pair.triangle.col(0);
    if (i % 3 == 1) edge = pair.tetrahedron.col(1) - pair.tetrahedron.col(0);
    if (!(edge.norm() > 0)) edge = Eigen::Vector3d::UnitX();
    const Eigen::Vector3d axis = Eigen::Vector3d(-edge[1], edge[0], 0).normalized();
    pair = brought_near(pair, gap_of_case(i), axis);
    const auto& [t, w] = pair;
    const bool meets = exact::overlap(t, w), found = overlap(pair);
    ++(meets ? num_meeting : num_apart);
    ASSERT_TRUE(found || !meets) << pair;
    if (meets) continue;
    const double distance = exact::distance(t, w);
    ASSERT_TRUE(!found || distance <= kResolved * size(pair)) << pair;
    // Out of that plane the shapes are flat but for round-off.
    const Pair turned = mapped(pair, random_rotation(random), random_vector(random, 1));
    ASSERT_TRUE(distance < 1e-12 || !overlap(turned)) << turned;
  }
  EXPECT_GT(num_apart, rounds(500));
  EXPECT_GT(num_meeting, rounds(500));
}

TEST(SeparatingAxes, ShapesWithCommonCornersOverlapWhateverTheirPlaceAndScale) {
  std::mt19937 random(9);
  for (int i = 0; i < rounds(20000); ++i) {
    Pair pair = random_pair(random);
    if (i % 5 == 0) pair = sliver_pair(Sliver::Cap, 1e-9, false, random);
    const double scale = std::pow(10.0, uniform(random, -100, 100));
    pair = mapped(pair, scale * random_rotation(random), scale * random_vector(random, 100));
    for (int k = 0; k <= i % 3; ++k)
      pair.triangle.col((k + i) % 3) = pair.tetrahedron.col((i / 3 + k) % 4);
    ASSERT_TRUE(overlap(pair)) << pair;
  }
}

TEST(SeparatingAxes, PointsOverlapIfTheyAreTheSamePoint) {
  Pair pair;
  pair.triangle.colwise() = Eigen::Vector3d(1, 2, 3);
  pair.tetrahedron.colwise() = Eigen::Vector3d(1, 2, 3);
  EXPECT_TRUE(overlap(pair));
  EXPECT_TRUE(overlap(scaled(pair, 0)));
  pair.triangle.colwise() = Eigen::Vector3d(1, 2, 3 + 1e-15);
  EXPECT_FALSE(overlap(pair));  // far apart, for a pair of this size
  pair.triangle.colwise() = Eigen::Vector3d(1, 2, 3.1);
  EXPECT_FALSE(overlap(pair, 0.099));
  EXPECT_TRUE(overlap(pair, 0.101));
}

TEST(SeparatingAxes, TheOrderOfTheNodesAndTheSignOfTheVolumeDoNotMatter) {
  std::mt19937 random(10);
  for (int i = 0; i < 300; ++i) {
    Pair pair = i % 2 == 0 ? random_pair(random)
                           : sliver_pair(static_cast<Sliver>(i % 5), 1e-7, i % 3 == 0, random);
    pair = brought_near(pair, (i % 4 < 2 ? 1 : -1) * 1e-10, random);
    if (!exact::overlap(pair.triangle, pair.tetrahedron) &&
        exact::distance(pair.triangle, pair.tetrahedron) < 1e-12)
      continue;
    const bool expected = overlap(pair);
    std::array<int, 4> w = {0, 1, 2, 3};
    do {
      std::array<int, 3> t = {0, 1, 2};
      do {
        const Pair permuted = {pair.triangle(Eigen::all, t), pair.tetrahedron(Eigen::all, w)};
        ASSERT_EQ(overlap(permuted), expected) << permuted;
      } while (std::next_permutation(t.begin(), t.end()));
    } while (std::next_permutation(w.begin(), w.end()));
  }
}

TEST(SeparatingAxes, ADisplacementOrAnotherUnitOfLengthDoesNotMatter) {
  std::mt19937 random(11);
  int num_overlapping = 0;
  for (int i = 0; i < rounds(10000); ++i) {
    const Pair pair = brought_near(random_pair(random), gap_of_case(i % 14), random);
    const double gap = separating_axis_gap(pair.triangle, pair.tetrahedron);
    if (std::abs(gap) < 1e-12) continue;
    ASSERT_EQ(overlap(pair), gap < 0) << pair;
    const double scale = std::pow(10.0, uniform(random, -100, 100));
    const Pair elsewhere =
        mapped(pair, scale * random_rotation(random), scale * random_vector(random, 10));
    ASSERT_EQ(overlap(elsewhere), gap < 0) << elsewhere;
    num_overlapping += gap < 0 ? 1 : 0;
  }
  EXPECT_GT(num_overlapping, rounds(3000));
}

TEST(SeparatingAxes, WithAMarginPairsOverlapUpToThatDistance) {
  std::mt19937 random(12);
  int num_apart = 0;
  for (int i = 0; i < rounds(1500); ++i) {
    const double gap = std::pow(10.0, uniform(random, -9, 0.5));
    const double scale = std::pow(10.0, uniform(random, -100, 100));
    Pair pair = random_pair(random);
    if (i % 3 == 1) {
      const double thickness = std::pow(10.0, uniform(random, -11, -1));
      pair = sliver_pair(static_cast<Sliver>(i % 5), thickness, i % 2 == 0, random);
    }
    if (i % 3 == 2) pair = pair_in_plane(i, random);
    pair = scaled(brought_near(pair, gap, random), scale);
    if (exact::overlap(pair.triangle, pair.tetrahedron)) {
      ASSERT_TRUE(overlap(pair, 0.1 * scale * gap)) << pair;
      continue;
    }
    const double distance = exact::distance(pair.triangle, pair.tetrahedron);
    const double clear = 1e-12 * (distance + size(pair));
    ASSERT_TRUE(overlap(pair, distance)) << distance << "\n" << pair;
    ASSERT_TRUE(overlap(pair, 2 * distance)) << distance << "\n" << pair;
    if (distance > clear) {
      ASSERT_FALSE(overlap(pair, distance - clear)) << distance << "\n" << pair;
      ASSERT_FALSE(overlap(pair, 0.5 * (distance - clear))) << distance << "\n" << pair;
    }
    ++num_apart;
  }
  EXPECT_GT(num_apart, rounds(500));
}

}  // namespace articular::collision::testing::separating_axes_test
