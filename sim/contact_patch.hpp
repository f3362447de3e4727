#pragma once

#include "fem/types.hpp"

/// The part of a surface triangle that lies under a facing face of the other body, and the penalty
/// energy on it.
///
/// The face F is projected along the triangle's own normal n onto the triangle s; on the polygon
/// that both share, the depth d(N) = n_F·(x − f0) / (n_F·n) > 0 of the triangle's point x = Σ N_i
/// x_i behind the face is affine in the barycentric coordinates N. With the rest area of the
/// triangle as measure and Q = ∫ N Nᵀ dA over the part of the polygon with d > 0,
///
///   E = ½ k ∫ d² dA = ½ k dᵀ Q d,  d_i the depth at node i of s.
///
/// The reaction goes to the face's nodes with the weights β_m(N) of the point opposite, so that the
/// forces are equal and opposite and make no net moment. Everything is integrated exactly. At the
/// rim of a sheet the motion of the polygon's edge with d > 0 is left out of the gradient.
namespace articular::sim {

using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat18 = Eigen::Matrix<double, 18, 18>;

struct ContactPatch {
  double area = 0;             // [m²] rest area with d > 0
  double depth_max = 0;        // [m]
  Mat3 Q = Mat3::Zero();       // ∫ N Nᵀ dA [m²]
  Mat3 beta = Mat3::Zero();    // beta(m, i): weight of face node m opposite node i of s
  Vec3 depth = Vec3::Zero();   // at the nodes of s [m]
  Vec3 c = Vec3::Zero();       // n_F / (n_F·n)
  Vec3 e = Vec3::Zero();       // e_i = c·∇N_i [1/m]
  Vec3 normal = Vec3::Zero();  // n, unit
};

/// Faces opposing the triangle's normal by less than this cosine do not face it.
inline constexpr double kFacingCosine = 0.2;

/// @param s, f   corners of the triangle and the face, one a column, counter-clockwise from outside
/// [m]
/// @param rest_area  of the triangle [m²]
/// @param reach  depth beyond which the face is not taken to be the one that was crossed [m]
/// @return false when nothing of s is behind f
bool contact_patch(const Mat3& s, const Mat3& f, double rest_area, double reach,
                   ContactPatch& patch);

/// E [J] for a stiffness k [Pa/m].
double contact_energy(const ContactPatch& patch, double k);

/// ∂E/∂(x0 x1 x2 f0 f1 f2) [N].
Vec18 contact_gradient(const ContactPatch& patch, double k);

/// Gauss–Newton part of the Hessian, k ∫ ∇d ∇dᵀ dA [N/m]: positive semidefinite.
Mat18 contact_hessian(const ContactPatch& patch, double k);

}  // namespace articular::sim
