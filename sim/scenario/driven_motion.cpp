#include "sim/scenario/driven_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articular::sim {
namespace {

struct PathPoint {
  Vec3 value = Vec3::Zero(), rate = Vec3::Zero();
};

/// ω of a rotation vector θ(t), with a = |θ|:
///
///   ω = θ̇ + c1 θ × θ̇ + c2 θ × (θ × θ̇),   c1 = (1 − cos a)/a²,   c2 = (a − sin a)/a³.
///
/// Coefficients and their derivatives by a, over a: ċ = dc (θ·θ̇).
struct TurnCoefficients {
  double c1, c2, dc1, dc2;
};

TurnCoefficients turn_coefficients(double a) {
  constexpr double kSeries = 0.02;  // [rad] cancellation below, a⁴ terms above: 1e-9 either way
  const double a2 = a * a;
  if (a < kSeries)
    return {1.0 / 2 - a2 / 24, 1.0 / 6 - a2 / 120, -1.0 / 12 + a2 / 180, -1.0 / 60 + a2 / 1260};
  const double c1 = (1 - std::cos(a)) / a2, c2 = (a - std::sin(a)) / (a2 * a);
  return {c1, c2, (std::sin(a) / a - 2 * c1) / a2, (c1 - 3 * c2) / a2};
}

/// A vector along the motion's times, and its derivative.
PathPoint along(const Motion& motion, const std::vector<Vec3>& values, double t) {
  if (values.empty()) return {};
  if (t <= motion.time.front()) return {values.front(), Vec3::Zero()};
  if (t >= motion.time.back()) return {values.back(), Vec3::Zero()};
  const auto next = std::upper_bound(motion.time.begin(), motion.time.end(), t);
  const auto i = static_cast<std::size_t>(next - motion.time.begin());
  const double duration = motion.time[i] - motion.time[i - 1];
  const double s = (t - motion.time[i - 1]) / duration;
  const double blend = motion.smooth ? s * s * (3 - 2 * s) : s;
  const double rate = (motion.smooth ? 6 * s * (1 - s) : 1) / duration;
  const Vec3 change = values[i] - values[i - 1];
  return {values[i - 1] + blend * change, rate * change};
}

/// Its second derivative, which jumps at the times.
Vec3 curvature(const Motion& motion, const std::vector<Vec3>& values, Instant at) {
  // Integrators add up their way to the end of a step.
  constexpr double kRoundOff = 1e-12;
  if (values.size() < 2 || !motion.smooth) return Vec3::Zero();
  const double whole = motion.time.back() - motion.time.front();
  const double beside = at.t + (at.after ? kRoundOff : -kRoundOff) * whole;
  if (beside <= motion.time.front() || beside >= motion.time.back()) return Vec3::Zero();
  const auto next = std::upper_bound(motion.time.begin(), motion.time.end(), beside);
  const auto i = static_cast<std::size_t>(next - motion.time.begin());
  const double duration = motion.time[i] - motion.time[i - 1];
  const double s = (at.t - motion.time[i - 1]) / duration;
  return 6 * (1 - 2 * s) / (duration * duration) * (values[i] - values[i - 1]);
}

}  // namespace

Pose driven_pose(const Motion& motion, const Pose& rest, double t) {
  const Mat3 R = rotation_matrix(along(motion, motion.rotation, t).value);
  const Vec3 shift = along(motion, motion.translation, t).value;
  return {motion.about + R * (rest.p - motion.about) + shift, R * rest.R};
}

RigidVelocity driven_velocity(const Motion& motion, const Pose& rest, double t) {
  const PathPoint rotation = along(motion, motion.rotation, t);
  // ω of a rotation vector θ(t): with a = |θ|, n = θ/a:
  // ω = n (n·θ̇) + sin a / a (θ̇ - n (n·θ̇)) + (1 - cos a)/a n × θ̇
  const double a = rotation.value.norm();
  Vec3 omega = rotation.rate;
  if (a > 1e-9) {
    const Vec3 n = rotation.value / a;
    const Vec3 parallel = n * n.dot(rotation.rate);
    omega = parallel + std::sin(a) / a * (rotation.rate - parallel) +
            (1 - std::cos(a)) / a * n.cross(rotation.rate);
  }
  const Vec3 lever = rotation_matrix(rotation.value) * (rest.p - motion.about);
  return {along(motion, motion.translation, t).rate + omega.cross(lever), omega};
}

RigidVelocity driven_acceleration(const Motion& motion, Instant at) {
  const PathPoint rotation = along(motion, motion.rotation, at.t);
  const Vec3 &theta = rotation.value, &rate = rotation.rate;
  const Vec3 second = curvature(motion, motion.rotation, at);
  const TurnCoefficients c = turn_coefficients(theta.norm());
  const Vec3 across = theta.cross(rate);
  const double growth = theta.dot(rate);
  const Vec3 angular = second + c.dc1 * growth * across + c.c1 * theta.cross(second) +
                       c.dc2 * growth * theta.cross(across) +
                       c.c2 * (rate.cross(across) + theta.cross(theta.cross(second)));
  return {curvature(motion, motion.translation, at), angular};
}

}  // namespace articular::sim
