#pragma once

#include <Eigen/Geometry>

#include "fem/types.hpp"
#include "sim/scenario.hpp"

namespace articular::sim {

/// Where a bone is: x = p + R X for a point X of its own frame.
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

/// Mass, centre of mass and inertia about it.
struct MassProperties {
  double mass = 0;              // [kg]
  Vec3 center = Vec3::Zero();   // [m]
  Mat3 inertia = Mat3::Zero();  // [kg m²], about the centre
};

/// Of the solid that a closed surface bounds (outward normals), by the divergence theorem.
MassProperties solid_mass_properties(const Positions& X, const Triangles& surface, double density);

/// Of two bodies joined; used to add the mass of tissue nodes that a bone carries.
MassProperties join(const MassProperties& a, const MassProperties& b);

/// Pose and velocity of a driven body at a time.
/// @param rest  its pose at the start (R = identity)
Pose driven_pose(const Motion& motion, const Pose& rest, double t);
RigidVelocity driven_velocity(const Motion& motion, const Pose& rest, double t);

/// A time, and on which side of it accelerations are meant that jump there.
struct Instant {
  double t = 0;  // [s]
  bool after = false;
};

/// Rates of the velocities [m/s², rad/s²] of a point that a smooth motion shifts and of the turn
/// about it. They jump at the motion's times.
RigidVelocity driven_acceleration(const Motion& motion, Instant at);

/// Rotation by a rotation vector [rad].
Mat3 rotation_matrix(const Vec3& rotation_vector);

/// Turns a quaternion (w, x, y, z) by a rotation vector [rad] of the world frame.
void turn(double* q, const Vec3& rotation_vector);

}  // namespace articular::sim
