// Contact of what lies deeper in another body than contact in its usual range knows.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/gap/face_bounds.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::face_bounds_test {

std::vector<FaceBounds> faces_of(const MeshData& mesh) {
  const collision::Surface surface =
      collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  std::vector<FaceBounds> faces;
  for (const auto& face : surface.faces.colwise())
    faces.push_back(face_bounds(mesh.X(Eigen::all, face)));
  return faces;
}

FaceBounds point_triangle(const Vec3& x) {
  return face_bounds(x.replicate<1, 3>() + 1e-9 * Mat3::Identity());
}

// Inside it is the distance from the nearest side; outside also beyond edges and corners, where the
// nearest faces look past the point.
TEST(DeepContact, DepthBelowABoxIsTheDistanceFromItsNearestSide) {
  const std::vector<FaceBounds> box = faces_of(box_mesh({{2, 2, 2}, {3, 2, 2}, Vec3::Zero()}));
  Random random(1);
  int inside = 0, beyond_corners = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 x = 1.6 * random.vec3();
    const Vec3 outside = (x.cwiseAbs() - Vec3::Ones()).cwiseMax(0);
    const bool is_inside = outside.norm() == 0;
    inside += is_inside ? 1 : 0;
    beyond_corners += outside.minCoeff() > 0 ? 1 : 0;
    const double expected = is_inside ? 1 - x.cwiseAbs().maxCoeff() : -outside.norm();
    EXPECT_NEAR(depth_below(point_triangle(x), box), expected, 1e-8) << x.transpose();
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(beyond_corners, 20);
}

/// A small block, not turned, whose lower side is `depth` below the upper one of a large fixed box
/// of fine elements [m].
constexpr double kHeight = 0.1, kSmall = 0.03;

Scenario plunged(double depth, Scenario::Analysis analysis) {
  Scenario s = contact_scene(1e-3);
  s.analysis = analysis;
  s.bodies = {
      box_body("large", Body::Kind::Fixed, {0.2, 0.2, kHeight}, {0, 0, -kHeight / 2}, {10, 10, 8}),
      box_body("small", Body::Kind::Tissue, {kSmall, kSmall, 2 * kHeight},
               {0.003, 0.002, kHeight - depth}, {2, 2, 12})};
  return s;
}

/// On the small block [N].
Vec3 contact_force(const Scenario& scenario) {
  const Simulation run(scenario);
  return -run.stepper.dynamics().contact_summary(0).force;
}

// Half an element deep or three, it is pushed out the way it came, by stiffness times depth times
// area; the sides that stand in the other body push nowhere.
TEST(DeepContact, ForceGoesOnGrowingWithDepthFarBeyondOneElement) {
  for (const auto analysis : {Scenario::Analysis::Dynamic, Scenario::Analysis::Static}) {
    const double element = kHeight / 8;
    double per_depth = 0;
    for (const double depth :
         {0.2 * element, 0.7 * element, 1.3 * element, 2.1 * element, 3.2 * element}) {
      const Vec3 force = contact_force(plunged(depth, analysis));
      if (per_depth == 0) per_depth = force.z() / depth;
      EXPECT_GT(force.z(), 0);
      EXPECT_NEAR(force.z() / depth, per_depth, 1e-6 * per_depth) << depth / element;
      EXPECT_LT(force.head<2>().norm(), 1e-6 * force.z()) << depth / element;
    }
  }
}

// A ball of 10 kg/l is thrown into a slab, as fast as it takes to press in by several elements: it
// comes to rest inside and is thrown out again, never through.
TEST(DeepContact, AHeavyBallThrownIntoASlabComesOutWhereItCameIn) {
  Scenario s = contact_scene(0.5e-3);
  s.bodies = {stand("floor"),
              box_body("slab", Body::Kind::Tissue, {0.1, 0.1, 0.04}, {0, 0, -0.02}, {8, 8, 4}),
              ball_body(10e3, {0.012, 5e-3, {1e-3, 2e-3, 0.0125}})};
  s.bodies[1].material = neo_hookean(50e3, 0.3);
  s.bodies[2].velocity = {0, 0, -4};
  s.attachments = {attach("slab", "floor", {-1, -1, -0.041}, {1, 1, -0.039})};
  Simulation run(s);
  double lowest = 0, end = 0;
  run.advance(0.06, [&] {
    end = run.now().poses[static_cast<std::size_t>(bone_of(run, "ball"))].p.z();
    lowest = std::min(lowest, end);
  });
  EXPECT_LT(lowest, -0.002);  // its centre, a radius below the slab's upper side and more
  EXPECT_GT(lowest, -0.04);
  EXPECT_GT(end, 0.012);
  EXPECT_GT(least_volume_ratio(run), 0.5);
}

}  // namespace articular::sim::face_bounds_test
