#pragma once

#include "sim/base/pose.hpp"
#include "sim/scenario/scenario.hpp"

/// The motion that a scenario prescribes, over time: translations and rotation vectors, each
/// interpolated by its components. The velocities and accelerations of the turn follow from those
/// of its rotation vector, so that both are as continuous as these, whatever the axes do.
///
/// A spline is the cubic one through all samples, with second derivatives b_i at the times t_i:
///
///   h_(i-1) b_(i-1) + 2 (h_(i-1) + h_i) b_i + h_i b_(i+1) = 6 (s_i − s_(i-1)),
///   h_i = t_(i+1) − t_i,   s_i = (x_(i+1) − x_i)/h_i
///
/// with no velocity at both ends (Ends::Rest, clamped) or no b there (Ends::Moving, natural)
/// [Stoer, Bulirsch. Introduction to Numerical Analysis, ch. 2.4].
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

/// Finds the bends of a spline; other motions have none.
void fit_spline(Motion& motion);

/// Times at which accelerations jump: all of them, of a spline that rests at its ends those two, of
/// one that goes on none.
std::vector<double> kinks_of(const Motion& motion);

/// Rates of the velocities [m/s², rad/s²] of a point that a smooth motion or a spline shifts and of
/// the turn about it. They jump at its kinks.
RigidVelocity driven_acceleration(const Motion& motion, Instant at);

}  // namespace articular::sim
