#include "sim/gap/passage.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace articular::sim {
namespace {

/// Of the triangle's area: neighbours must both be hit by what goes through their common edge,
/// rather than none.
constexpr double kOnRim = 1e-9;
/// Halvings of an interval, down to round-off of its ends.
constexpr int kBisections = 52;

struct Cubic {
  std::array<double, 4> c;  // Σ c_k s^k
  double at_end;            // f(1), by the places at the end alone
  double operator()(double s) const {
    return s == 1 ? at_end : c[0] + s * (c[1] + s * (c[2] + s * c[3]));
  }
};

/// Six times the signed volume over the motion.
Cubic volume(const Vec3& x0, const Vec3& x1, const Mat3& q0, const Mat3& q1) {
  const Vec3 u = q0.col(1) - q0.col(0), v = q0.col(2) - q0.col(0), w = x0 - q0.col(0);
  const Vec3 u1 = q1.col(1) - q1.col(0), v1 = q1.col(2) - q1.col(0), w1 = x1 - q1.col(0);
  const Vec3 du = u1 - u, dv = v1 - v, dw = w1 - w;
  const Vec3 uv = u.cross(v), dudv = du.cross(dv), mixed = du.cross(v) + u.cross(dv);
  return {{uv.dot(w), mixed.dot(w) + uv.dot(dw), dudv.dot(w) + mixed.dot(dw), dudv.dot(dw)},
          u1.cross(v1).dot(w1)};
}

/// Ends of three intervals of [0, 1] in which f rises or falls throughout; some may be empty.
std::array<double, 4> turns(const std::array<double, 4>& c) {
  double first = 0, second = 1;
  const auto add = [&](double s) {
    if (!(s > 0 && s < 1)) return;
    (first == 0 ? first : second) = s;
  };
  // Of 3 c₃ s² + 2 c₂ s + c₁, without the difference of what is nearly alike.
  const double discriminant = c[2] * c[2] - 3 * c[3] * c[1];
  if (discriminant >= 0) {
    const double q = -(c[2] + std::copysign(std::sqrt(discriminant), c[2]));
    if (c[3] != 0) add(q / (3 * c[3]));
    if (q != 0) add(c[1] / q);
  }
  return {0, std::min(first, second), std::max(first, second), 1};
}

/// Where f changes from not below zero to below it, or back, between the two.
double root(const Cubic& f, double low, double high) {
  const bool front = f(low) >= 0;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) >= 0) == front ? low : high) = middle;
  }
  return front ? low : high;
}

bool lies_in(const Vec3& x, const Mat3& q) {
  const Vec3 normal = (q.col(1) - q.col(0)).cross(q.col(2) - q.col(0));
  const double area = normal.squaredNorm();
  if (!(area > 0)) return false;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = q.col(k), b = q.col((k + 1) % 3);
    if ((b - a).cross(x - a).dot(normal) < -kOnRim * area) return false;
  }
  return true;
}

}  // namespace

Passages passages(const Vec3& x0, const Vec3& x1, const Mat3& q0, const Mat3& q1) {
  Passages found;
  const Cubic f = volume(x0, x1, q0, q1);
  const std::array<double, 4> ends = turns(f.c);
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = ends[k], high = ends[k + 1];
    if ((f(low) >= 0) == (f(high) >= 0)) continue;
    const double s = root(f, low, high);
    if (lies_in((1 - s) * x0 + s * x1, (1 - s) * q0 + s * q1))
      found.of[static_cast<std::size_t>(found.count++)] = {s, f(low) >= 0};
  }
  return found;
}

}  // namespace articular::sim
