// What edges add to the second derivative of a sum: F = w ∫ φ dA over χ_e >= 0, where the χ_e are
// affine with the values ℓ_e at the nodes of the triangle, δℓ_e = motion_e·u_i, changes by
//
//   q_e·δℓ_e,  q_e = ∂F/∂ℓ_e = w ∮ φ N dl/|∇χ_e|,
//
// a second time by δℓ_e·∂q_e/∂ℓ_e'·δℓ_e' + q_e·δ²ℓ_e, and by ∮ 2 p δd δχ dl/|∇χ|, which
// add_curvature() has.
#include <cmath>

#include "sim/gap/contact_patch.hpp"
#include "sim/gap/patch_motion.hpp"

namespace articular::sim {
namespace {

/// By N_1 and N_2.
Eigen::Vector2d gradient(const Vec3& level) { return {level[1] - level[0], level[2] - level[0]}; }
Vec3 barycentric(const Eigen::Vector2d& way) { return {-way[0] - way[1], way[0], way[1]}; }
double cross_product(const Eigen::Vector2d& v, const Eigen::Vector2d& w) {
  return v[0] * w[1] - v[1] * w[0];
}

/// ∇χ of what an edge ends at: an edge of the patch, or −1 − i: N_i = 0.
Eigen::Vector2d gradient_of(const ContactPatch& patch, const PatchEdge::End& end) {
  if (end.at == PatchEdge::End::At::Side) return gradient(Vec3::Unit(end.index));
  return gradient(patch.edge[static_cast<std::size_t>(end.index)].level);
}

/// How the corner where two lines χ = 0 and χ' = 0 meet moves: δN = −own (δℓ·N) − other (δℓ'·N).
struct Corner {
  Vec3 own, other;
};

Corner corner_of(const Eigen::Vector2d& line, const Eigen::Vector2d& other) {
  const double angle = cross_product(line, other);
  if (angle == 0) return {Vec3::Zero(), Vec3::Zero()};
  return {barycentric(Eigen::Vector2d(other[1], -other[0]) / angle),
          barycentric(Eigen::Vector2d(-line[1], line[0]) / angle)};
}

/// ∂(∮ φ N dl/|∇χ|)/∂(an end of the edge, its length fixed).
Mat3 by_end(const ContactPatch& patch, const PatchEdge& edge, const PatchSum& sum,
            const Vec3& end) {
  const Vec3 middle = 0.5 * (edge.a + edge.b);
  const auto of = [&](const Vec3& N) {
    const Vec3 slope =
        sum.share * (patch.depth.dot(N) * sum.p + sum.p.dot(N) * patch.depth) - sum.m;
    return Mat3(N * slope.transpose() + phi(patch, sum, N) * Mat3::Identity());
  };
  return edge.length / 6 * (of(end) + 2 * of(middle));
}

/// H += A K Bᵀ
void add(const Mat18x3& A, const Mat3& K, const Mat18x3& B, Mat18& H) {
  H += A.lazyProduct(K).eval().lazyProduct(B.transpose());
}

/// δℓ_e·∂q_e/∂ℓ_e'·δℓ_e' for one e and all e'.
void add_motion(const ContactPatch& patch, const PatchEdge& edge, const PatchSum& sum, Mat18& H) {
  const Mat18x3 levels = opposite(patch, edge.motion);
  const Vec3 q = edge_sum(patch, edge, sum), along = edge.b - edge.a;
  const Eigen::Vector2d line = gradient(edge.level);
  const Vec3 stretch = Vec3(0, along[1], along[2]) / along.tail<2>().squaredNorm();
  Mat3 own = -q * barycentric(line).transpose() / line.squaredNorm();
  const auto add_end = [&](const Vec3& N, const PatchEdge::End& end, double sign) {
    if (end.at == PatchEdge::End::At::Nothing) return;
    const Corner corner = corner_of(line, gradient_of(patch, end));
    const Mat3 change = sign * q * stretch.transpose() + by_end(patch, edge, sum, N);
    own -= change * corner.own * N.transpose();
    if (end.at == PatchEdge::End::At::Side) return;
    const PatchEdge& beyond = patch.edge[static_cast<std::size_t>(end.index)];
    add(levels, -change * corner.other * N.transpose(), opposite(patch, beyond.motion), H);
  };
  add_end(edge.a, edge.before, -1);
  add_end(edge.b, edge.after, 1);
  add(levels, own, levels, H);
}

/// Σ R_i·v_i with v = −2 Σ δβ_m δf_m − 2 δd δn − d δ²n, what bends d and β: motion·v is δ²χ. There
/// δ²n = −|δn|² n − 2 Σ ∇N_j (δn·δx_j).
void add_bending(const ContactPatch& patch, const Mat3& R, Mat18& H) {
  const Vec3& n = patch.normal;
  const auto add_both = [&H](int i, int j, const Mat3& block) {
    H.block<3, 3>(i, j) += block;
    H.block<3, 3>(j, i) += block.transpose();
  };
  for (int m = 0; m < 3; ++m) {
    const Mat18x3 pushed = opposite(patch, patch.face_g.col(m)).lazyProduct(R.transpose());
    H.middleCols<3>(9 + 3 * m) -= pushed;
    H.middleRows<3>(9 + 3 * m) -= pushed.transpose();
  }
  const Mat18x3 tilted = opposite(patch, patch.c).lazyProduct(R.transpose() * patch.g);
  const Vec3 r = R * patch.height;
  for (int j = 0; j < 3; ++j) {
    H.middleCols<3>(3 * j) += tilted.col(j) * n.transpose();
    H.middleRows<3>(3 * j) += n * tilted.col(j).transpose();
    for (int k = 0; k < 3; ++k) {
      H.block<3, 3>(3 * j, 3 * k) +=
          r.dot(n) * patch.g.col(j).dot(patch.g.col(k)) * n * n.transpose();
      add_both(3 * j, 3 * k, -r.dot(patch.g.col(j)) * patch.g.col(k) * n.transpose());
    }
  }
}

}  // namespace

bool end_stiffness(const ContactPatch& patch, const PatchSum& given, Mat18& H) {
  const bool is_rim = is_beside_rim(patch);
  if (!is_rim && !has_end(patch)) return false;
  const PatchSum sum = by_depth(patch, given);
  H.setZero();
  Mat3 R = Mat3::Zero();
  if (is_rim) R += patch.inward * (patch.Q * sum.p).transpose();
  for (int k = 0; k < patch.num_edges; ++k) {
    const PatchEdge& edge = patch.edge[static_cast<std::size_t>(k)];
    if (!edge.is_end || !(edge.length > 0)) continue;
    add_motion(patch, edge, sum, H);
    R += edge.motion * edge_sum(patch, edge, sum).transpose();
  }
  add_bending(patch, R, H);
  return true;
}

}  // namespace articular::sim
