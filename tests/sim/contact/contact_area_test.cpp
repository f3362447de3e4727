// How much of a surface carries where depths are averaged, on configurations that are given: bodies
// lie in each other, and nothing is solved.
#include "sim/contact/contact_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/probes.hpp"

namespace articular::sim::contact_area_test {

using std::numbers::pi;

constexpr double kStiffness = 1e9;  // k [Pa/m]
constexpr double kSide = 0.6;       // of the block's top [m]

/// A block of cells of the size h, its top at 0, under a rigid surface z(x, y). It is so hard, but
/// for a layer of the stiffness k, that what presses on this bed and what pulls have one line.
constexpr double kHard = 1e20;  // [Pa]
struct Bed {
  Bed(int cells, const std::function<double(double x, double y)>& surface, double E = kHard)
      : model(made(cells, surface, E)), search(model, {}), response(model) {
    read_state(model, initial_state(model).data(), 0, now);
    search.find(now, 0.02);
    response.evaluate(now, search.candidates(), {});
  }
  Model made(int cells, const std::function<double(double, double)>& surface, double E) const {
    const double h = kSide / cells;
    Scenario s = contact_scene(1e-3);
    s.contact_response = Scenario::Response::Averaged;
    Body block = box_body("block", Body::Kind::Tissue, {kSide, kSide, h}, {0, 0, -0.5 * h},
                          {cells, cells, 1});
    block.material = neo_hookean(E, 0);
    block.material->element = TissueMaterial::Element::Plain;
    const MeshData above = bent(
        {{1.1 * kSide, 1.1 * kSide, 0.1}, {cells + 2, cells + 2, 1}, {0, 0, 0.05}}, [&](Vec3 X) {
          X.z() += surface(X.x(), X.y());
          return X;
        });
    s.bodies = {block, mesh_body("above", Body::Kind::Fixed, above, folder)};
    ContactPair pair;
    pair.a = "block";
    pair.b = "above";
    s.contacts = {pair};
    Model model = build_model(s);
    contact_stiffness_of(kStiffness)(model);
    return model;
  }
  /// Of the faces that have all corners within this of the middle [m].
  double area(double within) const {
    const Collider& block = *model.bodies[0].collider;
    std::vector<char> selected;
    for (const auto& face : block.surface.faces.colwise())
      selected.push_back(block.X(Eigen::seq(0, 1), face).cwiseAbs().maxCoeff() < within + 1e-9 ? 1
                                                                                               : 0);
    return summary_through(model, response, now, 0, 0, selected).area;
  }
  double area() const { return contact_summaries(model, response, now).at(0).area; }

