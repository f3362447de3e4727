// Thin tissue squeezed between bones.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_squeeze_test {

/// Height of a spherical dish of a radius above its lowest point [m].
double dish(double radius, double x, double y) {
  return radius - std::sqrt(radius * radius - x * x - y * y);
}

/// A fixed dish [m]: its upper side is part of a sphere, its lowest point the origin.
Body dish_body(const TemporaryFolder& folder, double radius, double width, int cells) {
  const double depth = width / 4;
  const BoxGeometry box{{width, width, depth}, {cells, cells, 2}, {0, 0, -depth / 2}};
  return mesh_body("dish", Body::Kind::Fixed,
                   bent(box,
                        [&](const Vec3& X) -> Vec3 {
                          const double up = dish(radius, X.x(), X.y());
                          return {X.x(), X.y(), X.z() + up * (1 + X.z() / depth)};
                        }),
                   folder);
}

/// A sheet of one thickness that lies in the dish.
Body sheet_body(const TemporaryFolder& folder, double radius, const Vec3& size,
                const Eigen::Vector3i& cells, const TissueMaterial& material) {
  const BoxGeometry box{size, cells, {0, 0, size.z() / 2}};
  Body sheet = mesh_body("sheet", Body::Kind::Tissue,
                         bent(box,
                              [&](const Vec3& X) -> Vec3 {
                                const double up = dish(radius, X.x(), X.y());
                                return {X.x(), X.y(), X.z() + up};
                              }),
                         folder);
  sheet.material = material;
  return sheet;
}

/// A fixed tray [m]: a floor at z = 0 with walls around a square.
Body tray_body(const TemporaryFolder& folder, double inner_width, double wall, double height) {
  const double width = inner_width + 2 * wall;
  const BoxGeometry box{{width, width, 2 * height}, {20, 20, 4}, Vec3::Zero()};
  const MeshData tray = carved(box, [&](const Vec3& c) {
    return c.z() < 0 || std::max(std::abs(c.x()), std::abs(c.y())) > inner_width / 2;
  });
  return mesh_body("tray", Body::Kind::Fixed, tray, folder);
}

constexpr double kSheet = 2e-3;  // [m] of the sheet in the tray

/// A ball presses the sheet to half its thickness within 0.1 s. Without friction nothing but the
/// walls of the tray keeps the sheet there.
Scenario squeezed(const TemporaryFolder& folder, int cells) {
  constexpr double kInner = 16e-3, kBall = 8e-3;  // [m]
  Scenario s = contact_scene(2e-3);
  const double width = kInner - 0.2e-3;
  s.bodies = {box_body("sheet", Body::Kind::Tissue, {width, width, kSheet}, {0, 0, kSheet / 2},
                       {cells, cells, 2}),
              tray_body(folder, kInner, kInner / 8, kSheet), Body{}};
  s.bodies[0].material = neo_hookean(1e6, 0.4);
  Body& ball = s.bodies[2];
  ball.name = "ball";
  ball.kind = Body::Kind::Fixed;
  ball.geometry = SphereGeometry{kBall, 1e-3, {0, 0, kBall + kSheet}};
  s.loads = {shift("ball", 0.1, {0, 0, -kSheet / 2})};
  return s;
}

// It goes to and fro over it besides.
TEST(Squeeze, TissueBetweenTwoBonesIsSqueezedToHalfItsThicknessAndDragged) {
  constexpr double kWay = 2e-3;  // [m]
  const TemporaryFolder folder;
  Scenario s = squeezed(folder, 8);
  Motion& motion = std::get<MotionLoad>(s.loads[0]).motion;
  motion.time = {0, 0.1, 0.15, 0.25, 0.3, 0.35};
  const Vec3 down(0, 0, -kSheet / 2), along(kWay, 0.3 * kWay, 0);
  motion.translation = {Vec3::Zero(), down, down + along, down - along, down, down};
  Simulation run(s);
  const auto on = [&](const char* rigid) { return run.force_on(bone_of(run, rigid)); };
  double least_ratio = 1, least_force = 1e9, most_unbalance = 0;
  run.advance(0.1);
  run.advance(0.35, [&] {
    least_ratio = std::min(least_ratio, least_volume_ratio(run));
    least_force = std::min(least_force, on("tray").norm());
    // The sheet weighs nothing beside them.
    most_unbalance = std::max(most_unbalance, (on("tray") + on("ball")).norm());
  });
  EXPECT_GT(least_ratio, 0);
  EXPECT_GT(least_force, 5);  // [N]: it was held all the way
  EXPECT_LT(most_unbalance, 0.01 * least_force);
  EXPECT_LT((on("tray") + on("ball")).norm(), 1e-3 * least_force);
}

// The sheet's edges lie on the floor and against the walls: with one average for both around a node
// steps became shorter and shorter, with 3000 iterations in place of 400.
TEST(Squeeze, DepthsMayBeAveraged) {
  const TemporaryFolder folder;
  Scenario s = squeezed(folder, 8);
  s.contact_response = Scenario::Response::Averaged;
  Simulation run(s);
  double least_ratio = 1;
  run.advance(0.1, [&] { least_ratio = std::min(least_ratio, least_volume_ratio(run)); });
  EXPECT_GT(least_ratio, 0);
  const Vec3 on_tray = run.force_on(bone_of(run, "tray")),
             on_ball = run.force_on(bone_of(run, "ball"));
  EXPECT_GT(on_ball.z(), 5);  // [N]
  EXPECT_LT((on_tray + on_ball).norm(), 0.01 * on_ball.z());
  EXPECT_LT(run.state.counts.newton_iterations, 800);
}

