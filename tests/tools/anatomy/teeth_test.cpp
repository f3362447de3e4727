// Rows of teeth that guide: what they are like, and what a lower row that slides in them does.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

#include "tests/tools/anatomy/anatomy_checks.hpp"
#include "tools/anatomy/anatomy_bones.hpp"
#include "tools/anatomy/anatomy_solids.hpp"
#include "tools/anatomy/anatomy_teeth.hpp"

namespace articular::anatomy::teeth_test {

/// |x| of the arch at the length s along it, by bisection.
double place_on_arch(double s) {
  const auto length = [](double x) {
    double sum = 0;
    for (int i = 0; i < 2000; ++i)
      sum += (arch_point(x * (i + 1) / 2000) - arch_point(x * i / 2000)).norm();
    return sum;
  };
  double low = 0, high = 27;
  for (int i = 0; i < 40; ++i) (length((low + high) / 2) < s ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

/// Level and outwards, on the left side.
Vec3 outwards(double x) {
  const Vec3 along = arch_point(x + 1e-4) - arch_point(std::max(x - 1e-4, 0.0));
  return Vec3(along.x(), along.y(), 0).normalized().cross(Vec3::UnitZ());
}

/// Slope to the horizontal [degrees], by area, of the faces in the middle half of the height of the
/// guiding incline, within 0.8 mm of the length s along the left arch.
double guiding_slope(const Mesh& upper, double s, double overbite) {
  const double x = place_on_arch(s);
  const Vec3 middle = arch_point(x), out = outwards(x);
  const Vec3 along = out.cross(Vec3::UnitZ());
  double sum = 0, area = 0;
  for (const auto& t : upper.triangles.colwise()) {
    const Vec3 a = upper.X_mm.col(t[0]), b = upper.X_mm.col(t[1]), c = upper.X_mm.col(t[2]);
    const Vec3 twice = (b - a).cross(c - a), n = twice.normalized();
    const Vec3 p = (a + b + c) / 3 - middle;
    if (std::abs(p.dot(along)) > 0.8 || p.dot(out) < 1.8 || p.dot(out) > 8) continue;
    if (n.z() > -0.1 || n.dot(out) > -0.1) continue;  // looks down and inwards
    const double below = (kOcclusalGap - p.z()) / overbite;
    if (below < 0.25 || below > 0.75) continue;
    sum += twice.norm() * std::acos(-n.z()) / kDegree;
    area += twice.norm();
  }
  return sum / area;
}

/// A row moved by a way.
Mesh moved(Mesh mesh, const Vec3& way) {
  mesh.X_mm.colwise() += way;
  return mesh;
}

/// Least distance [mm] of nodes of either row from the other surface, < 0 where they overlap, of
/// those that `counts`.
template <class Counts>
double least_distance(const Mesh& lower, const Mesh& upper, const Counts& counts) {
  SurfaceDistance to_upper(upper.X_mm, upper.triangles), to_lower(lower.X_mm, lower.triangles);
  double least = 1e3;
  for (const auto& p : lower.X_mm.colwise())
    if (counts(p)) least = std::min(least, to_upper(p));
  for (const auto& p : upper.X_mm.colwise())
    if (counts(p)) least = std::min(least, to_lower(p));
  return least;
}

constexpr double kFirstPremolar = -34;  // y of its front, about
bool all(const Vec3&) { return true; }
bool front(const Vec3& p) { return p.y() < kFirstPremolar; }
bool molars(const Vec3& p) { return p.y() > -22; }

TEST(GuidingTeeth, RowsAreClosedAndLookOutwards) {
  for (const double guidance : {40.0, 57.0, 65.0})
    for (const Mesh& row : {lower_guiding_teeth(guidance), upper_guiding_teeth(guidance)}) {
      EXPECT_EQ(unmatched_edges(row.triangles), 0);
      // 108 mm long, 7 to 8 mm high, 3 to 9 mm deep.
      EXPECT_GT(volume_and_center(row).first, 3000);
      EXPECT_LT(volume_and_center(row).first, 8000);
      for (const auto& t : row.triangles.colwise())
        EXPECT_GT((row.X_mm.col(t[1]) - row.X_mm.col(t[0]))
                      .cross(row.X_mm.col(t[2]) - row.X_mm.col(t[0]))
                      .norm(),
                  1e-3);
    }
}

TEST(GuidingTeeth, RightIsTheMirrorImageOfLeft) {
  for (const Mesh& row : {lower_guiding_teeth(), upper_guiding_teeth()}) {
    const auto key = [](const Vec3& p) { return std::array<double, 3>{p.x(), p.y(), p.z()}; };
    std::set<std::array<double, 3>> nodes;
    std::set<std::array<double, 3>> middles;  // of faces, to round-off of their sums
    const auto middle = [&](const auto& t, double sign) {
      Vec3 sum = row.X_mm(Eigen::all, t).rowwise().sum();
      sum.x() *= sign;
      sum = (sum * 1e6).array().round();
      return key(sum + Vec3::Zero());
    };
    for (const auto& p : row.X_mm.colwise()) nodes.insert(key(p + Vec3::Zero()));
    for (const auto& t : row.triangles.colwise()) middles.insert(middle(t, 1));
    int left = 0;
    for (const auto& p : row.X_mm.colwise()) {
      if (p.x() > 0) ++left;
      EXPECT_TRUE(nodes.contains(key(Vec3(-p.x(), p.y(), p.z()) + Vec3::Zero())));
    }
    EXPECT_GT(left, row.X_mm.cols() / 3);
    for (const auto& t : row.triangles.colwise()) EXPECT_TRUE(middles.contains(middle(t, -1)));
  }
}

TEST(GuidingTeeth, InclinesHaveTheStatedSlopes) {
  for (const double guidance : {45.0, kGuidanceDeg, 62.0}) {
    const Mesh upper = upper_guiding_teeth(guidance);
    // Across a curved arch a face of straight edges is off by a few tenths of a degree.
    EXPECT_NEAR(guiding_slope(upper, 0, kOverbite), guidance, 0.5);
    EXPECT_NEAR(guiding_slope(upper, kCanineMiddle, kOverbite), guidance - kCanineLessDeg, 1);
    // A cusp of the first molar: 11 mm wide from 32.4 on, with two. It slopes along the arch too.
    EXPECT_NEAR(guiding_slope(upper, 35.15, kBackOverbite), kCuspDeg, 2);
  }
  EXPECT_THROW(lower_guiding_teeth(39), std::invalid_argument);
  EXPECT_THROW(upper_guiding_teeth(66), std::invalid_argument);
  EXPECT_THROW(upper_guiding_teeth(std::nan("")), std::invalid_argument);
}

TEST(GuidingTeeth, OverbiteAndOverjetAreThePublishedOnes) {
  const Mesh lower = lower_guiding_teeth(), upper = upper_guiding_teeth();
  double edge = 1e3, front_of_lower = 1e3;
  for (const auto& p : upper.X_mm.colwise())
    if (std::abs(p.x()) < 1e-9) edge = std::min(edge, p.z());
  double upper_edge = 1e3;
  for (const auto& p : upper.X_mm.colwise())
    if (std::abs(p.x()) < 1e-9 && p.z() < edge + 1e-9) upper_edge = std::min(upper_edge, p.y());
  for (const auto& p : lower.X_mm.colwise())
    if (std::abs(p.x()) < 1e-9 && p.z() > kIncisor.z() - 1e-9)
      front_of_lower = std::min(front_of_lower, p.y());
  // Closed by the gap the front teeth overlap as stated: 2.45 mm in the mean of 30 people.
  EXPECT_NEAR(kIncisor.z() + kOcclusalGap - edge, kOverbite, 1e-6);
  // 1.9 mm in these, and 2.7 mm in 54 others.
  EXPECT_GT(front_of_lower - upper_edge, 1.9);
  EXPECT_LT(front_of_lower - upper_edge, 2.7);
  EXPECT_NEAR(front_of_lower, kIncisor.y(), 0.01);  // where scenarios look for the incisors
}

// The rows share facets: upwards they are the gap apart, and on inclines the cosine of it.
TEST(GuidingTeeth, InOcclusionTheyAreEverywhereTheGapApart) {
  const Mesh lower = lower_guiding_teeth(), upper = upper_guiding_teeth();
  const double steepest = kOcclusalGap * std::cos(kGuidanceDeg * kDegree);
  EXPECT_NEAR(least_distance(lower, upper, front), steepest, 0.01);
  const double back = least_distance(lower, upper, molars);
  EXPECT_LT(back, kOcclusalGap);
  EXPECT_GT(back, kOcclusalGap * std::cos((kCuspDeg + 12) * kDegree));  // faces slope two ways
  // Raised by a little less than the gap nothing overlaps, and by more all groups do.
  const Mesh nearly = moved(lower, {0, 0, kOcclusalGap - 0.01}),
             beyond = moved(lower, {0, 0, kOcclusalGap + 0.02});
  EXPECT_GT(least_distance(nearly, upper, all), 0);
  EXPECT_LT(least_distance(beyond, upper, front), 0);
  EXPECT_LT(least_distance(beyond, upper, molars), 0);
}

/// How far a lower row that was moved has to go down until it touches no more [mm].
double drop(const Mesh& lower, const Mesh& upper, const Vec3& way) {
  double low = -0.5, high = 6;
  for (int i = 0; i < 16; ++i) {
    const double middle = (low + high) / 2;
    const bool free = least_distance(moved(lower, way - middle * Vec3::UnitZ()), upper, all) > 0;
    (free ? high : low) = middle;
  }
  return (low + high) / 2;
}

// What guidance is: the row that is pushed forward goes down by the slope of the incisors, and its
// back teeth part.
TEST(GuidingTeeth, ARowThatIsPushedForwardFollowsTheIncisorsAndItsBackTeethPart) {
  for (const double guidance : {48.0, kGuidanceDeg}) {
    const Mesh lower = lower_guiding_teeth(guidance), upper = upper_guiding_teeth(guidance);
    EXPECT_NEAR(drop(lower, upper, Vec3::Zero()), -kOcclusalGap, 1e-3);
    const double first = drop(lower, upper, {0, -0.4, 0}), then = drop(lower, upper, {0, -1.1, 0});
    EXPECT_NEAR(std::atan2(then - first, 0.7) / kDegree, guidance, 0.7);
    const Mesh slid = moved(lower, {0, -1.1, -then});
    EXPECT_LT(std::abs(least_distance(slid, upper, front)), 1e-3);
    EXPECT_GT(least_distance(slid, upper, molars), 0.7);
  }
}

// The same to one side, by the canine.
TEST(GuidingTeeth, ARowThatIsPushedAsideFollowsTheCanineAndItsBackTeethPart) {
  const Mesh lower = lower_guiding_teeth(), upper = upper_guiding_teeth();
  const Vec3 out = outwards(place_on_arch(kCanineMiddle));
  const double first = drop(lower, upper, 0.4 * out), then = drop(lower, upper, 1.0 * out);
  EXPECT_NEAR(std::atan2(then - first, 0.6) / kDegree, kGuidanceDeg - kCanineLessDeg, 4);
  const Mesh slid = moved(lower, 1.0 * out - then * Vec3::UnitZ());
  const auto canine = [&](const Vec3& p) {
    return p.x() > 5 && p.x() < 18 && p.y() < kFirstPremolar;
  };
  EXPECT_LT(least_distance(slid, upper, canine), 0.05);  // incisors of that side are as near
  EXPECT_GT(least_distance(slid, upper, molars), 0.3);
  // To the other side by the other canine, as far.
  EXPECT_NEAR(drop(lower, upper, out.cwiseProduct(Vec3(-1, 1, 1))), then, 1e-6);
}

}  // namespace articular::anatomy::teeth_test
