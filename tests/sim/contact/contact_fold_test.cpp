// Bodies that touch themselves.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_fold_test {

constexpr double kElement = 0.002;                             // [m]
constexpr double kArm = 0.030, kBack = 0.006;                  // of the U: length, thickness [m]
constexpr double kThick = 0.006, kGap = 0.004;                 // of an arm, between the arms [m]
constexpr double kHeight = 2 * kThick + kGap, kBroad = 0.008;  // [m]

/// A U on its side: arms along +x from the back, one above the other, the lower side at z = 0.
MeshData lying_u() {
  const Vec3 size(kArm + kBack, kBroad, kHeight);
  const BoxGeometry box{size, (size / kElement).array().round().cast<int>(), size / 2};
  return carved(
      box, [](const Vec3& c) { return c.x() < kBack || std::abs(c.z() - kHeight / 2) > kGap / 2; });
}

Body u_body(const TemporaryFolder& folder, double young) {
  Body u = mesh_body("u", Body::Kind::Tissue, lying_u(), folder);
  u.material = neo_hookean(young, 0.3);
  return u;
}

/// Depth of a node in a foreign element, measured to the planes of the surface's faces that it is
/// behind and over: the distance to the nearest of them [m]. 0 for a node that is in none.
double deepest_node(const Collider& collider, const Positions& x) {
  const auto depth_below_surface = [&](Eigen::Index i) {
    const Vec3 p = x.col(i);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& face : collider.surface.faces.colwise()) {
      if ((face.array() == static_cast<int>(i)).any()) continue;
      const Vec3 a = x.col(face[0]), u = x.col(face[1]) - a, v = x.col(face[2]) - a;
      const Vec3 n = u.cross(v), w = p - a;
      const double s = w.cross(v).dot(n) / n.squaredNorm(), t = u.cross(w).dot(n) / n.squaredNorm();
      const double depth = -w.dot(n) / n.norm();
      if (std::min({s, t, 1 - s - t}) >= -1e-2 && depth >= 0) least = std::min(least, depth);
    }
    return least;
  };
  double deepest = 0;
  for (const auto& tet : collider.tets.colwise()) {
    Eigen::Matrix4d corners;
    for (int a = 0; a < 4; ++a) corners.col(a) << x.col(tet[a]), 1;
    const Eigen::Matrix4d weights = corners.inverse();
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if ((tet.array() == static_cast<int>(i)).any()) continue;
      if ((weights * x.col(i).homogeneous()).minCoeff() <= 0) continue;
      deepest = std::max(deepest, depth_below_surface(i));
    }
  }
  return deepest;
}

// The upper arm sags onto the lower one.
TEST(SelfContact, ASoftUFallsOntoTheFloorAndOntoItselfAndRests) {
  const TemporaryFolder folder;
  Scenario s = contact_scene(5e-3);
  s.bodies = {u_body(folder, 12e3), box_body("floor", Body::Kind::Fixed, {0.1, 0.1, 0.01},
                                             {0.02, 0.004, -0.01}, {10, 10, 1})};
  s.contacts = {{"u", "u", {}}, {"u", "floor", {}}};
  s.loads = {gravity({0, 0, -9.81})};
  Simulation run(s);
  double most_kinetic = 0, least_ratio = 1;
  run.advance(1, [&] {
    most_kinetic = std::max(most_kinetic, kinetic_energy(run));
    least_ratio = std::min(least_ratio, least_volume_ratio(run));
  });
  EXPECT_GT(least_ratio, 0);
  EXPECT_LT(kinetic_energy(run), 1e-4 * most_kinetic);
  const ContactSummary self = run.stepper.dynamics().contact_summary(0);
  EXPECT_GT(self.area, kElement * kElement);  // it lies on itself
  const double weight = run.model.tissues[0].lumped_mass.sum() * 9.81;
  EXPECT_NEAR(run.force_on(bone_of(run, "floor")).z(), -weight, 1e-3 * weight);
  // What a penalty needs to carry the weight, and no more.
  const Positions x = nodes_of(run, 0);
  EXPECT_LT(deepest_node(*run.model.bodies[0].collider, x), 0.01 * kElement);
  EXPECT_GT(x.row(2).minCoeff(), -0.005 - 0.01 * kElement);
}

