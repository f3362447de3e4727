#pragma once

#include <array>

#include "fem/types.hpp"

/// The part of a surface triangle that lies under a facing face of the other body, and the penalty
/// energy on it.
///
/// The face F is projected along the triangle's own normal n onto the triangle s; on the polygon
/// that both share, the depth d(N) = n_F·(x − f0) / (n_F·n) > 0 of the triangle's point x = Σ N_i
/// x_i behind the face is affine in the barycentric coordinates N. With the rest area of the
/// triangle as measure and Q = ∫ N Nᵀ dA over the part of the polygon with d > 0,
///
///   E = ½ k w ∫ d² dA = ½ k w dᵀ Q d,  d_i the depth at node i of s.
///
/// w(n_F·n) is 1 for faces that oppose the triangle and falls smoothly to 0 where they stand
/// oblique to it: along an oblique normal a shallow overlap reads deep, and a hard limit would make
/// forces jump.
///
/// The reaction goes to the face's nodes with the weights β_m(N) of the point opposite, so that the
/// forces are equal and opposite and make no net moment. Everything is integrated exactly. At the
/// rim of a sheet the motion of the polygon's edge with d > 0 is left out of the gradient.
namespace articular::sim {

using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat18 = Eigen::Matrix<double, 18, 18>;

struct ContactPatch {
  double area = 0;             // [m²] rest area with d > 0, times w
  double depth_max = 0;        // [m]
  Mat3 Q = Mat3::Zero();       // w ∫ N Nᵀ dA [m²]
  Mat3 beta = Mat3::Zero();    // beta(m, i): weight of face node m opposite node i of s
  Vec3 depth = Vec3::Zero();   // at the nodes of s [m]
  Vec3 c = Vec3::Zero();       // n_F / (n_F·n)
  Vec3 e = Vec3::Zero();       // e_i = c·∇N_i [1/m]
  Vec3 normal = Vec3::Zero();  // n, unit
  double cosine = 0;           // n_F·n
  double turning = 0;          // ½ w'/w, by the cosine
  Vec3 face_e = Vec3::Zero();  // n·∇β_m on the face [1/m]
  Mat3 g = Mat3::Zero();       // ∇N_i, one a column [1/m]
  Mat3 face_g = Mat3::Zero();  // ∇β_m for motion that keeps the depth, one a column [1/m]
  // w ∫ d N Nᵀ / |∇β_m| dl along the polygon's edges where β_m = 0 [m³]
  std::array<Mat3, 3> edge = {Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};
};

/// Of −n_F·n: below the first the face does not face the triangle (w = 0), above the second it does
/// (w = 1). 60 and 37 degrees: facets of smooth bodies that touch are nearer to parallel.
inline constexpr double kFacingNone = 0.5, kFacingFull = 0.8;

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

/// All of it [N/m]: with k ∫ d ∇²d dA, and with what the polygon's edges sweep as the face's edges
/// move over the triangle, k ∮ d ∇d ∇β_mᵀ/|∇β_m| dl, made symmetric: summed over the two faces at
/// an edge that is exact. Indefinite. Left out: the turning of w, and the gradient's missing part
/// at a rim.
Mat18 contact_tangent(const ContactPatch& patch, double k);

}  // namespace articular::sim
