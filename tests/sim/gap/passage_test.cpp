// Where a moving point goes through a moving triangle.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "sim/gap/passage.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::passage_test {

struct Motion {
  Vec3 x0, x1;
  Mat3 q0, q1;
  Vec3 x(double s) const { return (1 - s) * x0 + s * x1; }
  Mat3 q(double s) const { return (1 - s) * q0 + s * q1; }
  /// Of the times between the two alone.
  Motion between(double s, double t) const { return {x(s), x(t), q(s), q(t)}; }
  Passages passages() const { return sim::passages(x0, x1, q0, q1); }
};

Motion random_motion(Random& random) {
  const auto corners = [&] {
    Mat3 q;
    for (auto corner : q.colwise()) corner = 2 * random.vec3();  // large ones are met more often
    return q;
  };
  return {random.vec3(), random.vec3(), corners(), corners()};
}

double volume(const Vec3& x, const Mat3& q) {
  return (q.col(1) - q.col(0)).cross(q.col(2) - q.col(0)).dot(x - q.col(0));
}

/// By small steps: where the sign changes, and whether the foot lies in the triangle there.
std::vector<Passage> by_steps(const Motion& motion, int steps) {
  std::vector<Passage> found;
  for (int k = 0; k < steps; ++k) {
    const double s = static_cast<double>(k) / steps, t = static_cast<double>(k + 1) / steps;
    const bool before = volume(motion.x(s), motion.q(s)) >= 0;
    if (before == (volume(motion.x(t), motion.q(t)) >= 0)) continue;
    const Vec3 x = motion.x(0.5 * (s + t));
    const Mat3 q = motion.q(0.5 * (s + t));
    const Vec3 n = (q.col(1) - q.col(0)).cross(q.col(2) - q.col(0));
    bool inside = true;
    for (int i = 0; i < 3; ++i)
      inside = inside && (q.col((i + 1) % 3) - q.col(i)).cross(x - q.col(i)).dot(n) > 0;
    if (inside) found.push_back({0.5 * (s + t), before});
  }
  return found;
}

TEST(Passage, TimesAndDirectionsAreThoseOfManySmallSteps) {
  constexpr int kSteps = 2000;
  Random random(1);
  int inward = 0, outward = 0, several = 0;
  for (int k = 0; k < 2000; ++k) {
    const Motion motion = random_motion(random);
    const std::vector<Passage> expected = by_steps(motion, kSteps);
    const Passages found = motion.passages();
    ASSERT_EQ(found.count, std::ssize(expected)) << k;
    several += found.count > 1 ? 1 : 0;
    for (int i = 0; i < found.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_NEAR(found.of[at].when, expected[at].when, 1.0 / kSteps);
      EXPECT_EQ(found.of[at].inward, expected[at].inward);
      (found.of[at].inward ? inward : outward) += 1;
    }
  }
  EXPECT_GT(inward, 100);
  EXPECT_GT(outward, 100);
  EXPECT_GT(several, 5);
}

// However a motion is cut into two, each passage is in one of them.
TEST(Passage, HalvesOfAMotionHaveItsPassages) {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const Motion motion = random_motion(random);
    const int whole = motion.passages().count;
    for (const double cut : {0.5, motion.passages().of[0].when}) {
      if (cut == 0) continue;
      EXPECT_EQ(motion.between(0, cut).passages().count + motion.between(cut, 1).passages().count,
                whole)
          << k;
    }
  }
}

const Mat3 kUp = (Mat3() << 0, 1, 0, 0, 0, 1, 0, 0, 0).finished();  // seen from above

TEST(Passage, WhatLiesOnTheFaceIsInFrontOfIt) {
  const Vec3 on(0.2, 0.2, 0), above(0.2, 0.2, 1), below(0.2, 0.2, -1);
  EXPECT_EQ(passages(on, above, kUp, kUp).count, 0);
  EXPECT_EQ(passages(above, on, kUp, kUp).count, 0);
  const Passages in = passages(on, below, kUp, kUp), out = passages(below, on, kUp, kUp);
  ASSERT_EQ(in.count, 1);
  EXPECT_TRUE(in.of[0].inward);
  EXPECT_EQ(in.of[0].when, 0);
  ASSERT_EQ(out.count, 1);
  EXPECT_FALSE(out.of[0].inward);
}

TEST(Passage, WhatGoesThroughACommonEdgeOrCornerIsSeenByAllAroundIt) {
  const Mat3 other = (Mat3() << 1, 1, 0, 0, 1, 1, 0, 0, 0).finished();
  for (const Vec3& at : {Vec3(0.5, 0.5, 0), Vec3(1.0 / 3, 2.0 / 3, 0), Vec3(1, 0, 0)})
    for (const Mat3& face : {kUp, other}) {
      const Vec3 way(0.1, -0.2, 1);
      EXPECT_EQ(passages(at + way, at - way, face, face).count, 1) << at.transpose();
    }
}

TEST(Passage, ATriangleWithoutAnAreaLetsEverythingBy) {
  Mat3 needle = kUp;
  needle.col(2) = needle.col(1);
  EXPECT_EQ(passages({0.5, 0, 1}, {0.5, 0, -1}, needle, needle).count, 0);
  EXPECT_EQ(passages({0.2, 0.2, 1}, {0.2, 0.2, 1}, kUp, kUp).count, 0);  // nothing moves
}

}  // namespace articular::sim::passage_test
