// The only use of libccd.
#include "collision/narrow/gjk.hpp"

#include <ccd/ccd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace articular::collision {
namespace {

static_assert(std::is_same_v<ccd_real_t, double>, "libccd must be built for double precision");

// Disjoint or overlapping elements need 3 to 10 iterations; only a touching pair, or one swept by
// spheres whose distance is the margin within 1e-4 or so, gets here. libccd's own default is
// unlimited.
constexpr unsigned long kMaxIterations = 100;

// A plane separates when the gap it leaves is larger than this part of the pair's size. Below, the
// sign of the gap is round-off of the support points (some 1e-16 each).
constexpr double kGapTolerance = 1e-14;

/// A shape in the coordinates of its pair, and what the last support query on it was.
struct LocalShape {
  const double* points;  // 3 doubles a point
  Eigen::Index num_points;
  Eigen::Index stride;     // doubles from one point to the next
  Eigen::Vector3d origin;  // of the pair [m]
  double inverse_size;     // of the pair [1/m]
  double radius;           // of the sweeping sphere, in pair sizes
  Eigen::Vector3d first_direction;
  Eigen::Vector3d last_direction;
  Eigen::Vector3d last_support;
};

/// Farthest point of a shape in a direction, in pair coordinates.
void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  // libccd hands back the pointer it was given; the shapes live in gjk() below and are not const.
  LocalShape& shape = *static_cast<LocalShape*>(const_cast<void*>(object));
  const Eigen::Vector3d d(direction->v[0], direction->v[1], direction->v[2]);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_projection = -std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < shape.num_points; ++k) {
    const Eigen::Map<const Eigen::Vector3d> point(shape.points + k * shape.stride);
    const Eigen::Vector3d p = (point - shape.origin) * shape.inverse_size;
    const double projection = p.dot(d);
    if (projection > best_projection) {
      best_projection = projection;
      best = p;
    }
  }
  const double length = d.norm();
  if (shape.radius > 0 && length > 0) best += (shape.radius / length) * d;
  shape.last_direction = d;
  shape.last_support = best;
  ccdVec3Set(farthest, best[0], best[1], best[2]);
}

void first_direction(const void* object, const void*, ccd_vec3_t* direction) {
  const Eigen::Vector3d& d = static_cast<const LocalShape*>(object)->first_direction;
  ccdVec3Set(direction, d[0], d[1], d[2]);
}

/// libccd says "apart" also where it gives up; the last plane it looked at tells which it was.
bool last_plane_separates(const LocalShape& a, const LocalShape& b) {
  const Eigen::Vector3d& d = a.last_direction;
  return (a.last_support - b.last_support).dot(d) < -kGapTolerance * d.norm();
}

Eigen::Vector3d local_point(const LocalShape& shape, Eigen::Index k) {
  return (Eigen::Vector3d::Map(shape.points + k * shape.stride) - shape.origin) *
         shape.inverse_size;
}

/// Whether test(line) holds for one of the lines between two points of the shape.
template <class Test>
bool any_line(const LocalShape& shape, Test&& test) {
  for (Eigen::Index i = 0; i < shape.num_points; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (test(Eigen::Vector3d(local_point(shape, i) - local_point(shape, j)))) return true;
  return false;
}

double farthest_along(const LocalShape& shape, const Eigen::Vector3d& axis) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < shape.num_points; ++k)
    farthest = std::max(farthest, local_point(shape, k).dot(axis));
  return farthest;
}

/// Whether some axis perpendicular to two of the lines between points of one shape, or along a line
/// between the shapes, separates them. Slow and sure: for the few pairs on which libccd gives up,
/// which are those with parallel edges.
bool some_axis_separates(const LocalShape& a, const LocalShape& b) {
  const double gap_needed = a.radius + b.radius + kGapTolerance;
  const auto separates = [&](const Eigen::Vector3d& axis) {
    const double gap = std::max(-farthest_along(b, axis) - farthest_along(a, -axis),
                                -farthest_along(a, axis) - farthest_along(b, -axis));
    return gap > gap_needed * axis.norm();
  };
  for (const LocalShape* first : {&a, &b})
    for (const LocalShape* second : {&a, &b})
      if (any_line(*first, [&](const Eigen::Vector3d& u) {
            return any_line(*second,
                            [&](const Eigen::Vector3d& v) { return separates(u.cross(v)); });
          }))
        return true;
  for (Eigen::Index i = 0; i < a.num_points; ++i)
    for (Eigen::Index j = 0; j < b.num_points; ++j)
      if (separates(local_point(a, i) - local_point(b, j))) return true;
  return false;
}

LocalShape local_shape(const ConvexPoints& points, const Eigen::Vector3d& origin,
                       double inverse_size, double radius) {
  return {
      points.data(), points.cols(), points.outerStride(), origin, inverse_size, radius, {}, {}, {}};
}

}  // namespace

GjkOutcome gjk(const ConvexPoints& a, const ConvexPoints& b, double margin) {
  const Eigen::Vector3d min = a.rowwise().minCoeff().cwiseMin(b.rowwise().minCoeff());
  const Eigen::Vector3d max = a.rowwise().maxCoeff().cwiseMax(b.rowwise().maxCoeff());
  const Eigen::Vector3d origin = 0.5 * min + 0.5 * max;
  const double size = (max - min).maxCoeff() + margin;
  if (!(size > std::numeric_limits<double>::min())) return GjkOutcome::Intersecting;  // one point

  const double radius = 0.5 * margin / size;
  LocalShape shape_a = local_shape(a, origin, 1 / size, radius);
  LocalShape shape_b = local_shape(b, origin, 1 / size, radius);
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.first_dir = first_direction;
  ccd.support1 = support;
  ccd.support2 = support;
  ccd.max_iterations = kMaxIterations;

  // The line between the centres first; the skew directions are for pairs on which libccd gives up
  // because the difference of the shapes is flat as seen from the start.
  const Eigen::Vector3d centres = (b.rowwise().mean() - a.rowwise().mean()) / size;
  const std::array<Eigen::Vector3d, 4> starts = {
      centres.squaredNorm() > 0 ? centres : Eigen::Vector3d(1, 0, 0),
      Eigen::Vector3d(0.36, 0.48, 0.8), Eigen::Vector3d(-0.8, 0.36, 0.48),
      Eigen::Vector3d(0.48, -0.8, 0.36)};
  for (const Eigen::Vector3d& start : starts) {
    shape_a.first_direction = start;
    if (ccdGJKIntersect(&shape_a, &shape_b, &ccd) != 0) return GjkOutcome::Intersecting;
    if (last_plane_separates(shape_a, shape_b)) return GjkOutcome::Separated;
  }
  return some_axis_separates(shape_a, shape_b) ? GjkOutcome::Separated : GjkOutcome::Undecided;
}

}  // namespace articular::collision
