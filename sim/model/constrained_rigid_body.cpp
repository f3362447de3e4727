#include "sim/model/constrained_rigid_body.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace articular::sim {
namespace {

Vec3 center_of_mass(const RigidBody& rigid, const Pose& pose) {
  return pose.R * (rigid.mass.center - rigid.rest.p);
}

/// Of the rates of a rigid body's velocities, what its drive gives them: s̈, ω_f × R_f ω_D + R_f
/// ω̇_D.
Vec6 driven_part(const RigidBody& rigid, const Pose& pose, const RigidVelocity& velocity,
                 Instant at) {
  if (!rigid.motion) return Vec6::Zero();
  const Mat3 R_f = pose.R * drive_of(rigid, at.t).R.transpose();
  const RigidVelocity rate = driven_acceleration(*rigid.motion, at);
  const Vec3 turning = R_f * driven_velocity(*rigid.motion, Pose{}, at.t).angular;
  Vec6 part;
  part << rate.linear, (velocity.angular - turning).cross(turning) + R_f * rate.angular;
  return part;
}

/// Of bounded size: they need no memory of the heap, and none of the code for large matrices.
using Axes = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
using FreeVelocities = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
using FreeMass = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// One unit vector a free freedom of translation (k = 0) or rotation (k = 1).
Axes free_axes(const Hold& hold, std::size_t k) {
  Axes axes(3, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (hold.held[3 * k + i]) continue;
    axes.conservativeResize(Eigen::NoChange, axes.cols() + 1);
    axes.rightCols<1>() = hold.axes.col(static_cast<Eigen::Index>(i));
  }
  return axes;
}

}  // namespace

Mat3 free_projection(const Hold& hold, std::size_t k) {
  const Axes axes = free_axes(hold, k);
  return axes * axes.transpose();
}

Vec6 free_part(const RigidBody& rigid, const Vec6& value) {
  if (!rigid.hold) return value;
  Vec6 part;
  part << free_projection(*rigid.hold, 0) * value.head<3>(),
      free_projection(*rigid.hold, 1) * value.tail<3>();
  return part;
}

Mat6 rigid_mass(const RigidBody& rigid, const Pose& pose) {
  const Mat3 c = skew(center_of_mass(rigid, pose));
  Mat6 mass;
  mass << rigid.mass.mass * Mat3::Identity(), -rigid.mass.mass * c, rigid.mass.mass * c,
      pose.R * rigid.mass.inertia * pose.R.transpose() - rigid.mass.mass * c * c;
  return mass;
}

Vec6 gyroscopic_force(const RigidBody& rigid, const Pose& pose, const Vec3& omega) {
  const Mat6 mass = rigid_mass(rigid, pose);
  Vec6 force;
  force << rigid.mass.mass * omega.cross(omega.cross(center_of_mass(rigid, pose))),
      omega.cross(mass.bottomRightCorner<3, 3>() * omega);
  return force;
}

Vec6 rigid_acceleration(const RigidBody& rigid, const Pose& pose, const RigidVelocity& velocity,
                        Instant at, const Vec6& force) {
  const Mat6 mass = rigid_mass(rigid, pose);
  const Vec6 drive = force - gyroscopic_force(rigid, pose, velocity.angular) -
                     mass * driven_part(rigid, pose, velocity, at);
  if (!rigid.hold) return mass.llt().solve(drive);
  const Axes shift = free_axes(*rigid.hold, 0), turn = free_axes(*rigid.hold, 1);
  const Eigen::Index num_free = shift.cols() + turn.cols();
  if (num_free == 0) return Vec6::Zero();
  FreeVelocities basis = FreeVelocities::Zero(6, num_free);
  basis.topLeftCorner(3, shift.cols()) = shift;
  basis.bottomRightCorner(3, turn.cols()) = turn;
  const FreeMass free_mass = basis.transpose() * mass * basis;
  return basis * free_mass.llt().solve(basis.transpose() * drive);
}

Vec6 force_on_hold(const RigidBody& rigid, const Pose& pose, const RigidVelocity& velocity,
                   Instant at, const Vec6& force) {
  const Vec6 acceleration =
      rigid_acceleration(rigid, pose, velocity, at, force) + driven_part(rigid, pose, velocity, at);
  const Vec6 rest = force - rigid_mass(rigid, pose) * acceleration -
                    gyroscopic_force(rigid, pose, velocity.angular);
  return rest - free_part(rigid, rest);
}

Vec6 driven_way(const RigidBody& rigid, double t_from, double t_to, const Mat3& R, double t) {
  const Pose from = drive_of(rigid, t_from), to = drive_of(rigid, t_to);
  const Mat3 R_f = R * drive_of(rigid, t).R.transpose();
  const Eigen::AngleAxisd turn(to.R * from.R.transpose());
  Vec6 way;
  way << to.p - from.p, R_f * (turn.angle() * turn.axis());
  return way;
}

}  // namespace articular::sim