  const TemporaryFolder folder;
  const Model model;
  ContactSearch search;
  ContactResponse response;
  Configuration now;
};

// A plate that is tilted by so little that depths count on all of both rows beside the edge. Means
// around nodes inside are then the depths there, and the field is the plane: any edge is found to
// round-off. Means at the block's rim are not, and faces there are left out.
TEST(ContactArea, EndsWhereATiltedPlateLeavesTheBlock) {
  constexpr double kTilt = 0.01, kWithin = 0.2;
  for (const double turn : {0.0, 0.3, pi / 4})
    for (const double edge : {-0.031, 0.0, 0.012, 0.05}) {
      const Vec3 along(std::cos(turn), std::sin(turn), 0);
      const Bed bed(12,
                    [&](double x, double y) { return kTilt * (Vec3(x, y, 0).dot(along) - edge); });
      // The half plane x·along < edge of a square.
      const int kSamples = 4000;
      double expected = 0;
      for (int i = 0; i < kSamples; ++i) {
        const double y = kWithin * ((2 * i + 1.0) / kSamples - 1);
        const double x = (edge - y * along.y()) / along.x();
        expected += 2 * kWithin / kSamples * (std::clamp(x, -kWithin, kWithin) + kWithin);
      }
      EXPECT_NEAR(bed.area(kWithin), expected, 1e-6) << turn << ' ' << edge;
    }
}

// On such a bed a paraboloid z = r²/2R − δ touches up to r² = 2Rδ. Where it touches is not at
// nodes, so the error may go to and fro: it is below a bound of second order, at all sizes and
// places.
TEST(ContactArea, UnderABallConvergesWithTheSquareOfTheElements) {
  constexpr double kRadius = 10, kDepth = 1e-3;  // [m]
  const double exact = 2 * pi * kRadius * kDepth, a = std::sqrt(2 * kRadius * kDepth);
  for (const int cells : {12, 18, 24, 36})
    for (const double aside : {0.0, 0.37}) {
      const double h = kSide / cells;
      const Bed bed(cells, [&](double x, double y) {
        return (std::pow(x - aside * h, 2) + y * y) / (2 * kRadius) - kDepth;
      });
      EXPECT_NEAR(bed.area(), exact, (h / a) * (h / a) * exact) << cells << ' ' << aside;
    }
}

// On a plate apart, by 1 µm, of a block of finite modulus: 2E by the radius of the node's area, and
// the layer.
TEST(ContactArea, APullAsOnAPunchAndItsLayerClosesTheGap) {
  constexpr double kYoung = 1e7, kGap = 1e-6;
  const Bed bed(
      6, [](double, double) { return kGap; }, kYoung);
  const Eigen::VectorXd phi = signed_pressures(bed.model, *bed.response.pair_states()[0]);
  const Collider& block = *bed.model.bodies[0].collider;
  int num_there = 0;
  for (Eigen::Index a = 0; a < phi.size(); ++a) {
    if (!std::isfinite(phi[a])) continue;  // not on the top
    const double c = std::sqrt(pi * block.group_area[a]) / (2 * kYoung) + 1 / kStiffness;
    EXPECT_NEAR(phi[a], -kGap / c, 1e-9 * kGap / c);
    ++num_there;
  }
  EXPECT_EQ(num_there, 7 * 7);
  EXPECT_EQ(bed.area(), 0);
}

// A rigid paraboloid on a block of tissue, in equilibrium [Hertz 1882]: a² = Rδ, and 2 % more of a
// by the block's depth of 12 a. Cells are 0.2 a in the middle and 0.5 a where contact ends.
TEST(ContactArea, OfATissueUnderABallIsThatOfHertz) {
  constexpr double kRadius = 2, kContact = 0.1, kYoung = 1e6, kPoisson = 0.3;  // R, a [m]
  constexpr double kHalf = 12 * kContact, kStretch = 4;
  const auto graded = [](double part) {  // from the middle on, of ±1
    return kHalf * std::sinh(kStretch * part) / std::sinh(kStretch);
  };
  const MeshData block = bent({{2, 2, 1}, {16, 16, 10}, {0, 0, -0.5}}, [&](const Vec3& X) {
    return Vec3(graded(X.x()), graded(X.y()), graded(X.z()));
  });
  const MeshData ball = bent({{1, 1, 0.1}, {48, 48, 1}, {0, 0, 0.05}}, [&](Vec3 X) {
    X.z() += X.head<2>().squaredNorm() / (2 * kRadius);
    return X;
  });
  const TemporaryFolder folder;
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.contact = true;
  s.integrator.position_tolerance.reset();
  s.duration = 1;
  s.bodies = {mesh_body("block", Body::Kind::Tissue, block, folder),
              mesh_body("ball", Body::Kind::Fixed, ball, folder), stand("floor")};
  s.bodies[0].material = neo_hookean(kYoung, kPoisson);
  s.attachments = {attach("block", "floor", {-9, -9, -1.01 * kHalf}, {9, 9, -0.99 * kHalf})};
  s.loads = {shift("ball", 1, {0, 0, -kContact * kContact / kRadius})};
  s.probes = {{"hertz", ContactProbe{"ball", "block"}}};
  Simulation run(s);
  run.advance(1);
  const Probes probes(run);
  const double a = std::sqrt(1e-6 * probes("hertz.area [mm^2]") / pi);
  EXPECT_NEAR(a, 1.02 * kContact, 0.05 * kContact);
}

TEST(ContactArea, OfAMirrorImageIsTheSame) {
  const auto ball = [](double x, double y) { return (x * x + 2 * y * y) / 20 - 1e-3; };
  const Bed one(14, [&](double x, double y) { return ball(x - 0.017, y - 0.02); }),
      other(14, [&](double x, double y) { return ball(x + 0.017, y - 0.02); });
  EXPECT_NEAR(one.area(), other.area(), 1e-9 * one.area());
}

TEST(ContactArea, IsAllThatIsCoveredUnderAPlateThatPressesEverywhere) {
  const Bed bed(6, [](double, double) { return -1e-3; });
  EXPECT_NEAR(bed.area(), kSide * kSide, 1e-12);
}

}  // namespace articular::sim::contact_area_test