// A disc of 1 mm between condyle and fossa of a jaw, at a strong bite. Its edges, too, are pressed,
// in a gap that widens outwards: a frictionless one slips out at the least push, unless facets hold
// it, which pointwise depths feel.
TEST(Squeeze, ADiscBetweenCondyleAndFossaCarries500N) {
  constexpr double kThickness = 1e-3, kFossa = 12e-3, kCondyle = 10e-3, kForce = 500;
  const TemporaryFolder folder;
  Scenario s = contact_scene(1e-3);
  s.bodies = {
      sheet_body(folder, kFossa, {12e-3, 12e-3, kThickness}, {12, 12, 2}, neo_hookean(10e6, 0.4)),
      dish_body(folder, kFossa, 16e-3, 12), Body{}};
  Body& condyle = s.bodies[2];
  condyle.name = "condyle";
  condyle.kind = Body::Kind::Rigid;
  condyle.density = 1000;
  const Vec3 center(0, 0, kCondyle + kThickness);
  condyle.geometry = SphereGeometry{kCondyle, 1e-3, center};
  ForceLoad press;
  press.at = anchor("condyle", center);
  press.force = {0, 0, -kForce};
  press.profile = {{0, 0.05}, {0, 1}};
  s.loads = {press};
  s.contacts = {{"sheet", "dish", {}}, {"sheet", "condyle", {}}};
  for (const bool averaged : {false, true}) {
    s.contact_response = averaged ? Scenario::Response::Averaged : Scenario::Response::Pointwise;
    for (ContactPair& pair : s.contacts) pair.friction = averaged ? 0.02 : 0;
    Simulation run(s);
    double least_ratio = 1;
    run.advance(0.1, [&] { least_ratio = std::min(least_ratio, least_volume_ratio(run)); });
    EXPECT_GT(least_ratio, 0);
    const Vec3 on_fossa = run.force_on(bone_of(run, "dish"));
    EXPECT_LT((on_fossa + Vec3(0, 0, kForce)).norm(), 1e-3 * kForce);
    EXPECT_LT(run.force_on(bone_of(run, "condyle")).norm(), 1e-3 * kForce);
    EXPECT_LE(run.state.counts.rejected_newton, 10);
    // At rest: what still moves would take this long for a hundredth of an element. But friction
    // creeps.
    const double element = kThickness / 2;
    const double speed = run.now().v.colwise().norm().maxCoeff();
    EXPECT_LT(speed * 0.1, (averaged ? 0.05 : 0.01) * element);
  }
}

// One element through the thickness: all four nodes of every element lie on the surface. Without
// lateral contraction the stress is the same in all of them.
constexpr double kLayer = 1e-3, kPress = 2e-5, kYoung = 1e6;  // [m], [m], [Pa]

Body layer_body() {
  Body layer =
      box_body("layer", Body::Kind::Tissue, {8e-3, 8e-3, kLayer}, {0, 0, kLayer / 2}, {8, 8, 1});
  layer.material = linear(kYoung, 0);
  return layer;
}

Body plate_body(const std::string& name, double z) {
  return box_body(name, Body::Kind::Fixed, {12e-3, 12e-3, 4e-3}, {0, 0, z}, {5, 5, 2});
}

/// The pressure that the layer's elements have, each the same.
double uniform_pressure(const Simulation& run) {
  const Eigen::VectorXd pressure =
      -run.model.tissues[0].elements.cauchy_stress(nodes_of(run, 0), 0).row(2);
  EXPECT_LT(pressure.maxCoeff() - pressure.minCoeff(), 0.01 * pressure.mean());
  return pressure.mean();
}

struct PressedLayer : testing::Test {
  static Scenario tied() {
    Scenario s = contact_scene(2e-3);
    s.bodies = {layer_body(), plate_body("above", kLayer + 2e-3), stand("below")};
    s.attachments = {attach("layer", "below", {-1, -1, -1}, {1, 1, 1e-9})};
    s.loads = {shift("above", 0.02, {0, 0, -kPress})};
    return s;
  }
  static Scenario between_plates() {
    Scenario s = contact_scene(2e-3);
    s.bodies = {layer_body(), plate_body("above", kLayer + 2e-3), plate_body("below", -2e-3)};
    s.loads = {shift("above", 0.02, {0, 0, -kPress / 2}), shift("below", 0.02, {0, 0, kPress / 2})};
    return s;
  }
};

TEST_F(PressedLayer, HasTheSamePressureEverywhereWhichThePlatesFeel) {
  for (const Scenario& s : {tied(), between_plates()}) {
    Simulation run(s);
    run.advance(0.02);
    run.advance(0.2);
    const double force = uniform_pressure(run) * 64e-6;  // [N]
    for (const char* plate : {"above", "below"})
      EXPECT_NEAR(std::abs(run.force_on(bone_of(run, plate)).z()), force, 1e-3 * force);
  }
}

// In statics contact takes less than a thousandth of the way.
TEST_F(PressedLayer, HasThePressureOfItsStrainInStatics) {
  Scenario s = tied();
  s.analysis = Scenario::Analysis::Static;
  s.integrator.step = 0.02;
  Simulation run(s);
  run.advance(0.02);
  const double pressure = kYoung * kPress / kLayer;
  EXPECT_NEAR(uniform_pressure(run), pressure, 1.1e-3 * pressure);
}

}  // namespace articular::sim::contact_squeeze_test
