#include "sim/build/build_model.hpp"
#include "sim/model/model.hpp"
#include "sim/scenario/curve.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::build_model_test {

constexpr double kSide = 0.02;  // of the blocks [m]

Body block() {
  return box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, Vec3::Zero(), {2, 2, 2});
}

std::ptrdiff_t num_attached(const Model& model) {
  const auto& nodes = model.tissues[0].nodes;
  return std::count_if(nodes.begin(), nodes.end(), [](const NodeRef& n) { return n.rigid >= 0; });
}

/// The block's nodes within 0.1 mm of a body.
Model near(const Body& other, Body::Kind rigid) {
  Scenario s = scene(1e-3);
  Body holder = box_body("holder", rigid, {1e-3, 1e-3, 1e-3}, {0, 0, 0.5});
  s.bodies = {block(), other, holder};
  Attachment attachment;
  attachment.body = "block";
  attachment.to = "holder";
  attachment.region.near_body = {other.name, 1e-4};
  s.attachments = {attachment};
  return build_model(s);
}

// The plate's corners are 20 mm away from the block that lies under its middle.
TEST(Model, ARegionNearABodyIsMeasuredFromItsSurface) {
  const Vec3 above(0, 0, 0.55 * kSide + 5e-5);
  const Body plate =
      box_body("plate", Body::Kind::Fixed, {3 * kSide, 3 * kSide, 0.1 * kSide}, above);
  EXPECT_EQ(num_attached(near(plate, Body::Kind::Fixed)), 9);
  Body tissue = plate;
  tissue.kind = Body::Kind::Tissue;
  tissue.density = 1000;
  tissue.material = block().material;
  EXPECT_EQ(num_attached(near(tissue, Body::Kind::Fixed)), 9);
  EXPECT_THROW(near(box_body("plate", Body::Kind::Fixed, {3 * kSide, 3 * kSide, 0.1 * kSide},
                             above + Vec3(0, 0, 1e-4)),
                    Body::Kind::Fixed),
               InputError);
}

TEST(Model, ARigidBoneTakesOverTheMassAndInertiaOfAttachedTissue) {
  Scenario s = scene(1e-3);
  s.bodies = {block(), mass_body("bone", 0.05, {0, 0, 0.1}, {1e-5, 1e-5, 1e-5})};
  s.bodies[1].velocity = {1, 0, 0};
  s.bodies[1].angular_velocity = {0, 2, 0};
  s.attachments = {attach("block", "bone", {-1, -1, -1}, {1, 1, 1})};
  const Model model = build_model(s);
  const double tissue = 1000 * std::pow(kSide, 3);
  EXPECT_EQ(model.layout.num_free_nodes, 0);
  EXPECT_NEAR(model.rigid_bodies[0].mass.mass, 0.05 + tissue, 1e-15);
  const double z = 0.05 * 0.1 / (0.05 + tissue);
  EXPECT_NEAR((model.rigid_bodies[0].rest.p - Vec3(0, 0, z)).norm(), 0, 1e-15);
  // The new centre moves as a point of the turning bone: 1 + 2 (z − 0.1).
  EXPECT_NEAR((model.rigid_bodies[0].start.linear - Vec3(1 + 2 * (z - 0.1), 0, 0)).norm(), 0,
              1e-15);
  for (std::size_t i = 0; i < model.tissues[0].nodes.size(); ++i)
    EXPECT_NEAR((model.tissues[0].nodes[i].local + model.rigid_bodies[0].rest.p -
                 model.tissues[0].X.col(static_cast<Eigen::Index>(i)))
                    .norm(),
                0, 1e-15);
}

TEST(Model, ANodeAttachedToTwoBodiesIsRefusedWithBothEntries) {
  Scenario s = scene(1e-3);
  s.bodies = {block(), stand("wall"), stand("hand")};
  s.attachments = {attach("block", "wall", {-1, -1, -1}, {1, 1, 0}),
                   attach("block", "hand", {-1, -1, 0.001}, {1, 1, 1})};
  EXPECT_EQ(num_attached(build_model(s)), 27);
  s.attachments[1].region.box->first.z() = 0;  // the nodes in the middle, too
  s.attachments[0].where = {"scene.toml", 12, 1};
  s.attachments[1].where = {"scene.toml", 16, 1};
  try {
    build_model(s);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "scene.toml:16:1: the node of `block` at (-10.000 -10.000 0.000) mm is attached to "
        "`hand` and, by the [[attach]] at scene.toml:12, to `wall`: expected regions "
        "without common nodes");
  }
  s.attachments[1].to = "wall";  // twice the same says nothing new
  EXPECT_EQ(num_attached(build_model(s)), 27);
}

