#include "sim/wrap/penetration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace articular::sim {
namespace {

/// A segment of the string and where its ends lie on surfaces.
struct Chord {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // [m]
  Vec3 along = Vec3::Zero();                    // unit vector
  double length = 0;                            // [m]
  StringEnd start, end;                         // the faces that it goes onto, and comes from
  int start_edge = -1, end_edge = -1;
};

Chord reversed(const Chord& c) {
  return {c.to, c.from, -c.along, c.length, c.end, c.start, c.end_edge, c.start_edge};
}

struct Hit {
  double s = 0;  // part of the segment
  int surface = -1, face = -1;
};

/// Where the segment meets a triangle, and whether it goes in or out [Möller and Trumbore 1997,
/// J. Graph. Tools 2:21]. Edges belong to both of their triangles.
bool meets(const PlacedSurface& placed, int face, const Vec3& a, const Vec3& d, double& s,
           bool& inward) {
  constexpr double kOnEdge = 1e-9;
  const auto corner = placed.surface->triangles.col(face);
  const Vec3 x0 = placed.X->col(corner[0]);
  const Vec3 e1 = placed.X->col(corner[1]) - x0, e2 = placed.X->col(corner[2]) - x0;
  const Vec3 p = d.cross(e2);
  const double det = e1.dot(p);
  if (det == 0) return false;
  const Vec3 r = a - x0;
  const double v = r.dot(p) / det;
  const Vec3 q = r.cross(e1);
  const double w = d.dot(q) / det;
  if (!(v >= -kOnEdge && w >= -kOnEdge && v + w <= 1 + kOnEdge)) return false;
  s = e2.dot(q) / det;
  inward = det > 0;  // det = −d·(e1 × e2)
  return true;
}

struct FirstHits {
  Hit in, out;  // the first inward one, and the next outward one of the same surface
};

/// Near an end that lies on a surface, whether the chord goes below it is asked there.
FirstHits first_hits(std::span<const PlacedSurface> surfaces, const Chord& chord, WrapWork& work) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  FirstHits hits;
  hits.in.s = hits.out.s = kInfinite;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const PlacedSurface& placed = surfaces[k];
    const auto index = static_cast<int>(k);
    const Vec3 a = placed.pose.R.transpose() * (chord.from - placed.pose.p);
    const Vec3 b = placed.pose.R.transpose() * (chord.to - placed.pose.p);
    placed.tree->find(a, b, kPenetration * placed.size, work.near);
    const double apart = 10 * kPenetration * placed.size / chord.length;
    const double low = chord.start.surface == index ? apart : 0;
    const double high = chord.end.surface == index ? 1 - apart : 1;
    double s = 0;
    bool inward = false;
    Hit in{kInfinite, index, -1}, out = in;
    for (const int face : work.near)
      if (meets(placed, face, a, b - a, s, inward) && inward && s > low && s < high && s < in.s)
        in = {s, index, face};
    for (const int face : work.near)
      if (meets(placed, face, a, b - a, s, inward) && !inward && s > in.s && s < 1 && s < out.s)
        out = {s, index, face};
    if (in.face >= 0 && in.s < hits.in.s) hits = {in, out};
  }
  return hits;
}

bool set_up(const Vec3& outward, ChordPlane& plane) {
  const Vec3 up = outward - plane.along * plane.along.dot(outward);
  const double length = up.norm();
  if (!(length > 1e-6 * outward.norm())) return false;
  plane.up = up / length;
  return true;
}

/// Over the surface from where the chord goes below it at its start. @return whether it does
bool from_start(std::span<const PlacedSurface> surfaces, const Chord& chord, WrapWork& work) {
  if (chord.start.face < 0) return false;
  const PlacedSurface& placed = surfaces[static_cast<std::size_t>(chord.start.surface)];
  const Vec3 n = placed.normal(chord.start.face);
  if (!(chord.along.dot(n) < 0)) return false;
  Vec3 outward = n;
  if (chord.start_edge >= 0) {
    const WrapEdge& edge = placed.surface->edges[static_cast<std::size_t>(chord.start_edge)];
    const int other = edge.face[edge.face[0] == chord.start.face ? 1 : 0];
    if (other >= 0) outward += placed.normal(other);
  }
  ChordPlane plane{chord.from, chord.along, Vec3::Zero()};
  if (!set_up(outward, plane) && !set_up(n, plane)) return false;
  const int target = chord.end.surface == chord.start.surface ? chord.end.face : -2;
  const WalkResult result =
      walk(placed, chord.start.surface, plane, {chord.start.face, chord.start_edge, chord.from},
           target, work.found);
  return result.found && result.depth > kPenetration * placed.size;
}

