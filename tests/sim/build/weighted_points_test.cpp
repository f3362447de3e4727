// Points of bodies that muscles, loads and probes name.
#include "sim/build/weighted_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::weighted_points_test {

constexpr double kSide = 0.02;          // of the block, about the origin [m]
constexpr double kElement = kSide / 4;  // [m]

class AnchoredPoint : public ::testing::Test {
 protected:
  AnchoredPoint() {
    Scenario s = scene(1e-3);
    s.bodies = {
        box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3::Zero(), {4, 4, 4}),
        box_body("bone", Body::Kind::Fixed, Vec3::Constant(kSide), {0, 0, 0.1}),
        stand("somewhere")};
    model_ = build_model(s);
    const Tissue& tissue = model_.tissues[0];
    surfaces_ = {
        collision::build_surface(tissue.elements.tets(), static_cast<int>(tissue.X.cols()))};
  }
  WeightedPoint at(const Vec3& point, double radius = 0, int body = 0) {
    return anchored_point(anchor(model_.bodies[static_cast<std::size_t>(body)].name, point, radius),
                          body, model_, surfaces_, warnings_);
  }
  /// The place that its weights give.
  Vec3 place(const WeightedPoint& point) const {
    const Tissue& tissue = model_.tissues[0];
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < point.nodes.size(); ++k)
      for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
        if (tissue.nodes[i].block == point.nodes[k].block)
          x += point.weights[k] * tissue.X.col(static_cast<Eigen::Index>(i));
    return x;
  }
  std::string refusal(const Vec3& point, int body = 0) {
    try {
      at(point, 0, body);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  Model model_;
  std::vector<collision::Surface> surfaces_;
  std::vector<std::string> warnings_;
};

TEST_F(AnchoredPoint, InsideTissueIsThatPlaceAndNoNodeOfTheSurface) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = kSide * Vec3(part(random), part(random), part(random));
    const WeightedPoint point = at(x);
    EXPECT_LE(point.nodes.size(), 4U);
    EXPECT_LT((place(point) - x).norm(), 1e-9 * kSide);
    for (const double weight : point.weights) EXPECT_GT(weight, 0);
  }
}

TEST_F(AnchoredPoint, OnANodeIsThatNode) {
  const WeightedPoint corner = at(Vec3::Constant(kSide / 2)), middle = at(Vec3::Zero());
  ASSERT_EQ(corner.nodes.size(), 1U);
  EXPECT_EQ(corner.weights[0], 1);
  EXPECT_EQ(place(corner), Vec3(Vec3::Constant(kSide / 2)));
  ASSERT_EQ(middle.nodes.size(), 1U);
  EXPECT_EQ(place(middle), Vec3(Vec3::Zero()));
}

TEST_F(AnchoredPoint, BesideTissueIsTheNearestNodeOfItsSurface) {
  const WeightedPoint point = at({0.1 * kElement, 1.1 * kElement, kSide / 2 + 0.9 * kElement});
  ASSERT_EQ(point.nodes.size(), 1U);
  EXPECT_LT((place(point) - Vec3(0, kElement, kSide / 2)).norm(), 1e-15);
}

TEST_F(AnchoredPoint, FartherThanAnElementFromTissueIsRefusedWithItsDistance) {
  EXPECT_EQ(refusal({0, 0, kSide / 2 + 0.99 * kElement}), "");
  const std::string message = refusal({0, 0, 1.61});
  EXPECT_NE(message.find("(0.000 0.000 1610.000) mm lies 1.6e+03 mm from `block`"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("element (5 mm)"), std::string::npos) << message;
  EXPECT_NE(refusal({0, 0, kSide / 2 + 1.01 * kElement}), "");
}

TEST_F(AnchoredPoint, ARadiusTakesTheSurfaceNodesWithinAndWarnsOfOneOrNone) {
  const Vec3 top(0, 0, kSide / 2);
  const WeightedPoint patch = at(top, 1.01 * kElement);
  EXPECT_EQ(patch.nodes.size(), 5U);
  EXPECT_EQ(patch.weights, std::vector<double>(5, 0.2));
  EXPECT_TRUE(warnings_.empty());
  EXPECT_EQ(at(top, 0.5 * kElement).nodes.size(), 1U);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("one node of the surface of `block`"), std::string::npos);
  EXPECT_LT((place(at({kElement / 2, kElement / 3, kSide / 2}, 0.2 * kElement)) -
             Vec3(kElement / 2, kElement / 3, kSide / 2))
                .norm(),
            1e-9 * kSide);
  ASSERT_EQ(warnings_.size(), 2U);
  EXPECT_NE(warnings_[1].find("no node"), std::string::npos);
}

TEST_F(AnchoredPoint, ARadiusThatTakesInTheWholeSurfaceIsDoubted) {
  const Vec3 corner = Vec3::Constant(kSide / 2);
  const double diagonal = std::sqrt(3.0) * kSide;
  at(corner, 0.99 * diagonal);
  EXPECT_TRUE(warnings_.empty());
  at(corner, 1.01 * diagonal);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("the whole surface of `block`"), std::string::npos) << warnings_[0];
}

TEST_F(AnchoredPoint, OfARigidBodyIsWithinItOrNearItsSurface) {
  const Vec3 middle(0, 0, 0.1);
  for (const Vec3& x : {middle, Vec3(middle + Vec3(0, 0, 0.5 * kSide + 1e-3))}) {
    const WeightedPoint point = at(x, 0, 1);
    EXPECT_EQ(refusal(x, 1), "");
    EXPECT_LT((model_.rigid_bodies[0].rest.p + point.nodes[0].local - x).norm(), 1e-15);
  }
  const std::string message = refusal(middle + Vec3(0.5 * kSide + 0.09, 0, 0), 1);
  EXPECT_NE(message.find("lies 90 mm from `bone`"), std::string::npos) << message;
  EXPECT_EQ(refusal({5, 5, 5}, 2), "");  // a body without a mesh has points anywhere
}

TEST_F(AnchoredPoint, OfABoneThatGoesOnBeyondItsMeshIsAnywhere) {
  Anchor anchor;
  anchor.point = {0.3, -5, 2};
  anchor.beyond_mesh = true;
  const WeightedPoint point = anchored_point(anchor, 1, model_, surfaces_, warnings_);
  ASSERT_EQ(point.nodes.size(), 1U);
  EXPECT_LT((model_.rigid_bodies[0].rest.p + point.nodes[0].local - anchor.point).norm(), 1e-15);
}

}  // namespace articular::sim::weighted_points_test
