#include "sim/model/joint_coordinates.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace articular::sim {
namespace {

/// Forward of a body whose lateral and up axes these are: the only place where sides differ.
Vec3 forward(const Vec3& up, const Vec3& lateral, bool is_right) {
  return is_right ? Vec3(up.cross(lateral)) : Vec3(lateral.cross(up));
}

/// The part of a direction that is square to a unit vector.
Vec3 square_to(const Vec3& axis, const Vec3& direction, const std::string& body,
               const Location& where) {
  constexpr double kParallel = 1e-3;  // sine of the angle: nobody means axes that near
  const Vec3 rest = direction - direction.dot(axis) * axis;
  if (rest.norm() < kParallel)
    throw InputError(where,
                     fmt::format("`lateral` and `up` of body `{}` have the same direction", body));
  return rest.normalized();
}

}  // namespace

JointFrame proximal_frame(const JointSide& side, bool is_right, int rigid, const Pose& rest,
                          const Location& where) {
  const Vec3 up = square_to(side.lateral, side.up, side.body, where);
  return {rigid, side.origin - rest.p, side.lateral, forward(up, side.lateral, is_right), up};
}

JointFrame distal_frame(const JointSide& side, bool is_right, int rigid, const Pose& rest,
                        const Location& where) {
  const Vec3 lateral = square_to(side.up, side.lateral, side.body, where);
  return {rigid, side.origin - rest.p, lateral, forward(side.up, lateral, is_right), side.up};
}

JointCoordinates joint_coordinates(const JointFrame& proximal, const Pose& proximal_pose,
                                   const JointFrame& distal, const Pose& distal_pose,
                                   bool is_right) {
  constexpr double kNoFloatingAxis = 1e-9;  // cosine of abduction: round-off decides then
  const Mat3 &P = proximal_pose.R, &D = distal_pose.R;
  const Vec3 e1 = P * proximal.lateral, e3 = D * distal.up;
  const Vec3 H = distal_pose.p + D * distal.origin - proximal_pose.p - P * proximal.origin;
  JointCoordinates q;
  q.abduction = std::asin(std::clamp(-e1.dot(e3), -1.0, 1.0));
  Vec3 e2 = forward(e3, e1, is_right);
  if (e2.norm() < kNoFloatingAxis) {
    q.flexion = q.internal_rotation = q.lateral = q.anterior = q.distraction =
        std::numeric_limits<double>::quiet_NaN();
    return q;
  }
  e2.normalize();
  q.flexion = std::atan2(-(P * proximal.up).dot(e2), (P * proximal.anterior).dot(e2));
  q.internal_rotation = std::atan2((D * distal.lateral).dot(e2), (D * distal.anterior).dot(e2));
  q.lateral = H.dot(e1);
  q.anterior = H.dot(e2);
  q.distraction = -H.dot(e3);
  return q;
}

}  // namespace articular::sim
