// Part of block_kernels.inl.hpp.
//
// A triangle q0 q1 q2 against a tetrahedron a b c d, sixteen tetrahedra side by side. With
// L_i(q) = 6V times the barycentric coordinate of q that is 1 at corner i, the two meet if and only
// if an edge of the triangle meets the tetrahedron or an edge of the tetrahedron meets the
// triangle. Both are read off the signs of the twelve L_i(q_j), of the heights of the four corners
// above the triangle's plane, and of D_ik(s, t) = L_i(s) L_k(t) - L_k(s) L_i(t), the side on which
// the line s t passes the tetrahedron's edge where faces i and k meet (a product of Plucker
// coordinates).
//
// All of it in single precision, in coordinates of the block. Every sign is taken with a bound on
// its error, so that a verdict is "meet", "apart" or "doubtful", never wrong. The bound: with
// positions known to delta = 2^-24 times the largest coordinate, edges up to E and all differences
// up to S, a product of three lengths, L = n.q - n.a with n from two edges, has an error of at most
// E S (84 delta + 24 u S), u = 2^-24.

#include "collision/blocks/block_kernels.hpp"

namespace articular::collision::ARTICULAR_INSTRUCTION_SET {
namespace {

/// Where a triangle's corners lie relative to a tetrahedron, and this to the triangle's plane. A
/// pair a lane.
struct Signs {
  Vec L[4][3];    // of corner j
  Vec height[4];  // of the tetrahedron's corners, times twice the triangle's area
  Vec error_L, error_height;
};

inline Vec3 pick3(const Pick& pick, const Rows3& rows) {
  return {pick(rows.row[0]), pick(rows.row[1]), pick(rows.row[2])};
}

Signs locate(const TetLanes& tets, const Pick& tet, const FaceLanes& faces, const Pick& face) {
  Signs s;
  const Vec3 normal = pick3(face, faces.normal);
  const Vec offset = face(faces.offset);
  for (int corner = 0; corner < 4; ++corner)
    s.height[corner] = dot(normal, pick3(tet, tets.corner[corner])) - offset;
  const Vec3 q[3] = {pick3(face, faces.corner[0]), pick3(face, faces.corner[1]),
                     pick3(face, faces.corner[2])};
  for (int i = 0; i < 4; ++i) {
    const Vec3 gradient = pick3(tet, tets.normal[i]);
    const Vec at_zero = tet(tets.offset[i]);
    for (int j = 0; j < 3; ++j) s.L[i][j] = dot(gradient, q[j]) - at_zero;
  }
  // Their boxes overlap, up to round-off: no two points are farther apart than S.
  const Vec E = tet(tets.edge), edge = face(faces.edge), delta = face(faces.delta);
  const Vec S = E + edge + Vec::all(16) * delta + Vec::all(tets.margin);
  s.error_L = error_of_product(E, S, delta);
  s.error_height = error_of_product(edge, S, delta);
  return s;
}

inline Vec least(Vec a, Vec b, Vec c) { return min(a, min(b, c)); }
inline Vec greatest(Vec a, Vec b, Vec c) { return max(a, max(b, c)); }
inline Vec least(const Vec* v) { return min(min(v[0], v[1]), min(v[2], v[3])); }
inline Vec greatest(const Vec* v) { return max(max(v[0], v[1]), max(v[2], v[3])); }
inline Vec negative(Vec a) { return Vec::all(0) - a; }

struct Verdict {
  unsigned apart, meet;
};

/// The planes of the faces: one of them separates.
inline unsigned apart_by_planes(const Signs& s) {
  const Vec e = s.error_L;
  unsigned apart = less(s.error_height, max(least(s.height), negative(greatest(s.height))));
  for (int i = 0; i < 4; ++i)
    apart |= less(greatest(s.L[i][0], s.L[i][1], s.L[i][2]),
                  negative(i == 0 ? Vec::all(kErrorOfL0) * e : e));
  return apart;
}

/// The same with a margin: one of the planes leaves a gap of more than that, or (meet) none does.
inline Verdict by_planes_with_margin(const Signs& s, const TetLanes& tets, const Pick& tet,
                                     const FaceLanes& faces, const Pick& face) {
  Verdict v{0, kAllLanes};
  const auto compare = [&](Vec distance, Vec reach, Vec error) {
    const Vec gap = distance - reach, unsure = error + Vec::all(kMarginRoundOff) * reach;
    v.apart |= less(unsure, gap);
    v.meet &= less(gap, negative(unsure));
  };
  const Vec margin = Vec::all(tets.margin), of_normal = margin * Vec::all(kErrorOfNormal);
  const Vec3 normal = pick3(face, faces.normal);
  compare(max(least(s.height), negative(greatest(s.height))), margin * sqrt(dot(normal, normal)),
          s.error_height + of_normal * face(faces.edge) * face(faces.delta));
  const Vec error = s.error_L + of_normal * Vec::all(kUnit) * tet(tets.edge);
  for (int i = 0; i < 4; ++i)
    compare(negative(greatest(s.L[i][0], s.L[i][1], s.L[i][2])), tet(tets.reach[i]),
            i == 0 ? Vec::all(kErrorOfL0) * error : error);
  return v;
}

/// Lanes with a corner of the triangle inside.
inline unsigned corner_inside(const Signs& s) {
  const Vec e = s.error_L, e0 = Vec::all(kErrorOfL0) * e;
  unsigned mask = 0;
  for (int j = 0; j < 3; ++j)
    mask |= less(e0, s.L[0][j]) & less(e, least(s.L[1][j], s.L[2][j], s.L[3][j]));
  return mask;
}

/// Two faces of the tetrahedron, and the corners at the ends of the edge where they meet.
struct TetEdge {
  int i, k, from, to;
};
constexpr TetEdge kTetEdges[6] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                  {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};

/// The edges of both, for pairs that the planes leave open.
Verdict by_edges(const Signs& s) {
  const Vec e = s.error_L, e0 = Vec::all(kErrorOfL0) * e;
  unsigned positive[4][3], negative_L[4][3];
  Vec largest = Vec::all(0);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec error = i == 0 ? e0 : e;
      positive[i][j] = less(error, s.L[i][j]);
      negative_L[i][j] = less(s.L[i][j], negative(error));
      largest = max(largest, magnitude(s.L[i][j]));
    }
  unsigned above[4], below[4];
  for (int corner = 0; corner < 4; ++corner) {
    above[corner] = less(s.error_height, s.height[corner]);
    below[corner] = less(s.height[corner], negative(s.error_height));
  }

