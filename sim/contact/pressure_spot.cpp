#include "sim/contact/pressure_spot.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "sim/contact/contact_area.hpp"
#include "sim/contact/contact_pressure.hpp"

namespace articular::sim {
namespace {

using Vec2 = Eigen::Vector2d;

/// Of what of a triangle lies within a circle around the origin.
struct DiscPart {
  double area = 0;
  Vec2 moment = Vec2::Zero();  // ∫ x dA
};

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The sector between the directions of a and b.
void add_sector(const Vec2& a, const Vec2& b, double radius, DiscPart& part) {
  const Vec2 u = a.normalized(), v = b.normalized();
  part.area += 0.5 * radius * radius * std::atan2(cross(u, v), u.dot(v));
  part.moment += std::pow(radius, 3) / 3 * Vec2(v.y() - u.y(), u.x() - v.x());
}

/// What of the triangle (0, a, b) lies within the circle, negative where it turns clockwise. Over
/// the edges of a triangle that adds up to its part.
void add_edge(const Vec2& a, const Vec2& b, double radius, DiscPart& part) {
  // Within it from s to t of the way: |a + t d|² = radius².
  const Vec2 d = b - a;
  const double dd = d.squaredNorm(), ad = a.dot(d);
  const double root = ad * ad - dd * (a.squaredNorm() - radius * radius);
  double s = 0, t = 0;
  if (root > 0) {
    s = std::clamp((-ad - std::sqrt(root)) / dd, 0.0, 1.0);
    t = std::clamp((-ad + std::sqrt(root)) / dd, 0.0, 1.0);
  }
  const Vec2 first = a + s * d, last = a + t * d;
  if (s > 0) add_sector(a, first, radius, part);
  if (t > s) {
    const double area = 0.5 * cross(first, last);
    part.area += area;
    part.moment += area / 3 * (first + last);
  }
  if (t < 1) add_sector(last, b, radius, part);
}

double force_within(const PressedTriangle& triangle, const Vec3& c, double r) {
  const Mat3& x = triangle.x;
  const Vec3 first = x.col(1) - x.col(0), second = x.col(2) - x.col(0);
  const Vec3 area_vector = first.cross(second);
  const double twice_area = area_vector.norm();
  if (!(twice_area > 0)) return 0;
  const Vec3 normal = area_vector / twice_area;
  const double height = normal.dot(c - x.col(0));
  if (!(std::abs(height) < r)) return 0;
  const double radius = std::sqrt(r * r - height * height);

  // In its plane, from below c.
  const Vec3 e1 = first.normalized(), e2 = normal.cross(e1);
  Eigen::Matrix<double, 2, 3> flat;
  flat << e1.transpose() * (x.colwise() - c), e2.transpose() * (x.colwise() - c);
  DiscPart part;
  for (int k = 0; k < 3; ++k) add_edge(flat.col(k), flat.col((k + 1) % 3), radius, part);
  if (!(part.area > 0)) return 0;

  // The mean of p is that at the part's centroid, which lies within the triangle: of slivers too,
  // whose gradients are round-off.
  Eigen::Matrix2d sides;
  sides << flat.col(1) - flat.col(0), flat.col(2) - flat.col(0);
  if (!(sides.determinant() > 0)) return 0;  // narrower than round-off
  const Vec2 rest = sides.inverse() * (part.moment / part.area - flat.col(0));
  const Vec3 N = Vec3(1 - rest.sum(), rest[0], rest[1]).cwiseMax(0);
  return part.area * triangle.p.dot(N) / N.sum();
}

/// A sphere around a triangle, which knows at a glance that a spot takes nothing or all of it.
struct Enclosed {
  Vec3 middle;
  double reach;  // [m]
  double force;  // ∫ p dA [N]

  explicit Enclosed(const PressedTriangle& triangle)
      : middle(triangle.x.rowwise().mean()),
        reach(std::sqrt((triangle.x.colwise() - middle).colwise().squaredNorm().maxCoeff())),
        force(0.5 * triangle.p.mean() *
              (triangle.x.col(1) - triangle.x.col(0))
                  .cross(triangle.x.col(2) - triangle.x.col(0))
                  .norm()) {}

  /// Whether anything of the triangle may lie nearer to c than r.
  bool is_near(const Vec3& c, double r) const {
    return (middle - c).squaredNorm() < (r + reach) * (r + reach);
  }
  bool is_within(const Vec3& c, double r) const {
    return reach < r && (middle - c).squaredNorm() < (r - reach) * (r - reach);
  }
};

/// Points of surfaces, at most one in each cube of a grid.
class Sampling {
 public:
  explicit Sampling(double spacing) : spacing_(spacing) {}

  /// Of the triangle, as long as it has parts within a distance of the centre.
  void add(const Mat3& x, const Vec3& center, double within) {
    if (!Enclosed({x, Vec3::Zero()}).is_near(center, within)) return;
    int longest = 0;  // edge, opposite that corner
    double length = 0;
    for (int k = 0; k < 3; ++k)
      if (const double edge = (x.col((k + 2) % 3) - x.col((k + 1) % 3)).norm(); edge > length) {
        longest = k;
        length = edge;
      }
    if (!(length > spacing_)) return keep(x.rowwise().mean());
    const Vec3 middle = 0.5 * (x.col((longest + 1) % 3) + x.col((longest + 2) % 3));
    for (const int replaced : {1, 2}) {
      Mat3 half = x;
      half.col((longest + replaced) % 3) = middle;
      add(half, center, within);
    }
  }
  const std::vector<Vec3>& points() const { return points_; }

