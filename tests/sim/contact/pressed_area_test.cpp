// The area above a pressure: on fields that are given, beside closed forms and brute force, and in
// a scene.
#include "sim/contact/pressed_area.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/sim/support/pressed_block.hpp"
#include "tests/sim/support/pressed_sheet.hpp"
#include "tests/sim/support/probes.hpp"

namespace articular::sim::pressed_area_test {

using std::numbers::pi;

/// By the middles of small cells.
double sampled_area(const PressedTriangle& triangle, double threshold) {
  constexpr int kCells = 500;
  const Vec3 a = triangle.x.col(1) - triangle.x.col(0), b = triangle.x.col(2) - triangle.x.col(0);
  int above = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells - i; ++j)
      for (const double part : {1.0 / 3, 2.0 / 3}) {
        const double s = (i + part) / kCells, t = (j + part) / kCells;
        if (s + t < 1 && triangle.p.dot(Vec3(1 - s - t, s, t)) >= threshold) ++above;
      }
  return above * a.cross(b).norm() / (2 * kCells * kCells);
}

// In space; one, two and three corners above, in any order.
TEST(PressedArea, OfATriangleIsThatOfBruteForce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 20; ++round) {
    PressedTriangle triangle;
    for (double& x : triangle.x.reshaped()) x = number(random);
    for (double& p : triangle.p) p = 1 + number(random);
    const double whole = area_above({triangle}, 1e-9);
    EXPECT_NEAR(area_above({triangle}, 1), sampled_area(triangle, 1), 5e-3 * whole) << round;
  }
}

TEST(PressedArea, AtACornersPressureHasNoStep) {
  PressedTriangle triangle;
  triangle.x << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  triangle.p = {1, 2, 4};
  for (const auto& [pressure, part] : {std::pair(1.0, 1.0), std::pair(2.0, 2.0 / 3)})
    for (const double aside : {-1e-9, 0.0, 1e-9})
      EXPECT_NEAR(area_above({triangle}, pressure + aside), 0.5 * part, 1e-8);
  EXPECT_NEAR(area_above({triangle}, 4), 0, 1e-12);
  EXPECT_EQ(area_above({triangle}, 4 + 1e-9), 0);
  triangle.p = {3, 3, 3};
  EXPECT_EQ(area_above({triangle}, 3), 0.5);
  EXPECT_EQ(area_above({}, 3), 0);
}

// Affine pressure over the square: cells and turns of them do not matter.
TEST(PressedArea, DoesNotDependOnHowTheSurfaceIsCut) {
  const PressureField p = [](double x, double y) { return 3 + x - 0.5 * y; };
  const double whole = area_above(pressed_sheet(1, 0, p), 3.2);
  EXPECT_NEAR(whole, 4 * 0.4, 1e-12);  // x > 0.2 + y/2
  for (const int cells : {2, 5, 16})
    EXPECT_NEAR(area_above(pressed_sheet(cells, 0, p), 3.2), whole, 1e-12);
}

// [Hertz 1882] p = p₀ √(1 − s²/a²) is above t within s² = a² (1 − t²/p₀²). The less t is, the
// more of an error the rim has, where the slope of p has no bound.
TEST(PressedArea, OfHertzIsTheClosedForm) {
  constexpr double kContact = 0.8, kPeak = 5;
  const auto field = pressed_sheet(80, 0.1, [&](double x, double y) {
    const double s = (x * x + y * y) / (kContact * kContact);
    return s < 1 ? kPeak * std::sqrt(1 - s) : 0;
  });
  for (const double threshold : {2.0, 3.0, 4.0}) {
    const double exact = pi * kContact * kContact * (1 - std::pow(threshold / kPeak, 2));
    EXPECT_NEAR(area_above(field, threshold), exact, 5e-3 * exact) << threshold;
  }
}

// Even pressure between a block and a plate: all of the block, or nothing of it. Both halves
// together are the whole.
TEST(PressedArea, OfAProbeIsThatOfAPressedBlock) {
  Scenario s = pressed_block(1, shift("plate", 1, {0, 0, -2e-4}));
  s.analysis = Scenario::Analysis::Static;
  const double p = 2e-4 / (kSide / 20e3 + 1 / kStiffness);
  ContactProbe below{"block", "plate"}, above = below, low = half("block", "plate", -1);
  below.sensor.threshold = low.sensor.threshold = 0.99 * p;
  above.sensor.threshold = 1.01 * p;
  ContactsProbe both{{"low", "high"}};
  both.sensor.threshold = 0.99 * p;
  s.probes = {{"below", below},
              {"above", above},
              {"low", low},
              {"high", half("block", "plate", 1)},
              {"both", both}};
  Simulation run(s, contact_stiffness_of(kStiffness));
  EXPECT_EQ(Probes(run)("below.area_above_threshold [mm^2]"), 0);
  run.advance(1);
  const Probes probes(run);
  const double all = 1e6 * kSide * kSide;
  EXPECT_NEAR(probes("below.area_above_threshold [mm^2]"), all, 1e-5 * all);
  EXPECT_LT(probes("above.area_above_threshold [mm^2]"), 1e-9 * all);
  EXPECT_NEAR(probes("low.area_above_threshold [mm^2]"), all / 2, 1e-5 * all);
  EXPECT_NEAR(probes("both.area_above_threshold [mm^2]"), all, 1e-5 * all);
}

}  // namespace articular::sim::pressed_area_test
