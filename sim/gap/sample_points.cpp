#include "sim/gap/sample_points.hpp"

#include <array>
#include <cmath>

namespace articular::sim {
namespace {

/// On meshes that mirror each other points would lie on the edges between two faces, and round-off
/// would give them to both or to none. So far from there rules stay what they are.
const Vec3 kAside = 1e-7 * Vec3(1, 0.382, -1.382);

std::array<SamplePoint, 7> cowper_points() {
  const double root = std::sqrt(15.0);
  std::array<SamplePoint, 7> points = {{{Vec3::Constant(1.0 / 3), 9.0 / 40}}};
  std::size_t next = 1;
  for (const double sign : {-1.0, 1.0}) {
    const double off = (6 + sign * root) / 21;  // of the two corners that a point is symmetric to
    for (int i = 0; i < 3; ++i) {
      Vec3 N = Vec3::Constant(off);
      N[i] = 1 - 2 * off;
      points[next++] = {N, (155 + sign * root) / 1200};
    }
  }
  for (SamplePoint& point : points) point.N += kAside;
  return points;
}

}  // namespace

std::span<const SamplePoint> triangle_samples() {
  static const std::array<SamplePoint, 7> points = cowper_points();
  return points;
}

}  // namespace articular::sim
