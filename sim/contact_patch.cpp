#include "sim/contact_patch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace articular::sim {
namespace {

/// A convex polygon in barycentric coordinates of the triangle, one corner a column (N0 N1 N2).
/// A triangle cut by four half planes has at most seven corners; where round-off makes the levels
/// of corners on a cut change sign more often than twice, each cut adds half as many: 3, 4, 6,
/// 9, 13.
struct Polygon {
  std::array<Vec3, 13> corner;
  std::array<double, 13> level;
  int count = 0;
};

/// Keeps the part where the affine function with the values `at_nodes` at the triangle's nodes is
/// >= 0.
void clip(const Vec3& at_nodes, Polygon& polygon, Polygon& scratch) {
  bool all_inside = true;
  for (int i = 0; i < polygon.count; ++i) {
    polygon.level[static_cast<std::size_t>(i)] =
        at_nodes.dot(polygon.corner[static_cast<std::size_t>(i)]);
    all_inside = all_inside && polygon.level[static_cast<std::size_t>(i)] >= 0;
  }
  if (all_inside) return;
  scratch.count = 0;
  const auto keep = [&](const Vec3& N) {
    scratch.corner[static_cast<std::size_t>(scratch.count++)] = N;
  };
  for (int i = 0; i < polygon.count; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1);
    const double la = polygon.level[a], lb = polygon.level[b];
    if (la >= 0) keep(polygon.corner[a]);
    if ((la >= 0) != (lb >= 0))
      keep(polygon.corner[a] + la / (la - lb) * (polygon.corner[b] - polygon.corner[a]));
  }
  std::swap(polygon, scratch);
}

/// ∫ N Nᵀ over the polygon in units of the triangle's area: a fan of triangles, each
/// a/12 (Σ v vᵀ + (Σv)(Σv)ᵀ).
double integrate(const Polygon& polygon, Mat3& Q) {
  double total = 0;
  Q.setZero();
  const Vec3& v0 = polygon.corner[0];
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(polygon.count); ++i) {
    const Vec3 &v1 = polygon.corner[i], &v2 = polygon.corner[i + 1];
    // Twice the area in (N1, N2), which is 1 for the whole triangle.
    const double area = (v1[1] - v0[1]) * (v2[2] - v0[2]) - (v1[2] - v0[2]) * (v2[1] - v0[1]);
    const Vec3 sum = v0 + v1 + v2;
    Q += area / 12 *
         (v0 * v0.transpose() + v1 * v1.transpose() + v2 * v2.transpose() + sum * sum.transpose());
    total += area;
  }
  return total;
}

}  // namespace

bool contact_patch(const Mat3& s, const Mat3& f, double rest_area, double reach,
                   ContactPatch& patch) {
  const Vec3 s1 = s.col(1) - s.col(0), s2 = s.col(2) - s.col(0);
  const Vec3 area_vector = s1.cross(s2);
  const double twice_area = area_vector.norm();
  const Vec3 face_vector = (f.col(1) - f.col(0)).cross(f.col(2) - f.col(0));
  const double twice_face_area = face_vector.norm();
  if (!(twice_area > 0) || !(twice_face_area > 0)) return false;
  const Vec3 n = area_vector / twice_area;
  const Vec3 n_F = face_vector / twice_face_area;
  const double cosine = n_F.dot(n);
  if (cosine > -kFacingCosine) return false;

  patch.c = n_F / cosine;
  for (int i = 0; i < 3; ++i) patch.depth[i] = patch.c.dot(s.col(i) - f.col(0));
  if (patch.depth.maxCoeff() <= 0 || patch.depth.minCoeff() > reach) return false;

  // Weights of the face's nodes at each node of s: signed areas of the projected triangles (the
  // projected face turns the other way round, twice_projected < 0).
  const double twice_projected = face_vector.dot(n);
  for (int i = 0; i < 3; ++i)
    for (int m = 0; m < 3; ++m) {
      const Vec3 a = f.col((m + 1) % 3) - s.col(i), b = f.col((m + 2) % 3) - s.col(i);
      patch.beta(m, i) = a.cross(b).dot(n) / twice_projected;
    }

  Polygon polygon, scratch;
  polygon.count = 3;
  for (int i = 0; i < 3; ++i) polygon.corner[static_cast<std::size_t>(i)] = Vec3::Unit(i);
  for (int m = 0; m < 3; ++m) {
    clip(patch.beta.row(m), polygon, scratch);
    if (polygon.count < 3) return false;
  }
  clip(patch.depth, polygon, scratch);
  if (polygon.count < 3) return false;
  const double fraction = integrate(polygon, patch.Q);
  if (!(fraction > 0)) return false;
  patch.depth_max = 0;
  for (int i = 0; i < polygon.count; ++i)
    patch.depth_max =
        std::max(patch.depth_max, patch.depth.dot(polygon.corner[static_cast<std::size_t>(i)]));
  if (patch.depth_max > reach) return false;

  patch.Q *= rest_area;
  patch.area = fraction * rest_area;
  patch.normal = n;
  // In-plane gradients of the barycentric coordinates.
  const Vec3 g1 = s2.cross(n) / twice_area, g2 = n.cross(s1) / twice_area;
  patch.e = Vec3(-patch.c.dot(g1 + g2), patch.c.dot(g1), patch.c.dot(g2));
  return true;
}

double contact_energy(const ContactPatch& patch, double k) {
  return 0.5 * k * patch.depth.dot(patch.Q * patch.depth);
}

// δd at N: Σ_i (N_i c + d e_i n)·δx_i − Σ_m β_m c·δf_m, from d = c·(x − Σ β_m f_m) with the
// triangle's normal turning by δn = −Σ ∇N_i (n·δx_i).

Vec18 contact_gradient(const ContactPatch& patch, double k) {
  const Vec3 q = patch.Q * patch.depth;
  const double square = patch.depth.dot(q);
  const Vec3 reaction = patch.beta * q;
  Vec18 g;
  for (int i = 0; i < 3; ++i) {
    g.segment<3>(3 * i) = k * (q[i] * patch.c + square * patch.e[i] * patch.normal);
    g.segment<3>(9 + 3 * i) = -k * reaction[i] * patch.c;
  }
  return g;
}

Mat18 contact_hessian(const ContactPatch& patch, double k) {
  const Vec3 q = patch.Q * patch.depth;
  const double square = patch.depth.dot(q);
  const Vec3 reaction = patch.beta * q;
  const Mat3 Q_beta = patch.Q * patch.beta.transpose();
  const Mat3 beta_Q_beta = patch.beta * Q_beta;
  const Mat3 cc = k * patch.c * patch.c.transpose();
  const Mat3 cn = k * patch.c * patch.normal.transpose();
  const Mat3 nc = cn.transpose();
  const Mat3 nn = k * patch.normal * patch.normal.transpose();
  Mat18 H;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      H.block<3, 3>(3 * i, 3 * j) = patch.Q(i, j) * cc + q[i] * patch.e[j] * cn +
                                    patch.e[i] * q[j] * nc + square * patch.e[i] * patch.e[j] * nn;
      const Mat3 mixed = -Q_beta(i, j) * cc - patch.e[i] * reaction[j] * nc;
      H.block<3, 3>(3 * i, 9 + 3 * j) = mixed;
      H.block<3, 3>(9 + 3 * j, 3 * i) = mixed.transpose();
      H.block<3, 3>(9 + 3 * i, 9 + 3 * j) = beta_Q_beta(i, j) * cc;
    }
  return H;
}

}  // namespace articular::sim
