#include "sim/model/carried_tissue.hpp"

namespace articular::sim {
namespace {

Vec6 both(const RigidVelocity& velocity) {
  Vec6 v;
  v << velocity.linear, velocity.angular;
  return v;
}

/// At a time, about a point of space.
Vec6 momentum_about(const Vec3& point, const RigidBody& rigid, double t) {
  const Pose pose = driven_pose(*rigid.motion, rigid.rest, t);
  Vec6 momentum = rigid_mass(rigid, pose) * both(driven_velocity(*rigid.motion, rigid.rest, t));
  momentum.tail<3>() += (pose.p - point).cross(momentum.head<3>());
  return momentum;
}

/// V̇ of the reference point: the motion turns about a point of its own.
Vec6 acceleration_of(const RigidBody& rigid, const Pose& pose, const Vec3& omega, Instant at) {
  const RigidVelocity rate = driven_acceleration(*rigid.motion, at);
  const Vec3 lever = pose.R * (rigid.rest.p - rigid.motion->about);
  Vec6 acceleration;
  acceleration << rate.linear + rate.angular.cross(lever) + omega.cross(omega.cross(lever)),
      rate.angular;
  return acceleration;
}

}  // namespace

bool drives_tissue(const Model& model, const RigidBody& rigid) {
  return !model.is_static && !rigid.unknown && rigid.motion && rigid.mass.mass > 0;
}

double carried_kinetic_energy(const RigidBody& rigid, const Pose& pose,
                              const RigidVelocity& velocity) {
  return 0.5 * both(velocity).dot(rigid_mass(rigid, pose) * both(velocity));
}

Vec6 inertia_of_carried(const RigidBody& rigid, double step_start, Instant at) {
  const Pose pose = driven_pose(*rigid.motion, rigid.rest, at.t);
  if (rigid.motion->interpolation == Motion::Interpolation::Linear && step_start < at.t)
    return (momentum_about(pose.p, rigid, step_start) - momentum_about(pose.p, rigid, at.t)) /
           (at.t - step_start);
  const Vec3 omega = driven_velocity(*rigid.motion, rigid.rest, at.t).angular;
  return -rigid_mass(rigid, pose) * acceleration_of(rigid, pose, omega, at) -
         gyroscopic_force(rigid, pose, omega);
}

}  // namespace articular::sim
