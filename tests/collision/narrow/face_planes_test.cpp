#include "collision/narrow/face_planes.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/collision/support/oracles.hpp"

namespace articular::collision::face_planes_test {

using testing::separating_axis_gap;
using testing::Tetrahedron;
using testing::Triangle;

template <class Shape>
Shape random_shape(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  Shape shape;
  for (double& c : shape.reshaped()) c = coordinate(random);
  return shape;
}

class FacePlanesScale : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(FacePlanes, FacePlanesScale,
                         ::testing::Values(1e-100, 1e-5, 1e-3, 1.0, 1e3, 1e100));

// A verdict must be the truth at every scale; that the planes leave many pairs open is no error.
TEST_P(FacePlanesScale, AVerdictIsThatOfAllSeparatingAxes) {
  const double scale = GetParam();
  std::mt19937 random(11);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto triangle = random_shape<Triangle>(random, 1);
    const auto tetrahedron = random_shape<Tetrahedron>(random, 1);
    const PlaneVerdict verdict = face_planes(scale * triangle, scale * tetrahedron, 0);
    if (verdict == PlaneVerdict::Unknown) continue;
    const double gap = separating_axis_gap(triangle, tetrahedron);
    ASSERT_EQ(verdict, gap > 0 ? PlaneVerdict::Apart : PlaneVerdict::Overlapping) << gap;
    (gap > 0 ? apart : overlapping) += 1;
  }
  if (scale > 1e-50 && scale < 1e50) {
    EXPECT_GT(apart, 2000);
    EXPECT_GT(overlapping, 200);
  }
}

TEST(FacePlanes, WithAMarginOnlyPairsFartherThanItAreApart) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> fraction(0.5, 2);
  int apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto triangle = random_shape<Triangle>(random, 1);
    auto tetrahedron = random_shape<Tetrahedron>(random, 1);
    tetrahedron.colwise() += Eigen::Vector3d(1, 0.5, 0);
    const double gap = separating_axis_gap(triangle, tetrahedron);  // a lower bound of the distance
    if (gap <= 0) continue;
    const double margin = fraction(random) * gap;
    if (face_planes(triangle, tetrahedron, margin) != PlaneVerdict::Apart) continue;
    ASSERT_GT(gap, margin);
    ++apart;
  }
  EXPECT_GT(apart, 500);
}

TEST(FacePlanes, FlatShapesAndCommonCornersAreLeftToGjk) {
  std::mt19937 random(13);
  for (int i = 0; i < 5000; ++i) {
    auto triangle = random_shape<Triangle>(random, 1);
    auto tetrahedron = random_shape<Tetrahedron>(random, 1);
    for (int k = 0; k <= i % 3; ++k) triangle.col(k) = tetrahedron.col(k);
    ASSERT_NE(face_planes(triangle, tetrahedron, 0), PlaneVerdict::Apart);
    tetrahedron.row(2).setZero();
    ASSERT_NE(face_planes(triangle, tetrahedron, 0), PlaneVerdict::Overlapping);
  }
}

}  // namespace articular::collision::face_planes_test
