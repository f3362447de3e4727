#include "collision/narrow/gjk.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/collision/support/meshes.hpp"
#include "tests/collision/support/oracles.hpp"

namespace articular::collision::testing::gjk_test {

struct RandomPair {
  Triangle triangle;
  Tetrahedron tetrahedron;
};

/// Corners in a cube of edge 2; the triangle's centre up to 0.3 off: about half of the pairs meet.
RandomPair random_pair(std::mt19937& random) {
  RandomPair pair;
  const Eigen::Vector3d offset = random_vector(random, 0.3);
  for (int k = 0; k < 3; ++k) pair.triangle.col(k) = offset + random_vector(random, 1);
  for (int k = 0; k < 4; ++k) pair.tetrahedron.col(k) = random_vector(random, 1);
  return pair;
}

/// Distance of shapes in the plane z = 0; 0 if they meet.
double distance_in_plane(const Triangle& triangle, const Tetrahedron& tetrahedron) {
  const auto contains = [](const Triangle& t, const Eigen::Vector3d& p) {
    double sides[3];
    for (int i = 0; i < 3; ++i) sides[i] = (t.col((i + 1) % 3) - t.col(i)).cross(p - t.col(i)).z();
    const auto [least, most] = std::minmax({sides[0], sides[1], sides[2]});
    return least > 0 || most < 0;
  };
  const auto cross = [](const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                        const Eigen::Vector3d& b0, const Eigen::Vector3d& b1) {
    return (a1 - a0).cross(b0 - a0).z() * (a1 - a0).cross(b1 - a0).z() < 0 &&
           (b1 - b0).cross(a0 - b0).z() * (b1 - b0).cross(a1 - b0).z() < 0;
  };
  for (int k = 0; k < 4; ++k)
    if (contains(triangle, tetrahedron.col(k))) return 0;
  for (const auto& [a, b, c] : kTetFaces) {
    Triangle face;
    face << tetrahedron.col(a), tetrahedron.col(b), tetrahedron.col(c);
    if (contains(face, triangle.col(0))) return 0;
  }
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    for (const auto& [a, b] : kTetEdges) {
      const Eigen::Vector3d t0 = triangle.col(i), t1 = triangle.col((i + 1) % 3);
      if (cross(t0, t1, tetrahedron.col(a), tetrahedron.col(b))) return 0;
      distance = std::min(distance,
                          segment_segment_distance(t0, t1, tetrahedron.col(a), tetrahedron.col(b)));
    }
  return distance;
}

// Near-touching pairs are left out: their answer is a matter of round-off. 1e-6 of the pair's size
// is far above what libccd calls touching for any of these shapes.
constexpr double kNearTouching = 1e-6;

class GjkScale : public ::testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Gjk, GjkScale,
                         ::testing::Values(1e-100, 1e-9, 1e-5, 1e-3, 2e-3, 0.1, 1.0, 1e3, 1e9,
                                           1e100));

TEST_P(GjkScale, AgreesWithSeparatingAxesWhateverTheUnitOfLength) {
  const double scale = GetParam();
  std::mt19937 random(3);
  int num_pairs = 0, num_intersecting = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto [triangle, tetrahedron] = random_pair(random);
    const double gap = separating_axis_gap(triangle, tetrahedron);
    if (std::abs(gap) < kNearTouching) continue;
    const GjkOutcome outcome = gjk(scale * triangle, scale * tetrahedron);
    ASSERT_EQ(outcome, gap > 0 ? GjkOutcome::Separated : GjkOutcome::Intersecting)
        << "gap " << gap << "\n"
        << triangle << "\n"
        << tetrahedron;
    ++num_pairs;
    num_intersecting += gap < 0 ? 1 : 0;
  }
  EXPECT_GT(num_intersecting, 0.3 * num_pairs);
  EXPECT_LT(num_intersecting, 0.7 * num_pairs);
}

TEST(Gjk, ElementsOfAMillimetreAKilometreFromTheOriginAreToldApart) {
  std::mt19937 random(4);
  const Eigen::Vector3d far(1000, -700, 400);
  int num_intersecting = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto [triangle, tetrahedron] = random_pair(random);
    const double gap = separating_axis_gap(triangle, tetrahedron);
    if (std::abs(gap) < kNearTouching) continue;
    const Triangle t = (1e-3 * triangle).colwise() + far;
    const Tetrahedron w = (1e-3 * tetrahedron).colwise() + far;
    ASSERT_EQ(gjk_overlap(t, w), gap < 0) << gap;
    num_intersecting += gap < 0 ? 1 : 0;
  }
  EXPECT_GT(num_intersecting, 5000);
}

TEST(Gjk, TheAnswerDoesNotDependOnTheOrderOfTheShapes) {
  std::mt19937 random(5);
  for (int i = 0; i < 10000; ++i) {
    const auto [triangle, tetrahedron] = random_pair(random);
    if (std::abs(separating_axis_gap(triangle, tetrahedron)) < kNearTouching) continue;
    ASSERT_EQ(gjk_overlap(triangle, tetrahedron), gjk_overlap(tetrahedron, triangle));
  }
}

