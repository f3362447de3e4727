// Beside these, history_test.cpp composes poses of turns and shifts.
#include "sim/model/joint_coordinates.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace articular::sim::joint_coordinates_test {

const Mat3 kThigh = rotation_matrix({0.3, -0.8, 2.1});
const Mat3 kShank = rotation_matrix({0.9, -0.5, 1.8});

/// A body's axes, which are not square to each other.
JointSide oblique_side(const std::string& body, const Vec3& origin) {
  return {body, origin, Vec3(-1, 0.1, 0.3).normalized(), Vec3(0.2, -0.1, 1).normalized()};
}

struct Joint {
  JointFrame femur, tibia;
  bool is_right;
};

Joint joint(bool is_right) {
  return {proximal_frame(oblique_side("femur", {0.01, -0.02, 0.03}), is_right, 0, {}, {}),
          distal_frame(oblique_side("tibia", {-0.02, 0.04, 0.01}), is_right, 1, {}, {}), is_right};
}

Eigen::Vector<double, 6> numbers(const JointCoordinates& q) {
  return {q.flexion, q.abduction, q.internal_rotation, q.lateral, q.anterior, q.distraction};
}

Eigen::Vector<double, 6> coordinates(const Joint& joint, const Pose& femur, const Pose& tibia) {
  return numbers(joint_coordinates(joint.femur, femur, joint.tibia, tibia, joint.is_right));
}

TEST(JointCoordinates, AxesAreSquareAndTheGivenOneStays) {
  const JointSide side = oblique_side("femur", Vec3::Zero());
  for (const bool is_right : {true, false}) {
    const JointFrame proximal = proximal_frame(side, is_right, 0, {}, {}),
                     distal = distal_frame(side, is_right, 0, {}, {});
    EXPECT_EQ(proximal.lateral, side.lateral);
    EXPECT_EQ(distal.up, side.up);
    for (const JointFrame& frame : {proximal, distal}) {
      Mat3 axes;
      axes << frame.lateral, frame.anterior, frame.up;
      EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-14);
      EXPECT_NEAR(axes.determinant(), is_right ? 1 : -1, 1e-14);
    }
  }
}

TEST(JointCoordinates, DoNotChangeWhereBothBonesMoveAsOne) {
  const Pose femur{{0.1, 0.2, -0.3}, kThigh}, tibia{{0.15, 0.18, -0.36}, kShank};
  const Mat3 R = rotation_matrix({-1.1, 0.4, 0.6});
  const Vec3 shift(0.5, -0.7, 0.2);
  for (const bool is_right : {true, false}) {
    const Joint knee = joint(is_right);
    const auto q = coordinates(knee, femur, tibia);
    const auto moved =
        coordinates(knee, {R * femur.p + shift, R * femur.R}, {R * tibia.p + shift, R * tibia.R});
    EXPECT_LT((q - moved).cwiseAbs().maxCoeff(), 1e-14);
  }
}

// The floating axis is square to the two others, so that a shift along it is anterior alone, and
// along the lateral axis lateral alone.
TEST(JointCoordinates, ShiftsAlongTheFloatingAxisAreLengthsInAnAbductedKneeToo) {
  for (const bool is_right : {true, false}) {
    const Joint knee = joint(is_right);
    const Pose femur{{0.1, 0.2, -0.3}, kThigh};
    const Vec3 lateral = kThigh * knee.femur.lateral, up = kShank * knee.tibia.up;
    Vec3 floating = up.cross(lateral).normalized();
    EXPECT_GT(std::abs(up.dot(lateral)), 0.1);
    if (!is_right) floating = -floating;
    const Vec3 origin = femur.p + kThigh * knee.femur.origin;
    const auto shifted = [&](const Vec3& way) {
      return coordinates(knee, femur, {origin + way - kShank * knee.tibia.origin, kShank});
    };
    EXPECT_NEAR(shifted(3e-3 * floating)[3], 0, 1e-15);
    EXPECT_NEAR(shifted(3e-3 * floating)[4], 3e-3, 1e-15);
    EXPECT_NEAR(shifted(2e-3 * lateral)[3], 2e-3, 1e-15);
    EXPECT_NEAR(shifted(2e-3 * lateral)[4], 0, 1e-15);
    EXPECT_NEAR(shifted(-4e-3 * up)[5], 4e-3, 1e-15);
  }
}

}  // namespace articular::sim::joint_coordinates_test