/// Over the surface from where the chord comes to it through the air, by the shortest of four ways.
bool from_air(std::span<const PlacedSurface> surfaces, const Chord& chord, WrapWork& work) {
  constexpr double kFar = 1e6;
  const FirstHits hits = first_hits(surfaces, chord, work);
  if (hits.in.face < 0) return false;
  const PlacedSurface& placed = surfaces[static_cast<std::size_t>(hits.in.surface)];
  Vec3 outward = placed.normal(hits.in.face);
  if (hits.out.face >= 0) outward += placed.normal(hits.out.face);
  ChordPlane plane{chord.from, chord.along, Vec3::Zero()};
  if (!set_up(outward, plane) && !set_up(placed.normal(hits.in.face), plane) &&
      !set_up(Vec3::UnitX(), plane))
    set_up(Vec3::UnitY(), plane);
  const Vec3 at = chord.from + hits.in.s * chord.length * chord.along;
  const int target = chord.end.surface == hits.in.surface ? chord.end.face : -2;
  // A plane that holds an edge of the first triangle may miss it: then one beside that.
  const double aside = 10 * kPenetration * placed.size;
  double least = std::numeric_limits<double>::infinity(), depth = 0;
  for (int k = 0; k < 4; ++k) {
    WalkResult result;
    for (const double shift : {0.0, aside, -aside}) {
      const ChordPlane shifted{plane.from + shift * plane.along.cross(plane.up), plane.along,
                               plane.up};
      result = walk(placed, hits.in.surface, shifted, {hits.in.face, -1, at}, target, work.found);
      if (result.found) break;
    }
    plane.up = plane.along.cross(plane.up);
    // Only where there is no other way: around the border of an open surface, or around what lies
    // before the chord goes in.
    const bool last_resort = result.to_border || result.to_behind;
    const double length = result.length + (last_resort ? kFar * placed.size : 0);
    if (!result.found || length >= least) continue;
    least = length;
    depth = result.depth;
    std::swap(work.best, work.found);
  }
  if (!(depth > kPenetration * placed.size)) return false;
  std::swap(work.best, work.found);
  return true;
}

/// The i-th segment; crossings i − 1 and i are at its ends.
Chord chord_of(std::span<const PlacedSurface> surfaces, const WrappedString& string,
               const StringShape& shape, std::size_t i) {
  const std::vector<EdgeCrossing>& c = string.crossings;
  Chord chord{shape.P[i], shape.P[i + 1], shape.u[i], shape.l[i], string.from, string.to, -1, -1};
  if (i > 0) {
    const WrapSurface& surface = *surfaces[static_cast<std::size_t>(c[i - 1].surface)].surface;
    chord.start = {chord.from, c[i - 1].surface, face_after(surface, c[i - 1])};
    chord.start_edge = c[i - 1].edge;
  }
  if (i < c.size()) {
    const WrapSurface& surface = *surfaces[static_cast<std::size_t>(c[i].surface)].surface;
    chord.end = {chord.to, c[i].surface, face_before(surface, c[i])};
    chord.end_edge = c[i].edge;
  }
  return chord;
}

bool lies_in_a_face(const Chord& chord) {
  return chord.start.face >= 0 && chord.start.surface == chord.end.surface &&
         chord.start.face == chord.end.face;
}

}  // namespace

bool lead_around(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work) {
  for (std::size_t i = 0; i <= string.crossings.size(); ++i) {
    const Chord chord = chord_of(surfaces, string, work.shape, i);
    if (!(chord.length > 0) || lies_in_a_face(chord)) continue;
    bool found = from_start(surfaces, chord, work);
    if (!found && from_start(surfaces, reversed(chord), work)) {
      turn_round(work.found);
      found = true;
    }
    if (!found) found = from_air(surfaces, chord, work);
    if (!found) continue;
    string.crossings.insert(string.crossings.begin() + static_cast<std::ptrdiff_t>(i),
                            work.found.begin(), work.found.end());
    return true;
  }
  return false;
}

}  // namespace articular::sim
