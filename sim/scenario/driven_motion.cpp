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

constexpr auto kSmooth = Motion::Interpolation::Smooth, kSpline = Motion::Interpolation::Spline;

/// Second derivatives at the samples, by elimination from the first to the last.
std::vector<Vec3> bends_of(const std::vector<double>& t, const std::vector<Vec3>& x,
                           Motion::Ends ends) {
  if (x.size() < 2) return std::vector<Vec3>(x.size(), Vec3::Zero());
  const std::size_t last = x.size() - 1;
  const bool rests = ends == Motion::Ends::Rest;
  const auto slope = [&](std::size_t i) -> Vec3 { return (x[i + 1] - x[i]) / (t[i + 1] - t[i]); };
  std::vector<double> diagonal(last + 1), after(last + 1, 0);
  std::vector<Vec3> bend(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const double before = i > 0 ? t[i] - t[i - 1] : 0;
    after[i] = i < last ? t[i + 1] - t[i] : 0;
    diagonal[i] = 2 * (before + after[i]);
    const Vec3 here = i < last ? slope(i) : Vec3(Vec3::Zero()),
               slope_before = i > 0 ? slope(i - 1) : Vec3(Vec3::Zero());
    bend[i] = 6 * (here - slope_before);
    const bool is_end = i == 0 || i == last;
    if (is_end && !rests) {
      after[i] = 0;
      diagonal[i] = 1;
      bend[i].setZero();
    } else if (i > 0) {
      const double part = before / diagonal[i - 1];
      diagonal[i] -= part * after[i - 1];
      bend[i] -= part * bend[i - 1];
    }
  }
  for (std::size_t i = last + 1; i-- > 0;) {
    if (i < last) bend[i] -= after[i] * bend[i + 1];
    bend[i] /= diagonal[i];
  }
  return bend;
}

/// A spline and its first two derivatives, between the samples and, where it does not rest, beyond.
struct SplinePoint {
  Vec3 value, rate, bend;
};

SplinePoint spline_at(const Motion& motion, const std::vector<Vec3>& x,
                      const std::vector<Vec3>& bend, double t) {
  const auto inner = std::clamp(t, motion.time.front(), motion.time.back());
  const auto next = std::upper_bound(motion.time.begin() + 1, motion.time.end() - 1, inner);
  const auto i = static_cast<std::size_t>(next - motion.time.begin());
  const double h = motion.time[i] - motion.time[i - 1];
  const double b = (inner - motion.time[i - 1]) / h, a = 1 - b;
  SplinePoint point{
      a * x[i - 1] + b * x[i] +
          h * h / 6 * ((a * a * a - a) * bend[i - 1] + (b * b * b - b) * bend[i]),
      (x[i] - x[i - 1]) / h + h / 6 * ((3 * b * b - 1) * bend[i] - (3 * a * a - 1) * bend[i - 1]),
      a * bend[i - 1] + b * bend[i]};
  point.value += (t - inner) * point.rate;
  return point;
}

/// A vector along the motion's times, and its derivative.
/// @param bend  of a spline
PathPoint along(const Motion& motion, const std::vector<Vec3>& values,
                const std::vector<Vec3>& bend, double t) {
  if (values.empty()) return {};
  if (motion.interpolation == kSpline && motion.ends == Motion::Ends::Moving) {
    const SplinePoint point = spline_at(motion, values, bend, t);
    return {point.value, point.rate};
  }
  if (t <= motion.time.front()) return {values.front(), Vec3::Zero()};
  if (t >= motion.time.back()) return {values.back(), Vec3::Zero()};
  if (motion.interpolation == kSpline) {
    const SplinePoint point = spline_at(motion, values, bend, t);
    return {point.value, point.rate};
  }
  const auto next = std::upper_bound(motion.time.begin(), motion.time.end(), t);
  const auto i = static_cast<std::size_t>(next - motion.time.begin());
  const double duration = motion.time[i] - motion.time[i - 1];
  const double s = (t - motion.time[i - 1]) / duration;
  const bool smooth = motion.interpolation == kSmooth;
  const double blend = smooth ? s * s * (3 - 2 * s) : s;
  const double rate = (smooth ? 6 * s * (1 - s) : 1) / duration;
  const Vec3 change = values[i] - values[i - 1];
  return {values[i - 1] + blend * change, rate * change};
}

PathPoint turn_at(const Motion& motion, double t) {
  return along(motion, motion.rotation, motion.rotation_bend, t);
}
PathPoint shift_at(const Motion& motion, double t) {
  return along(motion, motion.translation, motion.translation_bend, t);
}

/// Its second derivative, which jumps at the kinks.
Vec3 curvature(const Motion& motion, const std::vector<Vec3>& values, const std::vector<Vec3>& bend,
               Instant at) {
  // Integrators add up their way to the end of a step.
  constexpr double kRoundOff = 1e-12;
  if (values.size() < 2 || motion.interpolation == Motion::Interpolation::Linear)
    return Vec3::Zero();
  const double whole = motion.time.back() - motion.time.front();
  const double beside = at.t + (at.after ? kRoundOff : -kRoundOff) * whole;
  if (beside <= motion.time.front() || beside >= motion.time.back()) return Vec3::Zero();
  if (motion.interpolation == kSpline) return spline_at(motion, values, bend, at.t).bend;
  const auto next = std::upper_bound(motion.time.begin(), motion.time.end(), beside);
  const auto i = static_cast<std::size_t>(next - motion.time.begin());
  const double duration = motion.time[i] - motion.time[i - 1];
  const double s = (at.t - motion.time[i - 1]) / duration;
  return 6 * (1 - 2 * s) / (duration * duration) * (values[i] - values[i - 1]);
}

}  // namespace

void fit_spline(Motion& motion) {
  if (motion.interpolation != kSpline) return;
  motion.translation_bend = bends_of(motion.time, motion.translation, motion.ends);
  motion.rotation_bend = bends_of(motion.time, motion.rotation, motion.ends);
}

std::vector<double> kinks_of(const Motion& motion) {
  if (motion.interpolation != kSpline) return motion.time;
  if (motion.ends == Motion::Ends::Moving) return {};
  return {motion.time.front(), motion.time.back()};
}

Pose driven_pose(const Motion& motion, const Pose& rest, double t) {
  const Mat3 R = rotation_matrix(turn_at(motion, t).value);
  const Vec3 shift = shift_at(motion, t).value;
  return {motion.about + R * (rest.p - motion.about) + shift, R * rest.R};
}

RigidVelocity driven_velocity(const Motion& motion, const Pose& rest, double t) {
  const PathPoint rotation = turn_at(motion, t);
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
  return {shift_at(motion, t).rate + omega.cross(lever), omega};
}

RigidVelocity driven_acceleration(const Motion& motion, Instant at) {
  const PathPoint rotation = turn_at(motion, at.t);
  const Vec3 &theta = rotation.value, &rate = rotation.rate;
  const Vec3 second = curvature(motion, motion.rotation, motion.rotation_bend, at);
  const TurnCoefficients c = turn_coefficients(theta.norm());
  const Vec3 across = theta.cross(rate);
  const double growth = theta.dot(rate);
  const Vec3 angular = second + c.dc1 * growth * across + c.c1 * theta.cross(second) +
                       c.dc2 * growth * theta.cross(across) +
                       c.c2 * (rate.cross(across) + theta.cross(theta.cross(second)));
  return {curvature(motion, motion.translation, motion.translation_bend, at), angular};
}

}  // namespace articular::sim
