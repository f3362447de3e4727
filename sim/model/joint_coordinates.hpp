#pragma once

#include "sim/base/pose.hpp"
#include "sim/scenario/scenario.hpp"

/// Joint coordinates after Grood and Suntay: three turns about axes of which one lies in each body
/// and the third, the floating axis, is square to both, so that their order does not matter.
///
///   e1 = lateral axis of the proximal body,  e3 = up axis of the distal one,  e2 = floating,
///   forward flexion about e1, abduction about e2, internal rotation about e3; with H from the
///   proximal to the distal origin: lateral H·e1, anterior H·e2, distraction −H·e3
///
/// A left joint is the mirror image of a right one and has the same numbers.
///
/// [Grood 1983] Grood, Suntay. A joint coordinate system for the clinical description of
/// three-dimensional motions: application to the knee. J Biomech Eng 105:136.
namespace articular::sim {

/// Axes of a body in its own frame: unit vectors, square to each other.
struct JointFrame {
  int rigid = -1;
  Vec3 origin = Vec3::Zero();  // [m]
  Vec3 lateral = Vec3::Zero(), anterior = Vec3::Zero(), up = Vec3::Zero();
};

/// The proximal body's lateral axis and the distal one's up axis stay as they are given; the other
/// of the two is made square to it.
/// @param rest  the rigid body's pose at the start, with no rotation
/// @throws InputError  at `where` when the two are parallel
JointFrame proximal_frame(const JointSide& side, bool is_right, int rigid, const Pose& rest,
                          const Location& where);
JointFrame distal_frame(const JointSide& side, bool is_right, int rigid, const Pose& rest,
                        const Location& where);

struct JointCoordinates {
  double flexion = 0, abduction = 0, internal_rotation = 0;  // [rad], flexion in (−π, π]
  double lateral = 0, anterior = 0, distraction = 0;         // of the distal origin [m]
};

/// NaN for all but abduction where that is a right angle: there is no floating axis.
JointCoordinates joint_coordinates(const JointFrame& proximal, const Pose& proximal_pose,
                                   const JointFrame& distal, const Pose& distal_pose,
                                   bool is_right);

}  // namespace articular::sim