 private:
  void keep(const Vec3& point) {
    std::array<double, 3> cube;
    for (int i = 0; i < 3; ++i) cube[static_cast<std::size_t>(i)] = std::floor(point[i] / spacing_);
    if (cubes_.insert(cube).second) points_.push_back(point);
  }

  double spacing_;
  std::set<std::array<double, 3>> cubes_;
  std::vector<Vec3> points_;
};

/// The patch's part of the surface as a fan of triangles, with pressures that make the force q.
void add_patch(const ContactPatch& patch, const Mat3& corners, const Vec3& p, double q,
               std::vector<PressedTriangle>& triangles) {
  const TrianglePolygon polygon = covered_polygon(patch);
  const auto at = [&](int k) -> const Vec3& { return polygon.corner[static_cast<std::size_t>(k)]; };
  const auto pressure = [&](const Vec3& N) {
    return std::max(0.0, p.dot(N) * (patch.fade > 0 ? patch.depth.dot(N) / patch.fade : 1));
  };
  const std::size_t begin = triangles.size();
  double sum = 0;
  for (int k = 1; k + 1 < polygon.count; ++k) {
    PressedTriangle triangle;
    const std::array<const Vec3*, 3> N = {&at(0), &at(k), &at(k + 1)};
    for (int i = 0; i < 3; ++i) {
      const Vec3& corner = *N[static_cast<std::size_t>(i)];
      triangle.x.col(i) = corners * corner;
      triangle.p[i] = pressure(corner);
    }
    const auto& x = triangle.x;
    sum += 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() * triangle.p.mean();
    triangles.push_back(triangle);
  }
  for (std::size_t k = begin; k < triangles.size(); ++k) triangles[k].p *= sum > 0 ? q / sum : 0;
}

/// Forces through spots of one size.
class Spots {
 public:
  Spots(const std::vector<PressedTriangle>& triangles, double r)
      : triangles_(triangles), enclosed_(triangles.begin(), triangles.end()), r_(r) {}

  /// ∫ p dA within r of c [N]; 0 where all triangles near it have no more than `enough` together:
  /// most of them need not be cut then.
  double force(const Vec3& c, double enough) {
    near_.clear();
    double all = 0;
    for (std::size_t k = 0; k < enclosed_.size(); ++k)
      if (enclosed_[k].is_near(c, r_)) {
        near_.push_back(k);
        all += enclosed_[k].force;
      }
    if (!(all > enough)) return 0;
    double sum = 0;
    for (const std::size_t k : near_)
      sum +=
          enclosed_[k].is_within(c, r_) ? enclosed_[k].force : force_within(triangles_[k], c, r_);
    return sum;
  }

 private:
  const std::vector<PressedTriangle>& triangles_;
  std::vector<Enclosed> enclosed_;
  double r_;
  std::vector<std::size_t> near_;
};

}  // namespace

void add_pressed_triangles(const Model& model, const ContactResponse& response,
                           const Configuration& configuration, ContactId contact, int body,
                           const std::vector<char>& selected,
                           std::vector<PressedTriangle>& triangles) {
  for (const ContactPairState* pair_state : response.pair_states()) {
    if (pair_state->contact != contact) continue;
    const ContactSides side = sides_of(model, *pair_state);
    const auto& groups = side.triangles.groups;
    for (const ContactPairState::Patch& entry : pair_state->patches()) {
      if (!carries(*pair_state, entry.triangle, groups)) continue;
      if (!is_selected(side, entry, body, selected)) continue;
      const Vec3 q = pressure_integrals(*pair_state, entry, groups);
      if (!(q.sum() > 0)) continue;
      const Vec3 p = pair_state->point_stiffness > 0
                         ? Vec3(pair_state->point_stiffness * entry.patch.depth)
                         : Vec3(pair_state->pressure(groups.col(entry.triangle)));
      add_patch(entry.patch, corners_of(configuration, side.triangles, entry.triangle), p, q.sum(),
                triangles);
    }
  }
}

double force_within(const std::vector<PressedTriangle>& triangles, const Vec3& c, double r) {
  return Spots(triangles, r).force(c, 0);
}

double largest_spot_pressure(const std::vector<PressedTriangle>& triangles, double r) {
  Spots spots(triangles, r);
  Vec3 best = Vec3::Zero();
  double largest = 0, within = std::numeric_limits<double>::infinity();
  for (const double spacing : {r / 2, r / 8, r / 32}) {
    const Vec3 center = best;
    Sampling sampling(spacing);
    for (const PressedTriangle& triangle : triangles) sampling.add(triangle.x, center, within);
    for (const Vec3& c : sampling.points())
      if (const double force = spots.force(c, largest); force > largest) {
        largest = force;
        best = c;
      }
    within = spacing;
  }
  return largest / (std::numbers::pi * r * r);
}

}  // namespace articular::sim