TEST(Gjk, ShapesThatTouchCountAsIntersecting) {
  std::mt19937 random(6);
  for (int i = 0; i < 20000; ++i) {
    auto [triangle, tetrahedron] = random_pair(random);
    const int num_common = 1 + i % 3;  // a corner, an edge, a face in common
    for (int k = 0; k < num_common; ++k) triangle.col(k) = tetrahedron.col(k);
    ASSERT_TRUE(gjk_overlap(1e-3 * triangle, 1e-3 * tetrahedron))
        << num_common << " common corners";
  }
}

TEST(Gjk, FlatTetrahedraAndTrianglesAreToldApart) {
  std::mt19937 random(7);
  int num_pairs = 0, num_intersecting = 0, num_undecided = 0;
  for (int i = 0; i < 40000; ++i) {
    auto [triangle, tetrahedron] = random_pair(random);
    const int kind = i % 5;
    if (kind < 2) tetrahedron.row(2).setZero();  // a quadrangle or a triangle in the plane z = 0
    if (kind == 1) triangle.row(2).setZero();    // both in that plane
    if (kind == 2) tetrahedron.col(3) = tetrahedron.col(2);                       // a triangle
    if (kind == 3) triangle.col(2) = triangle.col(1);                             // a segment
    if (kind == 4) tetrahedron.col(2) = tetrahedron.col(3) = tetrahedron.col(1);  // a segment
    double distance = triangle_tetrahedron_distance(triangle, tetrahedron);
    if (kind == 1) distance = distance_in_plane(triangle, tetrahedron);
    if (distance > 0 && distance < kNearTouching) continue;
    const GjkOutcome outcome = gjk(triangle, tetrahedron);
    num_undecided += outcome == GjkOutcome::Undecided ? 1 : 0;
    ASSERT_EQ(outcome != GjkOutcome::Separated, distance == 0)
        << "kind " << kind << " distance " << distance << "\n"
        << triangle << "\n"
        << tetrahedron;
    ++num_pairs;
    num_intersecting += distance == 0 ? 1 : 0;
  }
  EXPECT_LT(num_undecided, num_pairs / 100);
  EXPECT_GT(num_intersecting, num_pairs / 20);
  EXPECT_LT(num_intersecting, num_pairs / 2);
}

TEST(Gjk, WithAMarginShapesMeetUpToThatDistance) {
  std::mt19937 random(8);
  const double margin = 0.2, scale = 1e-3;
  int num_pairs = 0, num_within = 0;
  for (int i = 0; i < 20000; ++i) {
    auto [triangle, tetrahedron] = random_pair(random);
    triangle.colwise() += random_vector(random, 1);
    const double distance = triangle_tetrahedron_distance(triangle, tetrahedron);
    if (std::abs(distance - margin) < 1e-3 * margin) continue;
    ASSERT_EQ(gjk_overlap(scale * triangle, scale * tetrahedron, scale * margin), distance < margin)
        << distance;
    ++num_pairs;
    num_within += distance < margin ? 1 : 0;
  }
  EXPECT_GT(num_within, 0.3 * num_pairs);
  EXPECT_LT(num_within, 0.7 * num_pairs);
}

TEST(Gjk, WithAMarginNoPairWithinItIsLostHoweverNearTheLimit) {
  std::mt19937 random(9);
  for (int i = 0; i < 20000; ++i) {
    auto [triangle, tetrahedron] = random_pair(random);
    triangle.colwise() += random_vector(random, 1);
    const double distance = triangle_tetrahedron_distance(triangle, tetrahedron);
    ASSERT_TRUE(gjk_overlap(triangle, tetrahedron, distance * (1 + 1e-9))) << distance;
  }
}

/// Corners of the linear elements, in an element's own coordinates: convex, and so are their affine
/// images. Named after VTK's cells.
struct ElementShape {
  const char* name;
  std::vector<Eigen::Vector3d> corners;
};

