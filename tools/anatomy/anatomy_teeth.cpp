#include "tools/anatomy/anatomy_teeth.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tools/anatomy/anatomy_bones.hpp"

namespace articular::anatomy {
namespace {

/// What a section across the arch is made of [mm, degrees].
struct ToothSection {
  double guiding_deg;  // of the incline from E outwards
  double cusp_deg;     // of the walls of the fossa
  double half_width;   // from a lower tip to the fossa
  double tip;          // half the width of flat tips
  double overbite;
  double drop;      // of the lower tips below the occlusal level: 0 on a cusp, most between cusps
  double notch;     // 0 in the middle of a tooth, 1 between two teeth
  double backness;  // 0 front teeth, 1 back teeth
};

struct Tooth {
  double width;  // along the arch
  int pieces;    // of the mesh, along the arch: each tip is a row of nodes
  int tips;      // outer ones, along the arch; 0: a straight edge
};

/// Lower teeth of a side, from the central incisor to the second molar; widths as in the bones.
constexpr std::array<Tooth, 7> kTeeth = {
    {{5.4, 4, 0}, {5.9, 4, 0}, {6.9, 4, 0}, {7.0, 4, 1}, {7.2, 4, 1}, {11, 8, 2}, {10.6, 8, 2}}};

// Along the arch: the middle of the central incisor, and the front part of the lateral one. A
// lateral incisor that is steeper than the canine would guide to the side in its place.
constexpr double kSteepTo = 2.7, kFlatterFrom = 6.6;
constexpr double kBackFrom = 16.5, kBackAt = 21.7;  // behind the canine; middle of a premolar
constexpr double kEdge = 1.8;        // from the arch outwards to E: the incisor edge is at kIncisor
constexpr double kFillet = 0.35;     // width of the facet that halves a corner
constexpr double kCuspDrop = 0.4;    // of lower tips between two cusps
constexpr double kNotchDepth = 0.5;  // of outer walls between two teeth
constexpr double kLowerPart = 0.4;   // of the guiding incline is a face of the lower tooth too

/// 0 up to a, 1 from b on, without kinks.
double smooth_step(double a, double b, double s) {
  const double t = std::clamp((s - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double mix(double front, double back, double t) { return front + t * (back - front); }

/// Where a station is in its tooth.
struct InTooth {
  Tooth tooth;
  double part;  // of its width, from its front
};

InTooth in_tooth(double s) {
  double begin = 0;
  for (const Tooth& tooth : kTeeth) {
    if (s <= begin + tooth.width) return {tooth, (s - begin) / tooth.width};
    begin += tooth.width;
  }
  return {kTeeth.back(), 1};
}

/// @param s  along the lower arch from the midline
ToothSection tooth_section(double s, double guidance_deg) {
  const auto [tooth, part] = in_tooth(s);
  const double back = smooth_step(kBackFrom, kBackAt, s);
  const double front_deg =
      guidance_deg -
      kCanineLessDeg * std::clamp((s - kSteepTo) / (kFlatterFrom - kSteepTo), 0.0, 1.0);
  ToothSection section{};
  section.guiding_deg = mix(front_deg, kCuspDeg, back);
  section.cusp_deg = mix(0, kCuspDeg, back);
  section.half_width = mix(0.7, 3, back);
  section.tip = mix(0.2, 0.4, back);
  section.overbite = mix(kOverbite, kBackOverbite, back);
  section.drop = tooth.tips == 0 ? 0
                                 : back * kCuspDrop *
                                       (1 + std::cos(2 * std::numbers::pi * tooth.tips * part)) / 2;
  section.notch = std::pow(2 * part - 1, 4);
  section.backness = back;
  return section;
}

/// Across the arch: outwards from its middle, up from the occlusal level.
using Outline = std::vector<Vec2>;

/// The surface at which the rows meet, from the lower lingual tip to the upper outer tip. Each row
/// has a part of it.
constexpr std::size_t kUpperBegin = 2;  // in the wall of the fossa
constexpr std::size_t kLowerEnd = 9;    // on the guiding incline

Outline shared_outline(const ToothSection& section) {
  const double w = section.half_width, r = section.tip, top = -section.drop;
  const double depth = -(w - 2 * r) * std::tan(section.cusp_deg * kDeg);
  const double a = kEdge - 2 * w, c = kEdge - w;
  const double fillet_drop = kFillet * std::tan(section.guiding_deg * kDeg / 2);
  const double down = section.overbite - 2 * fillet_drop;
  const Vec2 guide(kEdge + r + kFillet, top - fillet_drop);
  const Vec2 incline(down / std::tan(section.guiding_deg * kDeg), -down);
  const Vec2 outer_tip = guide + incline + Vec2(kFillet, -fillet_drop);
  return {{a - r, top},
          {a + r, top},
          {a + w / 2, (top + depth) / 2},
          {c - r, depth},
          {c + r, depth},
          {c + w / 2, (top + depth) / 2},
          {kEdge - r, top},
          {kEdge + r, top},
          guide,
          guide + kLowerPart * incline,
          guide + 0.7 * incline,
          guide + incline,
          outer_tip,
          outer_tip + Vec2(2 * r, 0)};
}

/// Steps from the end of the shared surface on, down or up into the bone.
using Wall = std::array<Vec2, 3>;

Outline wall(const Vec2& from, const ToothSection& section, const Wall& front, const Wall& back,
             double notch_depth) {
  Outline points;
  for (std::size_t i = 0; i < front.size(); ++i)
    points.push_back(from + (1 - section.backness) * front[i] + section.backness * back[i] -
                     Vec2(notch_depth * section.notch, 0));
  return points;
}

/// A closed outline in the order of shared_outline(): along the inner wall to the shared surface,
/// and back along the outer wall.
Outline closed(Outline inner, const Outline& shared, const Outline& outer) {
  std::reverse(inner.begin(), inner.end());
  inner.insert(inner.end(), shared.begin(), shared.end());
  inner.insert(inner.end(), outer.begin(), outer.end());
  inner.push_back((inner.front() + inner.back()) / 2);  // in the bone
  return inner;
}

Outline lower_outline(const ToothSection& section) {
  const Outline all = shared_outline(section);
  const Outline shared(all.begin(), all.begin() + kLowerEnd + 1);
  const Wall lingual_front = {Vec2(-0.5, -1.2), Vec2(-1.6, -4), Vec2(-2.2, -7)};
  const Wall lingual_back = {Vec2(-0.5, -1.2), Vec2(-0.8, -4), Vec2(-0.8, -7)};
  const Wall outer = {Vec2(0.3, -1.2), Vec2(0.6, -4), Vec2(0.6, -7)};
  return closed(wall(shared.front(), section, lingual_front, lingual_back, 0), shared,
                wall(shared.back(), section, outer, outer, kNotchDepth));
}

Outline upper_outline(const ToothSection& section) {
  const Outline all = shared_outline(section);
  Outline shared(all.begin() + kUpperBegin, all.end());
  for (Vec2& point : shared) point.y() += kOcclusalGap;
  const Wall palatal_front = {Vec2(-0.9, 1.2), Vec2(-2.2, 4), Vec2(-2.6, 7)};
  const Wall palatal_back = {Vec2(-0.3, 1.2), Vec2(-0.9, 4), Vec2(-1.0, 7)};
  const Wall outer = {Vec2(0.3, 1.0), Vec2(0.8, 4), Vec2(0.6, 8)};
  return closed(wall(shared.front(), section, palatal_front, palatal_back, 0), shared,
                wall(shared.back(), section, outer, outer, kNotchDepth));
}

/// Stations along the arch from the midline, one side.
std::vector<double> stations() {
  std::vector<double> result = {0};
  double begin = 0;
  for (const Tooth& tooth : kTeeth) {
    for (int i = 1; i <= tooth.pieces; ++i)
      result.push_back(begin + tooth.width * i / tooth.pieces);
    begin += tooth.width;
  }
  return result;
}

/// |x| of the points of arch_point() at these lengths along it.
std::vector<double> places_along_arch(const std::vector<double>& lengths) {
  constexpr double kEnd = 27;
  constexpr int kSteps = 5400;
  std::vector<double> result;
  double length = 0;
  int step = 0;
  for (const double wanted : lengths) {
    while (length < wanted && step < kSteps) {
      length += (arch_point(kEnd * (step + 1) / kSteps) - arch_point(kEnd * step / kSteps)).norm();
      ++step;
    }
    result.push_back(kEnd * step / kSteps);
  }
  return result;
}

/// Level, across the arch.
Vec3 outwards(double x) {
  if (x == 0) return -Vec3::UnitY();
  constexpr double kStep = 0.01;
  const Vec3 along = arch_point(x + kStep) - arch_point(x - kStep);
  return along.cwiseProduct(Vec3(1, 1, 0)).normalized().cross(Vec3::UnitZ());
}

/// The outlines of all stations, from the right end to the left one; columns of one station lie
/// together.
Positions swept(const std::function<Outline(const ToothSection&)>& outline, double guidance_deg) {
  const std::vector<double> lengths = stations(), places = places_along_arch(lengths);
  const auto half = static_cast<Eigen::Index>(lengths.size()) - 1;
  Positions X;
  for (Eigen::Index i = 0; i <= half; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Outline points = outline(tooth_section(lengths[at], guidance_deg));
    const auto n = static_cast<Eigen::Index>(points.size());
    if (i == 0) X.resize(3, (2 * half + 1) * n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Vec2& point = points[static_cast<std::size_t>(k)];
      const Vec3 p =
          arch_point(places[at]) + point.x() * outwards(places[at]) + point.y() * Vec3::UnitZ();
      X.col((half + i) * n + k) = p;
      X.col((half - i) * n + k) = p.cwiseProduct(Vec3(-1, 1, 1));
    }
  }
  return X;
}

/// Triangles of a tube with closed ends. Rings run about the direction of the tube by the
/// right-hand rule.
Mesh capped_tube(const Positions& rings, Eigen::Index ring_size) {
  const auto n = static_cast<int>(ring_size);
  const int count = static_cast<int>(rings.cols()) / n;
  Mesh mesh;
  mesh.X_mm.resize(3, rings.cols() + 2);
  mesh.X_mm.leftCols(rings.cols()) = rings;
  for (const int end : {0, 1}) {  // summed one by one: the same bits on both sides
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < n; ++k) sum += rings.col(end * (count - 1) * n + k);
    mesh.X_mm.col(rings.cols() + end) = sum / n;
  }
  mesh.triangles.resize(3, 2 * n * count);
  Eigen::Index e = 0;
  const auto add = [&](int a, int b, int c) { mesh.triangles.col(e++) = Eigen::Vector3i(a, b, c); };
  for (int i = 0; i + 1 < count; ++i)
    for (int k = 0; k < n; ++k) {
      const int next = (k + 1) % n;
      const int a = i * n + k, b = i * n + next, c = a + n, d = b + n;
      if (2 * i + 1 < count) {  // diagonals mirror about the middle ring
        add(a, b, d);
        add(a, d, c);
      } else {
        add(a, b, c);
        add(b, d, c);
      }
    }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n, last = (count - 1) * n;
    add(count * n, next, k);
    add(count * n + 1, last + k, last + next);
  }
  return mesh;
}

Mesh row(const std::function<Outline(const ToothSection&)>& outline, double guidance_deg,
         bool upper) {
  if (!(guidance_deg >= 40 && guidance_deg <= 65))
    throw std::invalid_argument(
        fmt::format("--guidance: {}: expected 40 to 65 degrees", guidance_deg));
  const auto ring_size = static_cast<Eigen::Index>(outline(tooth_section(0, guidance_deg)).size());
  Mesh mesh = capped_tube(swept(outline, guidance_deg), ring_size);
  // Outlines run outwards over the lower tooth, and outwards under the upper one.
  if (upper) mesh.triangles.row(1).swap(mesh.triangles.row(2));
  return mesh;
}

}  // namespace

Mesh lower_guiding_teeth(double guidance_deg) { return row(lower_outline, guidance_deg, false); }
Mesh upper_guiding_teeth(double guidance_deg) { return row(upper_outline, guidance_deg, true); }

}  // namespace articular::anatomy
