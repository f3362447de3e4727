// One contact scene in other lengths, at another place, and turned.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_scaling_test {

/// Lengths and times are `length` times as large: with E and density the same, speeds and strains
/// are the same, and gravity is 1/length times as large.
struct Setting {
  double length = 1;
  Vec3 place = Vec3::Zero();  // [m]
  Vec3 turn = Vec3::Zero();   // rotation vector
};

constexpr double kSide = 0.02, kFall = 2e-4, kStep = 1e-3;  // [m], [m], [s] at length 1

enum class Floor { Solid, Shell };

Mat3 rotation(const Vec3& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Mat3::Identity();
}

/// A mesh [m] in its setting.
MeshData set(MeshData mesh, const Setting& setting) {
  mesh.X = (setting.length * rotation(setting.turn) * mesh.X).colwise() + setting.place;
  return mesh;
}

/// A soft block that falls onto a floor, tilted a little so that nothing is symmetric.
Scenario falling_block(const Setting& setting, Floor floor, const TemporaryFolder& folder) {
  Scenario s = contact_scene(kStep * setting.length);
  const Mat3 tilt = rotation({0.02, -0.03, 0.01});
  const MeshData block =
      bent({Vec3::Constant(kSide), {3, 4, 3}, Vec3::Zero()},
           [&](const Vec3& X) -> Vec3 { return tilt * X + Vec3(0, 0, 0.53 * kSide + kFall); });
  MeshData ground = box_mesh({{3 * kSide, 3 * kSide, kSide}, {5, 5, 2}, {0, 0, -kSide / 2}});
  if (floor == Floor::Shell) {
    ground.triangles =
        collision::build_surface(ground.tets, static_cast<int>(ground.X.cols())).faces;
    ground.tets.resize(4, 0);
  }
  s.bodies = {mesh_body("block", Body::Kind::Tissue, set(block, setting), folder),
              mesh_body("floor", Body::Kind::Fixed, set(ground, setting), folder)};
  s.loads = {gravity(rotation(setting.turn) * Vec3(0, 0, -9.81 / setting.length))};
  return s;
}

struct Outcome {
  Positions x;   // in the block's own lengths and place
  double force;  // on the floor, over length²
};

Outcome outcome(const Setting& setting, Floor floor) {
  const TemporaryFolder folder;
  Simulation run(falling_block(setting, floor, folder));
  run.advance(100 * kStep * setting.length);
  const Positions x = nodes_of(run, 0).colwise() - setting.place;
  return {rotation(setting.turn).transpose() * x / setting.length,
          run.force_on(bone_of(run, "floor")).norm() / (setting.length * setting.length)};
}

/// The larger deviation: of positions by the block's side, of the force by itself.
double deviation(const Outcome& a, const Outcome& b) {
  return std::max((a.x - b.x).colwise().norm().maxCoeff() / kSide,
                  std::abs(a.force - b.force) / a.force);
}

class ContactScene : public testing::TestWithParam<Floor> {
 protected:
  double deviation_in(const Setting& setting) const {
    const Outcome given = outcome({}, GetParam());
    EXPECT_GT(given.force, 0.01);  // [N]: it lies on the floor
    return deviation(given, outcome(setting, GetParam()));
  }
};

// With powers of two as factors every number has the same digits, so that nothing may differ. (By
// 1000, Newton's iteration may once stop an iteration earlier, which changes what its tolerance
// allows.)
TEST_P(ContactScene, IsTheSameAThousandTimesAsSmall) {
  EXPECT_LT(deviation_in({1.0 / 1024, Vec3::Zero(), Vec3::Zero()}), 1e-14);
}
TEST_P(ContactScene, IsTheSameAThousandTimesAsLarge) {
  EXPECT_LT(deviation_in({1024, Vec3::Zero(), Vec3::Zero()}), 1e-14);
}
// Every product is rounded in another way.
TEST_P(ContactScene, IsTheSameWhenTurned) {
  EXPECT_LT(deviation_in({1, Vec3::Zero(), {0.4, -1.1, 0.7}}), 1e-9);
}
// A position 100 m away has an error of 1e-14 m, 1e-12 of the side; the fall adds up a hundred.
TEST_P(ContactScene, IsTheSameAHundredMetresAway) {
  EXPECT_LT(deviation_in({1, {100, -100, 100}, Vec3::Zero()}), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Floors, ContactScene, testing::Values(Floor::Solid, Floor::Shell),
                         [](const auto& floor) {
                           return floor.param == Floor::Solid ? "Solid" : "Shell";
                         });

}  // namespace articular::sim::contact_scaling_test