const std::array<ElementShape, 4>& element_shapes() {
  static const std::array<ElementShape, 4> shapes = {{
      {"Triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
      {"Tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {"Wedge", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
      {"Hexahedron",
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
  }};
  return shapes;
}

/// A deformed element: each corner of a sheared and turned one moved by up to a tenth of its edge.
Eigen::Matrix3Xd random_element(const ElementShape& shape, std::mt19937& random) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (double& x : F.reshaped()) x += std::uniform_real_distribution<double>(-0.5, 0.5)(random);
  Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(shape.corners.size()));
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    x.col(k) = F * (shape.corners[static_cast<std::size_t>(k)] + random_vector(random, 0.1));
  return placed(x, random_vector(random, 0.8), random);
}

/// Largest gap along any normal that a face of the difference of two convex hulls can have: of the
/// planes through three corners of one, and along a connection of two corners of each.
double hull_gap(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  double gap = -std::numeric_limits<double>::infinity();
  const auto try_axis = [&](const Eigen::Vector3d& axis) {
    if (axis.norm() < 1e-6) return;
    const Eigen::RowVectorXd on_a = axis.normalized().transpose() * a;
    const Eigen::RowVectorXd on_b = axis.normalized().transpose() * b;
    gap = std::max({gap, on_a.minCoeff() - on_b.maxCoeff(), on_b.minCoeff() - on_a.maxCoeff()});
  };
  const auto connections = [](const Eigen::Matrix3Xd& x) {
    std::vector<Eigen::Vector3d> all;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      for (Eigen::Index j = i + 1; j < x.cols(); ++j) all.push_back(x.col(j) - x.col(i));
    return all;
  };
  const auto of_a = connections(a), of_b = connections(b);
  for (const auto* of_one : {&of_a, &of_b})
    for (const Eigen::Vector3d& u : *of_one)
      for (const Eigen::Vector3d& v : *of_one) try_axis(u.cross(v));
  for (const Eigen::Vector3d& u : of_a)
    for (const Eigen::Vector3d& v : of_b) try_axis(u.cross(v));
  return gap;
}

TEST_P(GjkScale, TrianglesTetrahedraWedgesAndHexahedraAreToldApartFromEachOther) {
  const double scale = GetParam();
  std::mt19937 random(10);
  for (const ElementShape& shape_a : element_shapes())
    for (const ElementShape& shape_b : element_shapes()) {
      SCOPED_TRACE(std::string(shape_a.name) + " and " + shape_b.name);
      int num_pairs = 0, num_intersecting = 0;
      for (int i = 0; i < 60; ++i) {
        const Eigen::Matrix3Xd a = random_element(shape_a, random);
        const Eigen::Matrix3Xd b = random_element(shape_b, random);
        const double gap = hull_gap(a, b);
        if (std::abs(gap) < kNearTouching) continue;
        ASSERT_EQ(gjk(scale * a, scale * b),
                  gap > 0 ? GjkOutcome::Separated : GjkOutcome::Intersecting)
            << "gap " << gap << "\n"
            << a << "\n"
            << b;
        ++num_pairs;
        num_intersecting += gap < 0 ? 1 : 0;
      }
      EXPECT_GT(num_intersecting, 0.1 * num_pairs);
      EXPECT_LT(num_intersecting, 0.9 * num_pairs);
    }
}

TEST(Gjk, AnyConvexShapeMayBeGivenByItsPoints) {
  Eigen::Matrix3Xd cube(3, 8);  // a hexahedral element, [0, 1]³
  for (int k = 0; k < 8; ++k) cube.col(k) = Eigen::Vector3d(k & 1, (k >> 1) & 1, (k >> 2) & 1);
  std::mt19937 random(10);
  int num_inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p = Eigen::Vector3d::Constant(0.5) + random_vector(random, 0.65);
    const double outside = (p.array() - 0.5).abs().maxCoeff() - 0.5;
    if (std::abs(outside) < kNearTouching) continue;
    const Eigen::Matrix3Xd point = p;
    ASSERT_EQ(gjk_overlap(cube, point), outside < 0);
    num_inside += outside < 0 ? 1 : 0;
  }
  EXPECT_GT(num_inside, 1500);
  EXPECT_LT(num_inside, 3500);
}

TEST(Gjk, ShapesOfOnePointMeetIfTheyAreTheSamePoint) {
  const Eigen::Matrix3Xd p = Eigen::Vector3d(1, 2, 3), q = Eigen::Vector3d(1, 2, 3.1);
  EXPECT_TRUE(gjk_overlap(p, p));
  EXPECT_FALSE(gjk_overlap(p, q));
  EXPECT_FALSE(gjk_overlap(p, q, 0.09));
  EXPECT_TRUE(gjk_overlap(p, q, 0.11));
}

// Elements of a regular mesh have parallel edges; the difference of two such shapes has flat parts
// on which libccd gives up, 1.2 edges apart.
TEST(Gjk, SeparatesElementsOfARegularMeshWithParallelEdges) {
  Eigen::Matrix3d triangle;
  triangle << 0, -0.84065572344898865, -0.84065572344898865,  //
      -2, -2, -2.0 / 3,                                       //
      -5.8476088003261752, -3.5379261826147892, -3.5379261826147896;
  Eigen::Matrix<double, 3, 4> tetrahedron;
  tetrahedron << -1.6813114468979773, -0.84065572344898853, -0.73624543225055448,
      -0.73624543225055448,                 //
      2.0 / 3, 2.0 / 3, 2.0 / 3, -2.0 / 3,  //
      -1.2282435649034027, -3.5379261826147892, 0.073614766842947779, 0.073614766842947779;
  EXPECT_EQ(gjk(triangle, tetrahedron), GjkOutcome::Separated);
}

}  // namespace articular::collision::testing::gjk_test
