#pragma once

#include "sim/base/pose.hpp"
#include "sim/scenario/scenario.hpp"

/// The motion that a scenario prescribes, over time.
namespace articular::sim {

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

}  // namespace articular::sim
