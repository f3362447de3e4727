#pragma once

#include <Eigen/Geometry>

#include "fem/base/types.hpp"

/// Where a rigid body is and how it moves; rotations.
namespace articular::sim {

/// Where a rigid body is: x = p + R X for a point X of its own frame.
struct Pose {
  Vec3 p = Vec3::Zero();  // [m]
  Mat3 R = Mat3::Identity();
};

struct RigidVelocity {
  Vec3 linear = Vec3::Zero();   // [m/s] of the point p
  Vec3 angular = Vec3::Zero();  // [rad/s], world
};

inline Mat3 skew(const Vec3& a) {
  Mat3 S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

/// Rotation by a rotation vector [rad].
Mat3 rotation_matrix(const Vec3& rotation_vector);

/// Turns a quaternion (w, x, y, z) by a rotation vector [rad] of the world frame.
void turn(double* q, const Vec3& rotation_vector);

}  // namespace articular::sim