TEST(Model, PlainElementsThatLockGiveAWarningAndOthersNone) {
  using Element = TissueMaterial::Element;
  for (const auto& [element, nu, warnings] :
       {std::tuple(Element::Plain, 0.45, 0U), std::tuple(Element::Plain, 0.451, 1U),
        std::tuple(Element::Plain, 0.499, 1U), std::tuple(Element::Smoothed, 0.499, 0U)}) {
    Scenario s = scene(1e-3);
    s.bodies = {block()};
    s.bodies[0].material = neo_hookean(1e5, nu);
    s.bodies[0].material->element = element;
    const Model model = build_model(s);
    EXPECT_EQ(model.warnings.size(), warnings) << nu;
    const std::string ratio = fmt::format("ratio {}:", nu);
    EXPECT_EQ(warnings == 1 && model.warnings[0].find(ratio) != std::string::npos, warnings == 1);
  }
}

TEST(Model, AForceOnARegionIsSharedEquallyByItsNodes) {
  Scenario s = scene(1e-3);
  s.bodies = {block()};
  ForceLoad load;
  Region top;
  top.box = {Vec3(-1, -1, 0.49 * kSide), Vec3(1, 1, 1)};
  load.at = TissueRegion{"block", top};
  load.force = {0, 0, 9};
  load.profile = {{0, 1}, {0.5, 1}};
  s.loads = {load};
  Simulation run(s);
  const Eigen::VectorXd& f = run.stepper.now().forces;
  int loaded = 0;
  for (Eigen::Index i = 0; i < f.size() / 3; ++i) {
    if (f.segment<3>(3 * i).norm() < 1e-9) continue;  // round-off of the undeformed tissue
    ++loaded;
    EXPECT_NEAR(f[3 * i + 2], 0.5, 1e-9);
  }
  EXPECT_EQ(loaded, 9);
}

TEST(Model, ACurveIsLinearBetweenItsTimesAndConstantOutside) {
  const Curve curve{{1, 2, 4}, {0, 10, 20}};
  EXPECT_EQ(value_at(curve, 0), 0);
  EXPECT_EQ(value_at(curve, 1.5), 5);
  EXPECT_EQ(value_at(curve, 3), 15);
  EXPECT_EQ(value_at(curve, 9), 20);
  EXPECT_EQ(value_at({}, 3), 1);
}

TEST(Model, ACurveRisesBetweenItsTimesAndNotOutside) {
  const Curve curve{{1, 2, 4}, {0, 10, 50}};
  EXPECT_EQ(slope_at(curve, 0.9), 0);
  EXPECT_EQ(slope_at(curve, 1), 10);
  EXPECT_EQ(slope_at(curve, 1.5), 10);
  EXPECT_EQ(slope_at(curve, 2), 20);
  EXPECT_EQ(slope_at(curve, 4), 0);
  EXPECT_EQ(slope_at({}, 3), 0);
}

// A slip of the pen: both ends on the femur.
TEST(BuildModel, ALineWithAllPointsOnOneBoneIsTold) {
  for (const std::string far : {"low", "high"}) {
    Scenario s = scene(1e-3);
    s.bodies = {box_body("low", Body::Kind::Rigid, {0.1, 0.1, 0.1}, Vec3::Zero()),
                box_body("high", Body::Kind::Rigid, {0.1, 0.1, 0.1}, {0, 0, 0.1})};
    s.contact = false;
    Ligament ligament;
    ligament.name = "band";
    ligament.path = {anchor("low", {0.05, 0, 0}), anchor(far, {0.05, 0, 0.05})};
    ligament.stiffness = 1;
    s.ligaments = {ligament};
    const Model model = build_model(s);
    const bool told =
        std::any_of(model.warnings.begin(), model.warnings.end(), [](const std::string& warning) {
          return warning.find("all points of `band` lie on `low`") != std::string::npos;
        });
    EXPECT_EQ(told, far == "low");
  }
}

ForceLoad pull(const Anchor& at) {
  ForceLoad load;
  load.at = at;
  load.force = {0, 0, 1};
  return load;
}

// Two points of a tissue are told once; a bone, a patch, and what is tied to bone are not.
TEST(BuildModel, AForceOnOnePointOfTissueIsTold) {
  const double top = 0.5 * kSide;
  const auto num_told = [&](const std::vector<Load>& loads) {
    Scenario s = scene(1e-3);
    s.contact = false;
    s.bodies = {block(), box_body("bone", Body::Kind::Rigid, Vec3::Constant(kSide), {0, 0, kSide})};
    s.attachments = {attach("block", "bone", Vec3::Constant(-1), {1, 1, -0.49 * kSide})};
    s.loads = loads;
    const Model model = build_model(s);
    return std::ranges::count_if(model.warnings, [](const std::string& warning) {
      return warning.find("one point of `block`") != std::string::npos;
    });
  };
  const ForceLoad on_node = pull(anchor("block", {0, 0, top})),
                  on_face = pull(anchor("block", {1e-3, 2e-3, top}));
  EXPECT_EQ(num_told({on_node}), 1);
  EXPECT_EQ(num_told({on_face, on_node}), 1);
  EXPECT_EQ(num_told({pull(anchor("block", {0, 0, top}, 0.6 * kSide))}), 0);
  EXPECT_EQ(num_told({pull(anchor("block", {0, 0, -top}))}), 0);
  EXPECT_EQ(num_told({pull(anchor("bone", {0, 0, kSide}))}), 0);
}

}  // namespace articular::sim::build_model_test
