// The largest mean pressure over a spot: on fields that are given, beside closed forms and brute
// force, and in scenes.
#include "sim/contact/pressure_spot.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/pressed_block.hpp"
#include "tests/sim/support/probes.hpp"

namespace articular::sim::pressure_spot_test {

using std::numbers::pi;
using Triangles = std::vector<PressedTriangle>;
using Field = std::function<double(double x, double y)>;

/// A square of the side 2 around the origin, in cells that are turned in its plane, where there is
/// pressure. @param at  where a point of the plane lies
Triangles sheet(
    int cells, double turn, const Field& p,
    const std::function<Vec3(double x, double y)>& at = [](double x, double y) {
      return Vec3(x, y, 0);
    }) {
  Triangles triangles;
  const auto add = [&](std::array<Eigen::Vector2d, 3> corners) {
    PressedTriangle triangle;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d q = Eigen::Rotation2Dd(turn) * corners[static_cast<std::size_t>(i)];
      triangle.x.col(i) = at(q.x(), q.y());
      triangle.p[i] = p(q.x(), q.y());
    }
    triangles.push_back(triangle);
  };
  const auto node = [&](int i, int j) {
    return Eigen::Vector2d(2.0 * i / cells - 1, 2.0 * j / cells - 1);
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      add({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      add({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return triangles;
}

/// ∫ p dA within r of c, by the middles of small cells of a triangle.
double sampled_force(const PressedTriangle& triangle, const Vec3& c, double r) {
  constexpr int kCells = 700;
  const Vec3 a = triangle.x.col(1) - triangle.x.col(0), b = triangle.x.col(2) - triangle.x.col(0);
  const double cell = a.cross(b).norm() / (2 * kCells * kCells);
  double sum = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells - i; ++j)
      for (const double part : {1.0 / 3, 2.0 / 3}) {
        const double s = (i + part) / kCells, t = (j + part) / kCells;
        if (s + t > 1) continue;
        if ((triangle.x.col(0) + s * a + t * b - c).norm() < r)
          sum += cell * triangle.p.dot(Vec3(1 - s - t, s, t));
      }
  return sum;
}

// Spheres around, inside, across a corner, across an edge, off the plane, and beside.
TEST(PressureSpot, ForceWithinASphereIsThatOfBruteForce) {
  PressedTriangle triangle;
  triangle.x << 0.1, 1.2, 0.3, -0.2, 0.1, 0.9, 0.4, 0.2, -0.3;
  triangle.p = {1, 3, 0.5};
  const Vec3 middle = triangle.x.rowwise().mean();
  const Vec3 normal = (triangle.x.col(1) - triangle.x.col(0))
                          .cross(triangle.x.col(2) - triangle.x.col(0))
                          .normalized();
  const Vec3 side = 0.5 * (triangle.x.col(0) + triangle.x.col(2));
  const Vec3 centers[] = {middle,
                          middle + 0.2 * normal,
                          triangle.x.col(1),
                          side,
                          side + 0.3 * (side - middle) - 0.1 * normal,
                          middle + 0.6 * normal};
  for (const Vec3& c : centers)
    for (const double r : {0.1, 0.25, 0.5, 2.0}) {
      const double expected = sampled_force(triangle, c, r);
      EXPECT_NEAR(force_within({triangle}, c, r), expected, 2e-3 * expected) << c.transpose() << r;
    }
}

// As wide as round-off, and not wide at all: clipped polygons leave such.
TEST(PressureSpot, OfASliverIsAtMostItsPressureByItsArea) {
  for (const double width : {1e-12, 1e-17, 1e-25, 0.0}) {
    PressedTriangle sliver;
    sliver.x << 0.1, 0.3, 0.2, 0, 0, width, 0, 0, 0;
    sliver.p = {1, 2, 5};
    for (const Vec3& c : {Vec3(0.2, 0, 0), Vec3(0.2, 0.01, 0), Vec3(0, 0, 0)}) {
      const double force = force_within({sliver}, c, 0.15);
      EXPECT_GE(force, 0);
      EXPECT_LE(force, 5 * 0.5 * 0.2 * width + 1e-15) << width;
    }
  }
}

// Affine pressure: cells do not matter.
TEST(PressureSpot, DoesNotDependOnHowTheSurfaceIsCut) {
  const Field p = [](double x, double y) { return 3 + x - 0.5 * y; };
  const auto whole = sheet(1, 0, p);
  for (const int cells : {2, 5, 16})
    for (const Vec3& c : {Vec3(0.1, 0.2, 0), Vec3(0.95, 0.3, 0.05), Vec3(-1, -1, 0)})
      EXPECT_NEAR(force_within(sheet(cells, 0, p), c, 0.3), force_within(whole, c, 0.3), 1e-12);
}

TEST(PressureSpot, OfAnEvenPressureIsThatPressureWhereTheSpotFits) {
  for (const int cells : {1, 3, 10})
    for (const double turn : {0.0, 0.4}) {
      const Triangles even = sheet(cells, turn, [](double, double) { return 7.0; });
      EXPECT_NEAR(largest_spot_pressure(even, 0.2), 7, 1e-9);
      EXPECT_NEAR(largest_spot_pressure(even, 5), 7 * 4 / (pi * 25), 1e-9);
    }
  EXPECT_EQ(largest_spot_pressure({}, 0.2), 0);
}

TEST(PressureSpot, AtAnEdgeIsHalfAndAtACornerAQuarter) {
  const Triangles even = sheet(4, 0, [](double, double) { return 7.0; });
  const double whole = pi * 0.3 * 0.3 * 7;
  EXPECT_NEAR(force_within(even, {1, 0.1, 0}, 0.3), whole / 2, 1e-9);
  EXPECT_NEAR(force_within(even, {1, 1, 0}, 0.3), whole / 4, 1e-9);
}

// A row of pressure along an edge, narrower than the spot: the disc's strip of the width b at its
// middle, 2 ∫ √(r² − x²) dx. A single face would tell the whole pressure.
TEST(PressureSpot, OfARowAlongAnEdgeIsWhatOfTheSpotItCovers) {
  constexpr double kWidth = 0.1, kRadius = 0.25;
  const int cells = static_cast<int>(2 / kWidth);
  Triangles row = sheet(cells, 0, [](double, double) { return 1.0; });
  std::erase_if(row, [&](const PressedTriangle& t) { return t.x.row(0).mean() < 1 - kWidth; });
  const double half = kWidth / 2;
  const double strip = 2 * (half * std::sqrt(kRadius * kRadius - half * half) +
                            kRadius * kRadius * std::asin(half / kRadius));
  EXPECT_NEAR(largest_spot_pressure(row, kRadius), strip / (pi * kRadius * kRadius), 1e-3);
}

// On a sphere just π r² lie within r of a point.
TEST(PressureSpot, OnASphereIsTheEvenPressureToo) {
  constexpr double kRadius = 3;
  const auto bowl = [&](double x, double y) {
    return Vec3(x, y, kRadius - std::sqrt(kRadius * kRadius - x * x - y * y));
  };
  const Triangles even = sheet(
      60, 0.2, [](double, double) { return 7.0; }, bowl);
  EXPECT_NEAR(largest_spot_pressure(even, 0.5), 7, 7 * 2e-3);
}

// [Hertz 1882] p = p₀ √(1 − s²/a²): over a spot of the radius r in the middle the mean is
// 2/3 p₀ (a²/r²) (1 − (1 − r²/a²)^(3/2)), wherever nodes are.
TEST(PressureSpot, OfHertzIsTheClosedForm) {
  constexpr double kContact = 0.8, kPeak = 5;
  for (const double r : {0.2, 0.4})
    for (const double aside : {0.0, 0.021}) {
      const double part = r * r / (kContact * kContact);
      const double exact = 2.0 / 3 * kPeak / part * (1 - std::pow(1 - part, 1.5));
      const Triangles field = sheet(40, 0.1, [&](double x, double y) {
        const double s = ((x - aside) * (x - aside) + y * y) / (kContact * kContact);
        return s < 1 ? kPeak * std::sqrt(1 - s) : 0;
      });
      EXPECT_NEAR(largest_spot_pressure(field, r), exact, 3e-3 * exact);
    }
}

// Hills of a random field, by all points of a fine grid.
TEST(PressureSpot, IsTheLargestThatBruteForceFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.8, 0.8), height(1, 2);
  for (int round = 0; round < 5; ++round) {
    std::array<Vec3, 5> hills;
    for (Vec3& hill : hills) hill = {place(random), place(random), height(random)};
    const Triangles field = sheet(12, 0, [&](double x, double y) {
      double sum = 0;
      for (const Vec3& hill : hills)
        sum += hill.z() * std::exp(-((Vec3(x, y, 0) - hill).head<2>().squaredNorm()) / 0.05);
      return sum;
    });
    constexpr double kRadius = 0.22;
    constexpr int kPoints = 60;
    double expected = 0;
    for (int i = 0; i <= kPoints; ++i)
      for (int j = 0; j <= kPoints; ++j)
        expected = std::max(
            expected,
            force_within(field, {2.0 * i / kPoints - 1, 2.0 * j / kPoints - 1, 0}, kRadius));
    expected /= pi * kRadius * kRadius;
    const double found = largest_spot_pressure(field, kRadius);
    EXPECT_GT(found, (1 - 1e-4) * expected) << round;
    EXPECT_LT(found, (1 + 5e-3) * expected) << round;  // between the points of the grid
  }
}

/// Of one contact, in a scene where bodies lie in each other and nothing is solved.
struct Overlap {
  explicit Overlap(const Scenario& s) : model(build_model(s)), search(model, {}), response(model) {
    read_state(model, initial_state(model).data(), 0, now);
    search.find(now, 0.02);
    response.evaluate(now, search.candidates(), {});
  }
  double force(int body, const std::vector<char>& selected = {}) const {
    Triangles triangles;
    add_pressed_triangles(model, response, now, 0, body, selected, triangles);
    return force_within(triangles, Vec3::Zero(), 10);
  }
  double summary_force(int body, const std::vector<char>& selected = {}) const {
    return summary_through(model, response, now, 0, body, selected).normal_force;
  }

  const Model model;
  ContactSearch search;
  ContactResponse response;
  Configuration now;
};

// A ball in a block, so that some patches fade, end at faces' edges and lie on both sides.
TEST(PressureSpot, TrianglesHaveTheForceOfTheContact) {
  for (const auto how : {Scenario::Response::Averaged, Scenario::Response::Pointwise}) {
    Scenario s = contact_scene(1e-3);
    s.contact_response = how;
    s.bodies = {box_body("block", Body::Kind::Tissue, {0.1, 0.1, 0.05}, Vec3::Zero(), {8, 8, 4}),
                ball_body(1000, {.radius = 0.06,
                                 .element_size = 0.012,
                                 .center = Vec3(0.003, 0.001, 0.025 + 0.06 - 0.003)})};
    s.bodies[0].material = neo_hookean(1e5, 0.3);
    ContactPair pair;
    pair.a = "block";
    pair.b = "ball";
    s.contacts = {pair};
    const Overlap overlap(s);
    const Collider& block = *overlap.model.bodies[0].collider;
    std::vector<char> half;
    for (const auto& face : block.surface.faces.colwise())
      half.push_back(block.X(0, face).mean() > 0 ? 1 : 0);
    const double force = overlap.summary_force(0);
    EXPECT_GT(force, 0);
    for (const int body : {0, 1}) EXPECT_NEAR(overlap.force(body), force, 1e-12 * force);
    EXPECT_NEAR(overlap.force(0, half), overlap.summary_force(0, half), 1e-12 * force);
    EXPECT_GT(overlap.force(0, half), 0.3 * force);
    EXPECT_LT(overlap.force(0, half), 0.8 * force);
  }
}

// Even pressure between a block and a plate. Over a spot that is larger than the block it is the
// force by the spot's area. Both halves together have what neither has alone: a spot across.
TEST(PressureSpot, OfAProbeIsThatOfAPressedBlock) {
  Scenario s = pressed_block(1, shift("plate", 1, {0, 0, -2e-4}));
  s.analysis = Scenario::Analysis::Static;
  ContactProbe whole{"block", "plate"}, low = half("block", "plate", -1);
  whole.sensor.spot = 0.4 * kSide;
  ContactProbe large = whole;
  large.sensor.spot = 1.9 * kSide;
  low.sensor.spot = 0.8 * kSide;
  ContactsProbe both{{"low", "high"}};
  both.sensor.spot = 0.8 * kSide;
  s.probes = {{"whole", whole},
              {"large", large},
              {"low", low},
              {"high", half("block", "plate", 1)},
              {"both", both}};
  Simulation run(s, contact_stiffness_of(kStiffness));
  EXPECT_EQ(Probes(run)("whole.max_spot_pressure [Pa]"), 0);
  run.advance(1);
  const Probes probes(run);
  const double p = 2e-4 / (kSide / 20e3 + 1 / kStiffness);
  EXPECT_NEAR(probes("whole.max_spot_pressure [Pa]"), p, 1e-5 * p);
  EXPECT_NEAR(probes("large.max_spot_pressure [Pa]"), p * 4 / (1.9 * 1.9 * pi), 1e-5 * p);
  EXPECT_NEAR(probes("both.max_spot_pressure [Pa]"), p, 1e-5 * p);
  EXPECT_LT(probes("low.max_spot_pressure [Pa]"), 0.85 * p);
  EXPECT_GT(probes("low.max_spot_pressure [Pa]"), 0.6 * p);
}

}  // namespace articular::sim::pressure_spot_test