/// The largest change of an edge's length, relative to the element size.
double largest_stretch(const Simulation& run) {
  const Tissue& tissue = run.model.tissues[0];
  const Positions x = nodes_of(run, 0);
  double largest = 0;
  for (const auto& tet : tissue.elements.tets().colwise())
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b) {
        const double now = (x.col(tet[a]) - x.col(tet[b])).norm();
        const double before = (tissue.X.col(tet[a]) - tissue.X.col(tet[b])).norm();
        largest = std::max(largest, std::abs(now - before) / kElement);
      }
  return largest;
}

/// A plate that closes in by `way` within 0.2 s, waits as long and opens again.
MotionLoad closing(const std::string& plate, const Vec3& way) {
  MotionLoad load = shift(plate, 0.2, way);
  load.motion.time = {0, 0.2, 0.4, 0.6};
  load.motion.translation = {Vec3::Zero(), way, way, Vec3::Zero()};
  return load;
}

/// What pressed bodies show: how far they were closed and whether they came back.
/// @param depth  of a node in a foreign element that there may be, by the element
void expect_closed_and_recovered(const Scenario& s, double depth) {
  Simulation run(s);
  double least_ratio = 1;
  const auto watch = [&] { least_ratio = std::min(least_ratio, least_volume_ratio(run)); };
  run.advance(0.4, watch);
  EXPECT_GT(run.stepper.dynamics().contact_summary(0).area, 5e-7);  // [m²]
  EXPECT_GT(largest_stretch(run), 0.05);
  EXPECT_LT(deepest_node(*run.model.bodies[0].collider, nodes_of(run, 0)), depth * kElement);
  run.advance(1.2, watch);
  EXPECT_GT(least_ratio, 0);
  EXPECT_EQ(run.stepper.dynamics().contact_summary(0).area, 0);
  EXPECT_LT(largest_stretch(run), 1e-3);
}

// A hairpin between two plates, until its arms lie on each other. Its back is held at mid-height:
// without friction it would slip out.
TEST(SelfContact, AUPressedFlatOntoItselfRecoversItsShape) {
  const TemporaryFolder folder;
  Scenario s = contact_scene(5e-3);
  const Vec3 plate(0.06, 0.03, 0.01), middle(kArm / 2, kBroad / 2, 0);
  s.bodies = {u_body(folder, 50e3),
              box_body("below", Body::Kind::Fixed, plate, middle - Vec3(0, 0, 0.0052), {12, 6, 2}),
              box_body("above", Body::Kind::Fixed, plate, middle + Vec3(0, 0, kHeight + 0.0052),
                       {12, 6, 2}),
              stand("holder")};
  s.attachments = {
      attach("u", "holder", {-1, -1, kHeight / 2 - 2.1e-3}, {1e-6, 1, kHeight / 2 + 2.1e-3})};
  s.contacts = {{"u", "u", {}}, {"u", "below", {}}, {"u", "above", {}}};
  const double way = kGap / 2 + 0.5e-3;
  s.loads = {closing("below", {0, 0, way}), closing("above", {0, 0, -way})};
  expect_closed_and_recovered(s, 0.05);
}

// A V whose legs' ends are driven together and back. (Between plates it would slip out.)
TEST(SelfContact, AVClosedOnItselfRecoversItsShape) {
  Scenario s = contact_scene(5e-3);
  Body v = box_body("v", Body::Kind::Tissue, Vec3::Ones());
  v.geometry = VShapeGeometry{0.02, 0.004, 0.5, {10, 2}};
  v.material = neo_hookean(50e3, 0.3);
  s.bodies = {v, stand("left"), stand("right")};
  s.contacts = {{"v", "v", {}}};
  s.attachments = {attach("v", "left", {-1, -1, 0}, {-0.0064, 1, 1}),
                   attach("v", "right", {0.0064, -1, 0}, {1, 1, 1})};
  struct Closing {
    Scenario::Response response;
    double way, depth;
  };
  // Edge against edge, of which averages let more sink in.
  for (const auto& [response, way, depth] : {Closing{Scenario::Response::Pointwise, 3.4e-3, 0.05},
                                             Closing{Scenario::Response::Averaged, 3.8e-3, 0.1}}) {
    s.contact_response = response;
    s.loads = {closing("left", {way, 0, 0}), closing("right", {-way, 0, 0})};
    expect_closed_and_recovered(s, depth);
  }
}

}  // namespace articular::sim::contact_fold_test
