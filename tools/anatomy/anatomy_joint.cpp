#include "tools/anatomy/anatomy_joint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "tools/anatomy/anatomy_grid.hpp"
#include "tools/anatomy/anatomy_solids.hpp"

namespace articular::anatomy {
namespace {

constexpr double kRoofRadius = 6;       // concave
constexpr double kCrestRadius = 7;      // convex
constexpr double kSlopeDistance = 6.3;  // condyle centre to slope: head + 1.3 mm of disc
constexpr double kRoofShift = 2.35;     // end of the roof arc above the point nearest to the head
constexpr double kWallDeg = 75;         // postglenoid wall to the horizontal
constexpr double kWallLength = 4;
// Beyond 57 degrees roof and crest alone are higher than the eminence; below 30 the disc is too
// thin.
constexpr double kLeastSlopeDeg = 30, kMostSlopeDeg = 55;
constexpr double kAnteriorDeg = 3;  // rise of the preglenoid plane before the crest
constexpr double kAnteriorLength = 15;
constexpr double kHeadExponent = 2.5;       // superellipse of the head in the frontal plane
constexpr double kTroughCurvature = 0.018;  // [1/mm] fossa_drop = this * x²
constexpr double kFossaHalfWidth = 13;      // lateral; the medial wall is nearer
constexpr double kMedialWallDeg = 8;        // to the sagittal plane: it recedes forwards
constexpr double kMedialWallHeight = 7;
constexpr double kMedialWallEnd = 6;  // of the preglenoid plane: there it has run out

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
/// Downwards for a forward heading: into the joint.
Vec2 inward(double heading) { return {std::sin(heading), -std::cos(heading)}; }

Vec2 point_on(const ProfilePiece& p, double s) {
  if (p.curvature == 0) return p.start + s * direction(p.heading);
  const double r = 1 / p.curvature;
  return p.start - r * inward(p.heading) + r * inward(p.heading + s * p.curvature);
}

/// Signed distance of q from one piece, > 0 on the joint's side.
double signed_distance(const ProfilePiece& p, const Vec2& q) {
  double s = 0;
  if (p.curvature == 0) {
    s = std::clamp((q - p.start).dot(direction(p.heading)), 0.0, p.length);
  } else {
    const double r = 1 / p.curvature;
    const Vec2 radial = (q - (p.start - r * inward(p.heading))) * (r > 0 ? 1 : -1);
    const double heading = std::atan2(radial.x(), -radial.y());
    s = std::clamp((heading - p.heading) / p.curvature, 0.0, p.length);
  }
  const Vec2 to_q = q - point_on(p, s);
  return std::copysign(to_q.norm(), to_q.dot(inward(p.heading + s * p.curvature)));
}

double fossa_drop(double x) { return kTroughCurvature * x * x; }

/// Where the medial wall stands, `forward` of the condyle centre: its distance from the middle.
double medial_wall(double forward) {
  return kMedialWall + std::tan(kMedialWallDeg * kDeg) * std::max(forward, 0.0);
}

/// The same for a point of the profile, which the trough of the fossa shifts along `normal`.
double medial_wall(const Vec2& on_profile, const Vec2& normal) {
  double wall = medial_wall(on_profile.x());
  for (int i = 0; i < 5; ++i)  // converges a hundredfold each time
    wall = medial_wall(on_profile.x() + fossa_drop(wall) * normal.x());
  return wall;
}

/// Its height along the profile, `s` from the start of a piece: full from the roof to the crest,
/// nothing behind.
double medial_wall_height(std::size_t piece, double s) {
  if (piece < 4) return kMedialWallHeight;
  return kMedialWallHeight * std::max(0.0, 1 - s / kMedialWallEnd);
}

/// Signed distance of p from the medial wall, > 0 in the joint, where that is less than `below`;
/// else that. The wall hangs from the profile, and its plane is nowhere farther than it is.
double lesser_distance(double below, const Vec3& p, const FossaProfile& fossa) {
  const double forward = -p.y();
  const double to_plane = (p.x() + medial_wall(forward)) * std::cos(kMedialWallDeg * kDeg);
  if (to_plane >= below) return below;
  for (std::size_t i = 1; i < fossa.size(); ++i) {
    const ProfilePiece& piece = fossa[i];
    if (forward < piece.start.x() || forward > point_on(piece, piece.length).x()) continue;
    double low = 0, high = piece.length;  // forward grows along the piece
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (point_on(piece, middle).x() < forward ? low : high) = middle;
    }
    const double bottom =
        point_on(piece, low).y() - fossa_drop(medial_wall(forward)) - medial_wall_height(i, low);
    return std::min(below, std::max(to_plane, bottom - p.z()));
  }
  return std::min(below,
                  std::abs(to_plane) + kMedialWallHeight);  // before and behind there is none
}

/// Radius of the disc's lower surface: the head's as far as the disc rests on it, then bending
/// outwards: the rim hangs freely beside the pole.
double disc_lower_radius(double x) {
  constexpr double kFollow = 6.5;  // |x| up to which the disc follows the head
  const double ax = std::abs(x);
  if (ax <= kFollow) return condyle_radius(ax);
  constexpr double kStep = 1e-4;  // difference quotient [mm]
  const double slope = (condyle_radius(kFollow) - condyle_radius(kFollow - kStep)) / kStep;
  const double beyond = ax - kFollow, range = kDiscHalfWidth - kFollow;
  return condyle_radius(kFollow) + slope * (beyond - beyond * beyond / (2 * range));
}

/// A point of the fossa at the length s of a piece of its profile.
/// @param across  -1 at the medial wall, 0 in the middle, 1 at the lateral rim
Vec3 fossa_point(const ProfilePiece& piece, double s, double across) {
  const Vec2 on_profile = point_on(piece, s), normal = inward(piece.heading + s * piece.curvature);
  const double x = across * (across < 0 ? medial_wall(on_profile, normal) : kFossaHalfWidth);
  const Vec2 q = on_profile + fossa_drop(x) * normal;
  return kCondyle + Vec3(x, -q.x(), q.y());
}

int num_segments(const ProfilePiece& piece, double h) {
  return std::max(1, static_cast<int>(std::lround(piece.length / h)));
}

/// Points of the whole profile, from behind, with edges of length h.
std::vector<Vec3> fossa_row(const FossaProfile& fossa, double h, double across) {
  std::vector<Vec3> row;
  for (std::size_t i = 0; i < fossa.size(); ++i) {
    const int segments = num_segments(fossa[i], h);
    for (int k = i == 0 ? 0 : 1; k <= segments; ++k)
      row.push_back(fossa_point(fossa[i], fossa[i].length * k / segments, across));
  }
  return row;
}

/// Points on the medial wall, from the roof as far as it goes.
/// @param below  0 at the profile, 1 at the wall's lower edge
std::vector<Vec3> medial_wall_row(const FossaProfile& fossa, double h, double below) {
  std::vector<Vec3> row;
  for (std::size_t i = 1; i < fossa.size(); ++i) {
    const int segments = num_segments(fossa[i], h);
    for (int k = i == 1 ? 0 : 1; k <= segments; ++k) {
      const double s = fossa[i].length * k / segments, height = medial_wall_height(i, s);
      if (height > 0) row.push_back(fossa_point(fossa[i], s, -1) - below * height * Vec3::UnitZ());
    }
  }
  return row;
}

/// Inner and outer radius of the disc on the ray at `angle` from the vertical (> 0 forward) in the
/// sagittal plane at x.
/// @param rim  0 in the middle of the disc, 1 at its outline
std::pair<double, double> disc_radii(const FossaProfile& fossa, double angle, double x,
                                     double rim) {
  constexpr double kSteep = 1e-4;
  const double dr =
      (disc_lower_radius(std::abs(x) + kSteep) - disc_lower_radius(std::abs(x))) / kSteep;
  const double inner = disc_lower_radius(x) + kLowerClearance * std::sqrt(1 + dr * dr);
  const Vec2 ray = direction(std::numbers::pi / 2 - angle);
  double low = inner, high = inner + 6;
  for (int i = 0; i < 60; ++i) {  // bisection to round-off: the distance falls along the ray
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    const Vec2 q = middle * ray;
    (distance_below_fossa({x, -q.x(), q.y()}, fossa) > kUpperClearance ? low : high) = middle;
  }
  // Bands: 3 mm behind, 2 mm in front, less at the rim. Where the gap is narrower, the gap decides.
  const double forward = 0.5 * (1 + std::tanh((angle - 20 * kDeg) / (12 * kDeg)));
  const double band = 3.3 + forward * (2.3 - 3.3), edge = 1.5 + forward * (1.4 - 1.5);
  const double thickness = edge + (band - edge) * std::sqrt(1 - std::pow(std::min(rim, 1.0), 4));
  return {inner, inner + smooth_min(low - inner, thickness, 0.15)};
}

Mesh to_mesh(const std::vector<Vec3>& nodes, const std::vector<Eigen::Vector3i>& triangles) {
  Mesh mesh;
  mesh.X_mm.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    mesh.X_mm.col(static_cast<Eigen::Index>(i)) = nodes[i];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

}  // namespace

double condyle_radius(double x) {
  const double t = std::min(std::abs(x) / kCondyleHalfWidth, 1.0);
  return kCondyleRadius * std::pow(1 - std::pow(t, kHeadExponent), 1 / kHeadExponent);
}

FossaProfile fossa_profile(double slope_deg) {
  if (!(slope_deg >= kLeastSlopeDeg && slope_deg <= kMostSlopeDeg))
    throw std::invalid_argument("--slope: " + std::to_string(slope_deg) +
                                " degrees: expected 30 to 55");
  const double slope = slope_deg * kDeg;
  const double straight =
      (kEminenceHeight - (kRoofRadius + kCrestRadius) * (1 - std::cos(slope))) / std::sin(slope);
  // The slope is known: it passes the head at kSlopeDistance. Everything else is chained to it.
  const Vec2 slope_start = -kSlopeDistance * inward(-slope) - kRoofShift * direction(-slope);
  const Vec2 roof_center = slope_start + kRoofRadius * inward(-slope);
  const Vec2 roof_start = roof_center - kRoofRadius * inward(kWallDeg * kDeg);
  FossaProfile chain = {{
      {roof_start - kWallLength * direction(kWallDeg * kDeg), kWallDeg * kDeg, 0, kWallLength},
      {roof_start, kWallDeg * kDeg, -1 / kRoofRadius, kRoofRadius * (kWallDeg * kDeg + slope)},
      {slope_start, -slope, 0, straight},
      {Vec2::Zero(), -slope, 1 / kCrestRadius, kCrestRadius * (slope + kAnteriorDeg * kDeg)},
      {Vec2::Zero(), kAnteriorDeg * kDeg, 0, kAnteriorLength},
  }};
  chain[3].start = point_on(chain[2], chain[2].length);
  chain[4].start = point_on(chain[3], chain[3].length);
  return chain;
}

const FossaProfile& usual_fossa() {
  static const FossaProfile usual = fossa_profile(kSlopeDeg);
  return usual;
}

double distance_below_fossa(const Vec3& p, const FossaProfile& fossa) {
  const Vec2 q(-p.y(), p.z());
  double nearest = signed_distance(fossa[0], q);
  for (const ProfilePiece& piece : fossa) {
    const double d = signed_distance(piece, q);
    if (std::abs(d) < std::abs(nearest)) nearest = d;
  }
  return lesser_distance(nearest - fossa_drop(p.x()), p, fossa);
}

void stitch(const std::vector<int>& a, const std::vector<int>& b, const std::vector<Vec3>& nodes,
            std::vector<Eigen::Vector3i>& triangles) {
  const auto at = [&nodes](int i) -> const Vec3& { return nodes[static_cast<std::size_t>(i)]; };
  std::size_t i = 0, j = 0;
  while (i + 1 < a.size() || j + 1 < b.size()) {
    const bool advance_a =
        j + 1 == b.size() || (i + 1 < a.size() && (at(a[i + 1]) - at(b[j])).squaredNorm() <=
                                                      (at(b[j + 1]) - at(a[i])).squaredNorm());
    if (advance_a) {
      triangles.emplace_back(a[i], a[i + 1], b[j]);
      ++i;
    } else {
      triangles.emplace_back(a[i], b[j + 1], b[j]);
      ++j;
    }
  }
}

Mesh condyle_sheet(double h) {
  constexpr double kBack = -85 * kDeg, kFront = 110 * kDeg;
  // Rows x = const, spaced evenly along the frontal outline from pole to pole.
  std::vector<double> xs, arc;
  constexpr int kFine = 4000;
  double length = 0;
  for (int i = 0; i <= kFine; ++i) {
    const double x = -kCondyleHalfWidth * std::cos(std::numbers::pi * i / kFine);
    if (i > 0) length += std::hypot(x - xs.back(), condyle_radius(x) - condyle_radius(xs.back()));
    xs.push_back(x);
    arc.push_back(length);
  }
  const int num_rows = 2 * static_cast<int>(std::lround(length / h / 2));
  std::vector<Vec3> nodes;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> previous;
  for (int row = 0; row <= num_rows; ++row) {
    double x = row == 0 ? -kCondyleHalfWidth : kCondyleHalfWidth;
    if (row > 0 && row < num_rows) {
      const auto it = std::lower_bound(arc.begin(), arc.end(), length * row / num_rows);
      x = xs[static_cast<std::size_t>(it - arc.begin())];
    }
    if (2 * row == num_rows) x = 0;
    const double r = condyle_radius(x);
    const int segments = static_cast<int>(std::lround(r * (kFront - kBack) / h));
    std::vector<int> current;
    for (int i = 0; i <= segments; ++i) {
      const double angle = segments == 0 ? 0 : kBack + (kFront - kBack) * i / segments;
      current.push_back(static_cast<int>(nodes.size()));
      nodes.emplace_back(kCondyle + Vec3(x, -r * std::sin(angle), r * std::cos(angle)));
    }
    if (row > 0) stitch(previous, current, nodes, triangles);
    previous = current;
  }
  return to_mesh(nodes, triangles);
}

Mesh fossa_sheet(double h, const FossaProfile& fossa) {
  const int medial = static_cast<int>(std::lround(kMedialWall / h)),
            lateral = static_cast<int>(std::lround(kFossaHalfWidth / h)),
            down = static_cast<int>(std::lround(kMedialWallHeight / h));
  std::vector<Vec3> nodes;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<int> previous;
  // From the lower edge of the medial wall up to the profile, then along it to the lateral rim.
  for (int row = -medial - down; row <= lateral; ++row) {
    const std::vector<Vec3> points =
        row < -medial
            ? medial_wall_row(fossa, h, static_cast<double>(-medial - row) / down)
            : fossa_row(fossa, h, static_cast<double>(row) / (row < 0 ? medial : lateral));
    std::vector<int> current(points.size());
    std::iota(current.begin(), current.end(), static_cast<int>(nodes.size()));
    nodes.insert(nodes.end(), points.begin(), points.end());
    if (!previous.empty()) stitch(current, previous, nodes, triangles);
    previous = current;
  }
  return to_mesh(nodes, triangles);
}

Mesh disc(double h, const FossaProfile& fossa) {
  if (!(h >= 0.3 && h <= 2.5))
    throw std::invalid_argument("--size: element size " + std::to_string(h) +
                                " mm: expected 0.3 to 2.5 mm");
  constexpr double kMiddle = 23 * kDeg;  // -46 to 92 degrees about the head
  constexpr double kHalfAngle = 69 * kDeg;
  constexpr double kArc = 14.3;       // length of that along the mid-surface [mm]
  constexpr double kThickness = 2.4;  // that gives two layers at 1.2 mm
  constexpr double kRound = 0.7;      // outline: 0 rectangle, 1 ellipse
  constexpr double kZoneBegin = 10 * kDeg, kZoneEnd = 65 * kDeg;  // between the bands
  const CellGrid grid{even_cells(2 * kDiscHalfWidth, h, 4), even_cells(kArc, h, 4),
                      std::max(1, static_cast<int>(std::lround(kThickness / h)))};
  const auto angle_at = [](double u, double v) {
    return kMiddle + kHalfAngle * v * std::sqrt(1 - kRound * u * u / 2);
  };
  const auto place = [&](double u, double v, double w) -> Vec3 {
    const double x = kDiscHalfWidth * u * std::sqrt(1 - kRound * v * v / 2);
    const double angle = angle_at(u, v);
    const auto [inner, outer] = disc_radii(fossa, angle, x, std::max(std::abs(u), std::abs(v)));
    const double r = inner + (outer - inner) * w;
    return kCondyle + Vec3(x, -r * std::sin(angle), r * std::cos(angle));
  };
  Mesh mesh = grid.fill(place);
  const Mesh unbent = grid.fill([](double u, double v, double w) { return Vec3(u, v, w); });
  mesh.fibres.resize(3, mesh.tets.cols());
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
    const Vec3 q = unbent.X_mm(Eigen::all, unbent.tets.col(e)).rowwise().mean();
    const double angle = angle_at(q.x(), q.y());
    const bool in_zone = angle > kZoneBegin && angle < kZoneEnd;
    constexpr double kStep = 1e-3;  // half a difference quotient
    const double du = in_zone ? 0 : kStep, dv = in_zone ? kStep : 0;
    mesh.fibres.col(e) =
        (place(q.x() + du, q.y() + dv, q.z()) - place(q.x() - du, q.y() - dv, q.z())).normalized();
  }
  return mesh;
}

Mesh mirrored(const Mesh& mesh) {
  Mesh m = mesh;
  m.X_mm.row(0) *= -1;
  if (m.fibres.cols() > 0) m.fibres.row(0) *= -1;
  if (m.tets.cols() > 0) m.tets.row(2).swap(m.tets.row(3));
  if (m.triangles.cols() > 0) m.triangles.row(1).swap(m.triangles.row(2));
  return m;
}

}  // namespace articular::anatomy
