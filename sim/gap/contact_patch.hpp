#pragma once

#include <array>
#include <optional>

#include "fem/base/types.hpp"

/// The part of a surface triangle that lies opposite a facing face of the other body, and the gap
/// on it.
///
/// The face F is projected along the triangle's own normal n onto the triangle s; on the polygon
/// that both share, the depth d(N) = n_F·(x − f0) / (n_F·n) of the triangle's point x = Σ N_i x_i
/// behind the face (negative: in front of it) is affine in the barycentric coordinates N. With the
/// rest area of the triangle as measure, each node a of s gets from this patch
///
///   W_a = w ∫ N_a dA,   G_a = w ∫ N_a d dA.
///
/// Sums of G_a over the patches around a node give its mean depth (contact_response.hpp). Bodies
/// that overlap from the start may be allowed a part of it: an allowance [m] is taken from d.
///
/// In front of the face depths count from −2h on, and fade in: up to −h with the weight ω = 2 +
/// d/h, and as the depth −h ω, which are both affine and begin with 0. So W_a and G_a jump nowhere.
/// What fades is a patch of its own.
///
/// A point that passed a sharp edge of the other body may be nearer to that edge than it is deep:
/// it came in beside the face, not through it. There the depth is the distance from the edge, h_m
/// β_m(N) with the face's height h_m over it at rest (on layers a multiple of it), so that d is the
/// smaller one: else edges that touch would push each other aside with a finite force at once. Each
/// part of the polygon, nearest to the face or to one of its edges, is a patch of its own.
///
/// w(n_F·n) is 1 for faces that oppose the triangle and falls smoothly to 0 where they stand
/// oblique to it: along an oblique normal a shallow overlap reads deep, and a hard limit would make
/// forces jump.
///
/// Nodes of the face move G_a with the weights β_m(N) of the point opposite, so that forces derived
/// from G_a are equal and opposite and make no net moment. Everything is integrated exactly.
/// Gradients have the motion of the edges at which the polygon ends: where surfaces slip off each
/// other that keeps energy.
namespace articular::sim {

using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat18 = Eigen::Matrix<double, 18, 18>;
using Mat18x10 = Eigen::Matrix<double, 18, 10>;

/// Where the polygon ends inside the triangle: at an edge of the face, χ = β_m = 0; where depths
/// begin to count, χ = d + 2h = 0; where they count wholly, χ = d + h, or, from the part that
/// fades, −d − h; or where another part of it begins, χ the depth there less the one here.
/// ∮ f dl / |∇χ| along it is `length` times the mean of f. At an edge where the next patch takes
/// over what this one loses its motion changes no sum.
struct PatchEdge {
  enum class Kind { FaceEdge, OpenDepth, WholeWeight, NextPart };
  /// What the edge ends at: another one of the patch, or the triangle's side N_index = 0.
  struct End {
    enum class At { Nothing, Edge, Side } at = At::Nothing;
    int index = 0;
  };
  Kind kind = Kind::FaceEdge;
  int index = 0;                            // FaceEdge: m; NextPart: its `nearest`
  bool is_end = false;                      // φ does not go on beyond: at a rim
  Vec3 level = Vec3::Zero();                // χ at the nodes of s
  Vec3 motion = Vec3::Zero();               // δχ = motion·u, see contact_patch.cpp
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  // its ends, in barycentric coordinates of s
  double length = 0;                        // times w [m²; by a depth: m]
  End before, after;                        // what it ends at in a and b
};

struct ContactPatch {
  static constexpr int kFace = 3, kFading = 4, kParts = 5;
  int nearest = kFace;          // or the number of the face's edge, or kFading
  double fade = 0;              // h [m] of the part that fades, else 0
  double area = 0;              // [m²] rest area of the polygon, times w ω
  double depth_max = 0;         // [m]
  Mat3 Q = Mat3::Zero();        // w ∫ N Nᵀ dA [m²]
  Mat3 counted = Mat3::Zero();  // w ∫ ω N Nᵀ dA [m²], ω = 1 but where it fades
  Mat3 beta = Mat3::Zero();     // beta(m, i): weight of face node m opposite node i of s
  Vec3 depth = Vec3::Zero();    // d at the nodes of s, without the allowance; fading: h ω [m]
  Vec3 height = Vec3::Zero();   // behind the face, with the allowance [m]
  Vec3 inward = Vec3::Zero();   // δd = inward·u, see contact_patch.cpp
  Vec3 c = Vec3::Zero();        // n_F / (n_F·n)
  Vec3 e = Vec3::Zero();        // e_i = c·∇N_i [1/m]
  Vec3 normal = Vec3::Zero();   // n, unit
  double cosine = 0;            // n_F·n
  double turning = 0;           // w'/w, by the cosine
  double bending = 0;           // w''/w
  Vec3 face_e = Vec3::Zero();   // n·∇β_m on the face [1/m]
  Mat3 g = Mat3::Zero();        // ∇N_i, one a column [1/m]
  Mat3 face_g = Mat3::Zero();   // ∇β_m for motion that keeps the depth, one a column [1/m]
  std::array<PatchEdge, 7> edge;
  int num_edges = 0;
};

/// Of −n_F·n: below the first the face does not face the triangle (w = 0), above the second it does
/// (w = 1). 60 and 37 degrees: facets of smooth bodies that touch are nearer to parallel.
inline constexpr double kFacingNone = 0.5, kFacingFull = 0.8;

/// Depths that count [m].
struct DepthRange {
  double open;           // 2h, in front of the face up to here
  double reach;          // a patch deeper than this anywhere did not come in through this face
  double allowance = 0;  // up to here behind the face is none; then depths count from there
};

/// A triangle where it is now; without an area its normal is zero.
struct FlatTriangle {
  Mat3 x = Mat3::Zero();           // corners, one a column, counter-clockwise from outside [m]
  Vec3 normal = Vec3::Zero();      // unit, outward
  double twice_area = 0;           // [m²]
  unsigned rims = 7;               // bit m: its group ends at the edge opposite corner m
  Vec3 rim_height = Vec3::Zero();  // h_m [m] at rims where the body is convex; else 0
};
FlatTriangle flat_triangle(const Mat3& x);

/// What all parts of a pair share; names as in ContactPatch.
struct FacingPair {
  double cosine = 0;
  double weight = 0, slope = 0, bend = 0;  // w, w', w''
  Vec3 c, height;
  Mat3 beta;
};

/// @return nothing when nothing of s is opposite f within the range
std::optional<FacingPair> facing_pair(const FlatTriangle& s, const FlatTriangle& f,
                                      const DepthRange& range);

/// @param pair       facing_pair() of s and f
/// @param rest_area  of the triangle s [m²]
/// @param nearest    which part of the polygon, ContactPatch::nearest
/// @return false when there is nothing of that part
bool contact_patch(const FacingPair& pair, const FlatTriangle& s, const FlatTriangle& f,
                   double rest_area, const DepthRange& range, int nearest, ContactPatch& patch);

/// Whether the polygon ends inside the triangle.
bool has_end(const ContactPatch& patch);
/// Whether its depths are distances from an edge of the face.
inline bool is_beside_rim(const ContactPatch& patch) { return patch.nearest < ContactPatch::kFace; }

/// W_a [m²] and G_a [m³] of the triangle's nodes.
inline Vec3 nodal_areas(const ContactPatch& patch) { return patch.counted.rowwise().sum(); }
inline Vec3 depth_integrals(const ContactPatch& patch) {
  return (patch.fade > 0 ? -1 : 1) * (patch.Q * patch.depth);
}
/// By the triangle's nodes [N] of pressures there; beside a rim they act along the face.
inline Vec3 normal_forces(const ContactPatch& patch, const Vec3& p) {
  return (is_beside_rim(patch) ? 0 : 1) * (patch.counted * p);
}

/// Σ_a share p_a G_a − m_a W_a, by numbers at the nodes of the triangle that stay as they are,
/// share 1; or the energy ½ k w ∫ d² dA: p = k d, share ½, where nothing fades.
struct PatchSum {
  Vec3 p = Vec3::Zero(), m = Vec3::Zero();
  double share = 1;
};
inline PatchSum point_energy(const ContactPatch& patch, double k) {
  return {k * patch.depth, Vec3::Zero(), 0.5};
}
inline double value(const ContactPatch& patch, const PatchSum& sum) {
  return sum.share * sum.p.dot(depth_integrals(patch)) - sum.m.dot(nodal_areas(patch));
}
inline PatchSum scaled(const PatchSum& sum, double factor) {
  return {factor * sum.p, factor * sum.m, sum.share};
}

/// Of the sum, by (x0 x1 x2 f0 f1 f2).
Vec18 patch_gradient(const ContactPatch& patch, const PatchSum& sum);

/// A stiffness of the six nodes by its factors: left·rightᵀ + right·leftᵀ.
struct PatchStiffness {
  Mat18x10 left = Mat18x10::Zero(), right = Mat18x10::Zero();
};

/// k w ∫ ∇d ∇dᵀ dA, ∇d by the six nodes: positive semidefinite.
PatchStiffness patch_stiffness(const ContactPatch& patch, double k);

/// Adds the second derivative of the sum, but for what patch_stiffness() has of an energy: of the
/// depth; of what the polygon's edges sweep as they move over the triangle, made symmetric: summed
/// over the two faces at an edge that is exact; and of w as triangle and face turn. Indefinite.
/// @param stiffness  made by patch_stiffness()
void add_curvature(const ContactPatch& patch, const PatchSum& sum, PatchStiffness& stiffness);

/// What is to be added where the polygon ends, or bends depths beside an edge of the face.
/// @return false where there is nothing
bool end_stiffness(const ContactPatch& patch, const PatchSum& sum, Mat18& H);

}  // namespace articular::sim