  // Of the triangle's edge from corner j: no part of it is in the tetrahedron; some part is.
  unsigned outside[3] = {0, 0, 0}, inside[3] = {kAllLanes, kAllLanes, kAllLanes};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) {
      const int t = (j + 1) % 3;
      outside[j] |= negative_L[i][j] & negative_L[i][t];
      inside[j] &= positive[i][j] | positive[i][t];
    }
  unsigned meet = 0, may_pierce = 0;
  for (const TetEdge& edge : kTetEdges) {
    const int i = edge.i, k = edge.k;
    // D = L_i(s) L_k(t) - L_k(s) L_i(t): 2.5 x the largest L x the sum of both errors bounds its
    // own.
    const Vec error = largest * e * Vec::all(i == 0 ? 2.5f * (1 + kErrorOfL0) : 2.5f * 2);
    unsigned all_left = kAllLanes, all_right = kAllLanes, any_left = 0, any_right = 0;
    for (int j = 0; j < 3; ++j) {
      const int t = (j + 1) % 3;
      const Vec D = s.L[i][j] * s.L[k][t] - s.L[k][j] * s.L[i][t];
      const unsigned right = less(error, D), left = less(D, negative(error));
      all_right &= right, any_right |= right;
      all_left &= left, any_left |= left;
      // From s to t the edge enters at face i and has left at face k before, or the reverse.
      outside[j] |= negative_L[i][j] & positive[i][t] & positive[k][j] & negative_L[k][t] & right;
      outside[j] |= negative_L[k][j] & positive[k][t] & positive[i][j] & negative_L[i][t] & left;
      inside[j] &= positive[i][j] | positive[k][t] | left;
      inside[j] &= positive[k][j] | positive[i][t] | right;
    }
    const unsigned through_plane =
        (above[edge.from] & below[edge.to]) | (below[edge.from] & above[edge.to]);
    const unsigned on_one_side =
        (above[edge.from] & above[edge.to]) | (below[edge.from] & below[edge.to]);
    meet |= (all_left | all_right) & through_plane;
    may_pierce |= ~(any_left & any_right) & ~on_one_side;
  }
  meet |= inside[0] | inside[1] | inside[2];
  return {outside[0] & outside[1] & outside[2] & ~may_pierce, meet};
}

}  // namespace
}  // namespace articular::collision::ARTICULAR_INSTRUCTION_SET
