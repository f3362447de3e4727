#include "sim/contact_patch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace articular::sim {
namespace {

constexpr int kOwnSide = -1, kDepthSide = 3;  // 0 to 2: β_m = 0

/// A convex polygon in barycentric coordinates of the triangle, one corner a column (N0 N1 N2).
/// A triangle cut by four half planes has at most seven corners; where round-off makes the levels
/// of corners on a cut change sign more often than twice, each cut adds half as many: 3, 4, 6,
/// 9, 13.
struct Polygon {
  std::array<Vec3, 13> corner;
  std::array<double, 13> level;
  std::array<int, 13>
      side;  // which cut the edge from a corner to the next lies on, kOwnSide if none
  int count = 0;
};

/// Keeps the part where the affine function with the values `at_nodes` at the triangle's nodes is
/// >= 0.
void clip(const Vec3& at_nodes, int side, Polygon& polygon, Polygon& scratch) {
  bool all_inside = true;
  for (int i = 0; i < polygon.count; ++i) {
    polygon.level[static_cast<std::size_t>(i)] =
        at_nodes.dot(polygon.corner[static_cast<std::size_t>(i)]);
    all_inside = all_inside && polygon.level[static_cast<std::size_t>(i)] >= 0;
  }
  if (all_inside) return;
  scratch.count = 0;
  const auto keep = [&](const Vec3& N, int edge) {
    scratch.corner[static_cast<std::size_t>(scratch.count)] = N;
    scratch.side[static_cast<std::size_t>(scratch.count++)] = edge;
  };
  for (int i = 0; i < polygon.count; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1);
    const double la = polygon.level[a], lb = polygon.level[b];
    if (la >= 0) keep(polygon.corner[a], polygon.side[a]);
    if ((la >= 0) != (lb >= 0))
      keep(polygon.corner[a] + la / (la - lb) * (polygon.corner[b] - polygon.corner[a]),
           la >= 0 ? side : polygon.side[a]);
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

/// ∫ d N Nᵀ / |∇β_m| dl over the polygon's edges on β_m = 0, in units of the triangle's area.
void integrate_edges(const Polygon& polygon, ContactPatch& patch) {
  for (Mat3& edge : patch.edge) edge.setZero();
  for (int k = 0; k < polygon.count; ++k) {
    const int m = polygon.side[static_cast<std::size_t>(k)];
    if (m == kOwnSide || m == kDepthSide) continue;
    const Vec3& a = polygon.corner[static_cast<std::size_t>(k)];
    const Vec3& b = polygon.corner[static_cast<std::size_t>(k + 1 == polygon.count ? 0 : k + 1)];
    // 1/|∇β_m| is the distance of a point from the edge by its β_m: of the corner farthest off.
    Eigen::Index far = 0;
    const double beta = patch.beta.row(m).cwiseAbs().maxCoeff(&far);
    if (!(beta > 0)) continue;
    const Vec3 along = b - a, off = Vec3::Unit(far) - a;
    const double length = 2 * std::abs(along[1] * off[2] - along[2] * off[1]) / beta;
    // Cubic in the edge's parameter: Simpson's rule is exact.
    const Vec3 middle = 0.5 * (a + b);
    patch.edge[static_cast<std::size_t>(m)] +=
        length / 6 *
        (patch.depth.dot(a) * a * a.transpose() + patch.depth.dot(b) * b * b.transpose() +
         4 * patch.depth.dot(middle) * middle * middle.transpose());
  }
}

struct Facing {
  double weight, slope;
};

/// Smoothstep from kFacingNone to kFacingFull.
Facing facing_weight(double opposing) {
  const double t = (opposing - kFacingNone) / (kFacingFull - kFacingNone);
  if (t <= 0) return {0, 0};
  if (t >= 1) return {1, 0};
  return {t * t * (3 - 2 * t), 6 * t * (1 - t) / (kFacingFull - kFacingNone)};
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
  const Facing facing = facing_weight(-cosine);
  if (!(facing.weight > 0)) return false;

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
  for (int i = 0; i < 3; ++i) {
    polygon.corner[static_cast<std::size_t>(i)] = Vec3::Unit(i);
    polygon.side[static_cast<std::size_t>(i)] = kOwnSide;
  }
  for (int m = 0; m < 3; ++m) {
    clip(patch.beta.row(m), m, polygon, scratch);
    if (polygon.count < 3) return false;
  }
  clip(patch.depth, kDepthSide, polygon, scratch);
  if (polygon.count < 3) return false;
  const double fraction = integrate(polygon, patch.Q);
  if (!(fraction > 0)) return false;
  patch.depth_max = 0;
  for (int i = 0; i < polygon.count; ++i)
    patch.depth_max =
        std::max(patch.depth_max, patch.depth.dot(polygon.corner[static_cast<std::size_t>(i)]));
  if (patch.depth_max > reach) return false;

  integrate_edges(polygon, patch);
  for (Mat3& edge : patch.edge) edge *= facing.weight * rest_area;
  patch.Q *= facing.weight * rest_area;
  patch.area = facing.weight * fraction * rest_area;
  patch.normal = n;
  patch.cosine = cosine;
  patch.turning = -0.5 * facing.slope / facing.weight;
  // In-plane gradients of the barycentric coordinates.
  const Vec3 g1 = s2.cross(n) / twice_area, g2 = n.cross(s1) / twice_area;
  patch.g << -g1 - g2, g1, g2;
  patch.e = patch.g.transpose() * patch.c;
  for (int m = 0; m < 3; ++m) {
    const Vec3 in_face = n_F.cross(f.col((m + 2) % 3) - f.col((m + 1) % 3)) / twice_face_area;
    patch.face_e[m] = in_face.dot(n);
    patch.face_g.col(m) = in_face - patch.face_e[m] * patch.c;
  }
  return true;
}

double contact_energy(const ContactPatch& patch, double k) {
  return 0.5 * k * patch.depth.dot(patch.Q * patch.depth);
}

// δd at N: Σ_i (N_i c + d e_i n)·δx_i − Σ_m β_m c·δf_m, from d = c·(x − Σ β_m f_m) with the
// triangle's normal turning by δn = −Σ ∇N_i (n·δx_i). With it w changes by
// δ(n_F·n) = −Σ (n_F·∇N_i) n·δx_i − Σ (n·∇β_m) n_F·δf_m.

Vec18 contact_gradient(const ContactPatch& patch, double k) {
  const Vec3 q = patch.Q * patch.depth;
  const double square = patch.depth.dot(q);
  const Vec3 reaction = patch.beta * q;
  const double turning = patch.turning * square * patch.cosine;
  Vec18 g;
  for (int i = 0; i < 3; ++i) {
    g.segment<3>(3 * i) = k * (q[i] * patch.c + (square - turning) * patch.e[i] * patch.normal);
    g.segment<3>(9 + 3 * i) = -k * (reaction[i] + turning * patch.face_e[i]) * patch.c;
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

// With u = Σ N_i u_i, u_i = δx_i − d_i δn − Σ β_mi δf_m, how far the point of the triangle moves
// from the point of the face opposite: δd = c·u, δβ_m = ĝ_m·u (ĝ_m: face_g). A second time, as the
// straight moves of the nodes go on,
//
//   δ²d = −2 δd c·δn − 2 Σ δβ_m c·δf_m − d c·δ²n,   −c·δ²n = |δn|² + 2 Σ e_j δn·δx_j.

Mat18 contact_tangent(const ContactPatch& patch, double k) {
  using Mat18x3 = Eigen::Matrix<double, 18, 3>;
  const Vec3 q = patch.Q * patch.depth;
  const double square = patch.depth.dot(q);
  // a_i, b_mi: what c·u_i and ĝ_m·u_i are of the 18 displacements.
  const auto opposite = [&patch](int i, const Vec3& direction) {
    Vec18 row;
    for (int j = 0; j < 3; ++j) {
      row.segment<3>(3 * j) = patch.depth[i] * direction.dot(patch.g.col(j)) * patch.normal;
      row.segment<3>(9 + 3 * j) = -patch.beta(j, i) * direction;
    }
    row.segment<3>(3 * i) += direction;
    return row;
  };
  Mat18x3 a;
  for (int i = 0; i < 3; ++i) a.col(i) = opposite(i, patch.c);
  Vec18 tilt = Vec18::Zero();  // −c·δn
  for (int j = 0; j < 3; ++j) tilt.segment<3>(3 * j) = patch.e[j] * patch.normal;

  Mat18 H = Mat18::Zero();
  // ½ of each pair: the transpose is added below.
  Mat18x3 y = 0.5 * a * patch.Q + tilt * q.transpose();
  for (int m = 0; m < 3; ++m) {
    Mat18x3 b;
    for (int i = 0; i < 3; ++i) b.col(i) = opposite(i, patch.face_g.col(m));
    y += 0.5 * b * patch.edge[static_cast<std::size_t>(m)];
    H.block<18, 3>(0, 9 + 3 * m) -= b * q * patch.c.transpose();
  }
  H += a * y.transpose();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      H.block<3, 3>(3 * i, 3 * j) +=
          square *
          (0.5 * patch.g.col(i).dot(patch.g.col(j)) * patch.normal - patch.e[i] * patch.g.col(j)) *
          patch.normal.transpose();
  return k * (H + H.transpose());
}

}  // namespace articular::sim
