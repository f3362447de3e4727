#pragma once

#include "sim/gap/contact_patch.hpp"

namespace articular::sim {

/// In the plane z = 0 around the origin, looking up.
inline Mat3 large_face() {
  Mat3 f;
  f << -20, 20, 0, -20, -20, 30, 0, 0, 0;
  return f;
}

/// Looks down, by `depth` behind that face.
inline Mat3 small_triangle(double depth) {
  Mat3 s;
  s << 0, 0, 1, 0, 1, 0, -depth, -depth, -depth;
  return s;
}

/// One part of a pair alone.
inline bool contact_patch(const FlatTriangle& s, const FlatTriangle& f, double rest_area,
                          const DepthRange& range, ContactPatch& patch,
                          int nearest = ContactPatch::kFace) {
  const std::optional<FacingPair> pair = facing_pair(s, f, range);
  return pair && contact_patch(*pair, s, f, rest_area, range, nearest, patch);
}

/// Of Σ p_a G_a for numbers p that stay as they are.
inline Vec18 patch_gradient(const ContactPatch& patch, const Vec3& p) {
  return sim::patch_gradient(patch, PatchSum{p});
}

inline Mat18 product(const PatchStiffness& stiffness) {
  const Mat18 half = stiffness.left * stiffness.right.transpose();
  return half + half.transpose();
}
inline Mat18 patch_hessian(const ContactPatch& patch) { return product(patch_stiffness(patch, 1)); }
inline Mat18 patch_curvature(const ContactPatch& patch, const PatchSum& sum) {
  PatchStiffness stiffness = patch_stiffness(patch, 0);
  add_curvature(patch, sum, stiffness);
  Mat18 H;
  if (!end_stiffness(patch, sum, H)) H.setZero();
  return H + product(stiffness);
}

}  // namespace articular::sim
