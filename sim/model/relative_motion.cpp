#include "sim/model/relative_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace articular::sim {

Vec3 position_in(int frame, const Model& model, const Configuration& now, const Vec3& x) {
  if (frame < 0) return x;
  const auto b = static_cast<std::size_t>(frame);
  return now.poses[b].R.transpose() * (x - now.poses[b].p) + model.rigid_bodies[b].rest.p;
}

Vec3 velocity_in(int frame, const Configuration& now, const Vec3& x, const Vec3& v) {
  if (frame < 0) return v;
  const Pose& pose = now.poses[static_cast<std::size_t>(frame)];
  const RigidVelocity& body = now.velocities[static_cast<std::size_t>(frame)];
  return pose.R.transpose() * (v - body.linear - body.angular.cross(x - pose.p));
}

Vec3 position_of(const PointInFrame& place, const Model& model, const Configuration& now) {
  return position_in(place.frame, model, now, now.position(place.point));
}

Vec3 velocity_of(const PointInFrame& place, const Configuration& now) {
  return velocity_in(place.frame, now, now.position(place.point), now.velocity(place.point));
}

std::vector<Way> ways_that_begin(const Model& model, const Configuration& start) {
  std::vector<Way> ways;
  for (const ProbeModel& probe : model.probes)
    if (const auto* observed = std::get_if<ObservedWay>(&probe.what)) {
      const Vec3 x = position_of(observed->place, model, start);
      ways.push_back({x.x(), x.y(), x.z(), 0});
    }
  return ways;
}

void lengthen(const Model& model, const Configuration& before, const Configuration& after,
              std::vector<Way>& ways) {
  for (const ProbeModel& probe : model.probes)
    if (const auto* observed = std::get_if<ObservedWay>(&probe.what))
      ways[static_cast<std::size_t>(observed->way)].length +=
          (position_of(observed->place, model, after) - position_of(observed->place, model, before))
              .norm();
}

// With q as origin the body's points go from X to R X + d. Those of the axis slide along it:
// (I − R) c = d_⊥, whose solution square to the axis is c = (d_⊥ + cot(θ/2) a × d)/2.
HelicalAxis helical_axis(const Mat3& R, const Vec3& q, const Vec3& q_now) {
  const Eigen::AngleAxisd turn(R);
  const Vec3& a = turn.axis();
  const Vec3 d = q_now - q;
  HelicalAxis axis{a, q, turn.angle(), a.dot(d)};
  axis.center += 0.5 * (d - axis.slide * a + a.cross(d) / std::tan(0.5 * axis.turn));
  return axis;
}

HelicalAxis instant_axis(const Vec3& omega, const Vec3& q, const Vec3& v) {
  const double speed = omega.norm();
  const Vec3 a = omega / speed;
  return {a, q + a.cross(v) / speed, speed, a.dot(v)};
}

}  // namespace articular::sim
