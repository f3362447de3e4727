#include "sim/gap/contact_patch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sim/gap/patch_motion.hpp"
#include "sim/gap/triangle_polygon.hpp"

namespace articular::sim {
namespace {

/// What bounds a part: there each χ >= 0. As PatchEdge has it.
struct Cut {
  PatchEdge::Kind kind;
  int index;
  bool is_end;
  Vec3 level;
};

struct Cuts {
  std::array<Cut, TrianglePolygon::kMaxCuts> cut;
  int count = 0;
  void add(PatchEdge::Kind kind, int index, bool is_end, const Vec3& level) {
    cut[static_cast<std::size_t>(count++)] = {kind, index, is_end, level};
  }
  std::span<const Cut> all() const { return {cut.data(), static_cast<std::size_t>(count)}; }
};

/// The polygon's edges inside the triangle, in units of its area.
void find_edges(const TrianglePolygon& polygon, const Cuts& cuts, ContactPatch& patch) {
  using End = PatchEdge::End;
  std::array<int, TrianglePolygon::kMaxCorners> number;     // of the edge, by side; -1: none
  std::array<int, TrianglePolygon::kMaxCuts> first_corner;  // of the side, by edge
  for (int k = 0; k < polygon.count; ++k) {
    const int side = polygon.side[static_cast<std::size_t>(k)];
    number[static_cast<std::size_t>(k)] = -1;
    if (side < 0 || patch.num_edges == std::ssize(patch.edge)) continue;
    const Cut& cut = cuts.all()[static_cast<std::size_t>(side)];
    // 1/|∇χ| is the distance of a point from the edge by its χ: of the corner farthest off.
    Eigen::Index far = 0;
    const double level = cut.level.cwiseAbs().maxCoeff(&far);
    if (!(level > 0)) continue;
    const int after = k + 1 == polygon.count ? 0 : k + 1;
    PatchEdge& edge = patch.edge[static_cast<std::size_t>(patch.num_edges)];
    edge.kind = cut.kind;
    edge.index = cut.index;
    edge.is_end = cut.is_end;
    edge.level = cut.level;
    edge.a = polygon.corner[static_cast<std::size_t>(k)];
    edge.b = polygon.corner[static_cast<std::size_t>(after)];
    const Vec3 along = edge.b - edge.a, off = Vec3::Unit(far) - edge.a;
    edge.length = 2 * std::abs(along[1] * off[2] - along[2] * off[1]) / level;
    number[static_cast<std::size_t>(k)] = patch.num_edges;
    first_corner[static_cast<std::size_t>(patch.num_edges++)] = k;
  }
  const auto end_at = [&](int k) -> End {
    const int side = polygon.side[static_cast<std::size_t>(k)];
    if (side < 0) return {End::At::Side, -1 - side};
    const int edge = number[static_cast<std::size_t>(k)];
    return edge < 0 ? End{} : End{End::At::Edge, edge};
  };
  for (int k = 0; k < patch.num_edges; ++k) {
    PatchEdge& edge = patch.edge[static_cast<std::size_t>(k)];
    const int corner = first_corner[static_cast<std::size_t>(k)];
    edge.before = end_at(corner == 0 ? polygon.count - 1 : corner - 1);
    edge.after = end_at(corner + 1 == polygon.count ? 0 : corner + 1);
  }
}

/// ∮ p N Nᵀ dl / |∇χ| along an edge, for p affine: cubic, so that Simpson's rule is exact.
Mat3 edge_integral(const PatchEdge& edge, const Vec3& p) {
  const Vec3 &a = edge.a, &b = edge.b, middle = 0.5 * (a + b);
  return edge.length / 6 *
         (p.dot(a) * a * a.transpose() + p.dot(b) * b * b.transpose() +
          4 * p.dot(middle) * middle * middle.transpose());
}

/// Q, counted, depth_max and the edges of the part within the cuts, in units of the triangle's
/// area.
/// @return how much of it that is, times ω
double cover(const Cuts& cuts, ContactPatch& patch) {
  const TrianglePolygon whole = whole_triangle();
  std::array<TrianglePolygon, 2> rooms;
  const TrianglePolygon* part = &whole;
  for (int i = 0; i < cuts.count; ++i) {
    part = &clipped(cuts.all()[static_cast<std::size_t>(i)].level, i, *part,
                    rooms[part == rooms.data() ? 1 : 0]);
    if (part->count < 3) return 0;
  }
  for (int i = 0; i < part->count; ++i)
    patch.depth_max =
        std::max(patch.depth_max, patch.depth.dot(part->corner[static_cast<std::size_t>(i)]));
  find_edges(*part, cuts, patch);
  const double fraction = integrate(*part, patch.Q);
  patch.counted = patch.Q;
  if (!(patch.fade > 0)) return fraction;
  patch.counted = weighted_integral(*part, patch.depth / patch.fade);
  return patch.counted.sum();
}

/// w by the faces' n_F·n: a smoothstep from kFacingNone to kFacingFull.
void find_weight(FacingPair& pair) {
  constexpr double kRange = kFacingFull - kFacingNone;
  const double t = (-pair.cosine - kFacingNone) / kRange;
  pair.weight = t <= 0 ? 0 : 1;
  if (t <= 0 || t >= 1) return;
  pair.weight = t * t * (3 - 2 * t);
  pair.slope = -6 * t * (1 - t) / kRange;
  pair.bend = 6 * (1 - 2 * t) / (kRange * kRange);
}

/// β. @return false where nothing is opposite
bool find_opposite(const FlatTriangle& s, const FlatTriangle& f, FacingPair& pair) {
  // Weights of the face's nodes at each node of s: signed areas of the projected triangles (the
  // projected face turns the other way round, its area is negative).
  for (int m = 0; m < 3; ++m) {
    const Vec3 edge = f.x.col((m + 2) % 3) - f.x.col((m + 1) % 3);
    const Vec3 across = s.normal.cross(edge) / (f.twice_area * pair.cosine);
    pair.beta.row(m) = across.transpose() * (s.x.colwise() - f.x.col((m + 1) % 3));
    if (!(pair.beta.row(m).maxCoeff() > 0)) return false;
  }
  return true;
}

/// δ(depth) is this times u in the part nearest to the face or to one of its edges.
Vec3 depth_motion(const FlatTriangle& f, const ContactPatch& patch, int nearest) {
  if (nearest >= ContactPatch::kFace) return patch.c;
  return f.rim_height[nearest] * patch.face_g.col(nearest);
}

/// Gradients, of what the triangle and the face share.
void find_motion(const FlatTriangle& s, const FlatTriangle& f, ContactPatch& patch) {
  // In-plane gradients of the barycentric coordinates.
  const Vec3 s1 = s.x.col(1) - s.x.col(0), s2 = s.x.col(2) - s.x.col(0);
  const Vec3 g1 = s2.cross(s.normal) / s.twice_area, g2 = s.normal.cross(s1) / s.twice_area;
  patch.g << -g1 - g2, g1, g2;
  patch.e = patch.g.transpose() * patch.c;
  for (int m = 0; m < 3; ++m) {
    const Vec3 edge = f.x.col((m + 2) % 3) - f.x.col((m + 1) % 3);
    const Vec3 in_face = f.normal.cross(edge) / f.twice_area;
    patch.face_e[m] = in_face.dot(s.normal);
    patch.face_g.col(m) = in_face - patch.face_e[m] * patch.c;
  }
  patch.inward = depth_motion(f, patch, patch.nearest);
  for (int k = 0; k < patch.num_edges; ++k) {
    PatchEdge& edge = patch.edge[static_cast<std::size_t>(k)];
    switch (edge.kind) {
      case PatchEdge::Kind::FaceEdge:
        edge.motion = patch.face_g.col(edge.index);
        break;
      case PatchEdge::Kind::OpenDepth:
        edge.motion = patch.c;
        break;
      case PatchEdge::Kind::WholeWeight:
        edge.motion = patch.fade > 0 ? Vec3(-patch.c) : patch.c;
        break;
      case PatchEdge::Kind::NextPart:
        edge.motion = depth_motion(f, patch, edge.index) - patch.inward;
        break;
    }
  }
}

/// @param behind  what lies so far behind the face [m]
/// @param h       depths count wholly from −h on [m]
Cuts cuts_of_part(const FlatTriangle& f, const Vec3& behind, double h, const ContactPatch& patch) {
  using Kind = PatchEdge::Kind;
  Cuts cuts;
  for (int m = 0; m < 3; ++m)
    cuts.add(Kind::FaceEdge, m, (f.rims >> m & 1) != 0, patch.beta.row(m));
  switch (patch.nearest) {
    case ContactPatch::kFading:
      cuts.add(Kind::OpenDepth, 0, false, patch.depth);
      cuts.add(Kind::WholeWeight, 0, false, -behind.array() - h);
      return cuts;
    case ContactPatch::kFace:
      cuts.add(Kind::WholeWeight, 0, false, behind.array() + h);
      break;
    default:
      cuts.add(Kind::NextPart, ContactPatch::kFace, false, behind - patch.depth);
  }
  for (int m = 0; m < 3; ++m)
    if (m != patch.nearest && f.rim_height[m] > 0)
      cuts.add(Kind::NextPart, m, false,
               f.rim_height[m] * patch.beta.row(m).transpose() - patch.depth);
  return cuts;
}

}  // namespace

FlatTriangle flat_triangle(const Mat3& x) {
  FlatTriangle triangle;
  triangle.x = x;
  const Vec3 area_vector = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
  const double twice_area = area_vector.norm();
  if (!(twice_area > 0)) return triangle;
  triangle.twice_area = twice_area;
  triangle.normal = area_vector / twice_area;
  return triangle;
}

std::optional<FacingPair> facing_pair(const FlatTriangle& s, const FlatTriangle& f,
                                      const DepthRange& range) {
  FacingPair pair;
  pair.cosine = f.normal.dot(s.normal);
  find_weight(pair);
  if (!(pair.weight > 0)) return std::nullopt;
  pair.c = f.normal / pair.cosine;
  pair.height = pair.c.transpose() * (s.x.colwise() - f.x.col(0));
  if (!(pair.height.maxCoeff() - range.allowance > -range.open &&
        pair.height.minCoeff() <= range.reach))
    return std::nullopt;
  if (!find_opposite(s, f, pair)) return std::nullopt;
  return pair;
}

bool contact_patch(const FacingPair& pair, const FlatTriangle& s, const FlatTriangle& f,
                   double rest_area, const DepthRange& range, int nearest, ContactPatch& patch) {
  patch.nearest = nearest;
  const bool is_rim = is_beside_rim(patch), fades = nearest == ContactPatch::kFading;
  if (is_rim && f.rim_height[nearest] == 0) return false;
  const double h = 0.5 * range.open;
  const Vec3 behind = pair.height.array() - range.allowance;
  if (!(behind.maxCoeff() > (is_rim ? 0 : fades ? -range.open : -h))) return false;
  if (fades && !(h > 0 && behind.minCoeff() <= -h)) return false;

  patch.cosine = pair.cosine;
  patch.c = pair.c;
  patch.height = pair.height;
  patch.beta = pair.beta;
  patch.fade = fades ? h : 0;
  patch.depth = behind;
  if (fades) patch.depth.array() += range.open;
  if (is_rim) patch.depth = f.rim_height[nearest] * patch.beta.row(nearest);
  const Cuts cuts = cuts_of_part(f, behind, h, patch);
  patch.num_edges = 0;
  patch.depth_max = -range.open;
  const double fraction = cover(cuts, patch);
  if (!(fraction > 0)) return false;
  if (fades) patch.depth_max -= range.open;
  if (patch.depth_max + range.allowance > range.reach) return false;

  for (int k = 0; k < patch.num_edges; ++k)
    patch.edge[static_cast<std::size_t>(k)].length *= pair.weight * rest_area;
  patch.Q *= pair.weight * rest_area;
  patch.counted *= pair.weight * rest_area;
  patch.area = pair.weight * fraction * rest_area;
  patch.normal = s.normal;
  patch.turning = pair.slope / pair.weight;
  patch.bending = pair.bend / pair.weight;
  find_motion(s, f, patch);
  return true;
}

bool has_end(const ContactPatch& patch) {
  return std::any_of(patch.edge.begin(), patch.edge.begin() + patch.num_edges,
                     [](const PatchEdge& edge) { return edge.is_end; });
}

// With u = Σ N_i u_i, u_i = δx_i − d_i δn − Σ β_mi δf_m, how far the point of the triangle moves
// from the point of the face opposite: δd = c·u, δβ_m = ĝ_m·u (ĝ_m: face_g); beside a rim δd = h_m
// ĝ_m·u. The triangle's normal turns by δn = −Σ ∇N_i (n·δx_i); its d_i are heights, which an
// allowance does not change. With
// φ = share p d − m, the sum w ∫ φ dA over what is χ ≥ 0 changes by
//
//   w ∫ p δd dA + w ∮ φ δχ dl/|∇χ| + δw/w (w ∫ φ dA),
//   δ(n_F·n) = −Σ (n_F·∇N_i) n·δx_i − Σ (n·∇β_m) n_F·δf_m.
//
// A second time, as the straight moves of the nodes go on,
//
//   δ²d = −2 δd c·δn − 2 Σ δβ_m c·δf_m − d c·δ²n,   −c·δ²n = |δn|² + 2 Σ e_j δn·δx_j,
//
// and at an edge ∮ 2 p δd δχ dl/|∇χ| with what is in contact_patch_ends.cpp. Where one face takes
// over from another, or what counts wholly from what fades, both together have ∮ p δd δχ dl/|∇χ| of
// each; so has the edge where depths begin to count, as φ is 0 there.

namespace {

/// w ∫ p δd dA + w ∮ φ δχ dl/|∇χ|
/// @param sum  by_depth()
Vec18 unturned_gradient(const ContactPatch& patch, const PatchSum& sum) {
  Vec18 g = Vec18::Zero();
  add_opposite(patch, patch.inward, patch.Q * sum.p, g);
  for (int k = 0; k < patch.num_edges; ++k) {
    const PatchEdge& edge = patch.edge[static_cast<std::size_t>(k)];
    if (!edge.is_end) continue;
    add_opposite(patch, edge.motion, edge_sum(patch, edge, sum), g);
  }
  return g;
}

}  // namespace

Vec18 patch_gradient(const ContactPatch& patch, const PatchSum& sum) {
  Vec18 g = unturned_gradient(patch, by_depth(patch, sum));
  if (patch.turning == 0) return g;
  const double turning = patch.turning * value(patch, sum) * patch.cosine;
  for (int i = 0; i < 3; ++i) {
    g.segment<3>(3 * i) -= turning * patch.e[i] * patch.normal;
    g.segment<3>(9 + 3 * i) -= turning * patch.face_e[i] * patch.c;
  }
  return g;
}

// Lazy products: matrices of this size are too small for Eigen's general one to pay.

PatchStiffness patch_stiffness(const ContactPatch& patch, double k) {
  PatchStiffness stiffness;
  const Mat18x3 a = opposite(patch, patch.inward);
  const Mat3 half = 0.5 * k * patch.Q;
  stiffness.left.leftCols<3>() = a.lazyProduct(half);
  stiffness.right.leftCols<3>() = a;
  return stiffness;
}

void add_curvature(const ContactPatch& patch, const PatchSum& given, PatchStiffness& stiffness) {
  const PatchSum sum = by_depth(patch, given);
  Mat18x10 &left = stiffness.left, &right = stiffness.right;
  // Beside a rim δ²d is in end_stiffness().
  Vec3 q = Vec3::Zero();
  if (!is_beside_rim(patch)) q = patch.Q * sum.p;
  const double turning = patch.turning != 0 ? patch.turning * value(patch, given) : 0;
  // Beside δd = c·u: the turning of the normal, −c·δn, and the sweep of the edges.
  for (int j = 0; j < 3; ++j)
    left.block<3, 3>(3 * j, 0) += (patch.e[j] * patch.normal) * q.transpose();
  for (int k = 0; k < patch.num_edges; ++k) {
    const PatchEdge& edge = patch.edge[static_cast<std::size_t>(k)];
    const Mat3 part = (edge.is_end ? 1 : 0.5) * edge_integral(edge, sum.p);
    left.leftCols<3>() += opposite(patch, edge.motion).lazyProduct(part);
  }
  // −δβ_m c·δf_m
  for (int m = 0; m < 3; ++m) {
    add_opposite(patch, patch.face_g.col(m), q, left.col(3 + m));
    right.block<3, 1>(9 + 3 * m, 3 + m) = -patch.c;
  }
  // −½ d c·δ²n and ½ Φ w'/w n_F·δ²n, beside n·δx_j
  const double tilting = q.dot(patch.height) - turning * patch.cosine;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i)
      left.block<3, 1>(3 * i, 6 + j) =
          tilting *
          (0.5 * patch.g.col(i).dot(patch.g.col(j)) * patch.normal - patch.e[i] * patch.g.col(j));
    right.block<3, 1>(3 * j, 6 + j) = patch.normal;
  }
  if (turning == 0) return;
  // Φ w'/w (½ n·δ²n_F, beside −c·δf_m, and δn_F·δn, beside n·δx_j)
  const Vec3 n_F = patch.cosine * patch.c;
  const Mat3 face_g = patch.face_g + patch.c * patch.face_e.transpose();  // in the face's plane
  for (int m = 0; m < 3; ++m)
    for (int l = 0; l < 3; ++l) {
      left.block<3, 1>(9 + 3 * l, 3 + m) +=
          turning * patch.cosine *
          (0.5 * patch.cosine * face_g.col(l).dot(face_g.col(m)) * n_F -
           patch.face_e[l] * face_g.col(m));
      left.block<3, 1>(9 + 3 * l, 6 + m) += turning * face_g.col(l).dot(patch.g.col(m)) * n_F;
    }
  // δw/w (w ∫ p δd dA) + ½ Φ w''/w δ(n_F·n)², beside δ(n_F·n)
  Vec18 cosine;
  for (int i = 0; i < 3; ++i) {
    cosine.segment<3>(3 * i) = -(patch.cosine * patch.e[i]) * patch.normal;
    cosine.segment<3>(9 + 3 * i) = -(patch.cosine * patch.face_e[i]) * patch.c;
  }
  left.col(9) = patch.turning * unturned_gradient(patch, sum) +
                0.5 * patch.bending * value(patch, given) * cosine;
  right.col(9) = cosine;
}

}  // namespace articular::sim
