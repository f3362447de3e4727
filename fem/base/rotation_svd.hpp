#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/base/types.hpp"

namespace articular::fem {

/// F = U diag(sigma) Vᵀ with two rotations (det U = det V = +1).
struct RotationSvd {
  Mat3 U, V;
  Vec3 sigma;  // sigma0 ≥ sigma1 ≥ |sigma2|; sigma2 has the sign of det F
};

/// Singular value decomposition for polar rotations: where F is inverted, the smallest singular
/// value takes the minus sign, so that R = U Vᵀ is the rotation nearest to F [Irving 2004]. Defined
/// for every finite F, degenerate and zero ones included. One-sided Jacobi rotations on the columns
/// of F [Demmel 1992]: accurate for small singular values too, and quick near a rotation.
///
/// [Irving 2004] Irving, Teran, Fedkiw. Invertible Finite Elements for Robust Simulation of Large
///               Deformation. SCA 2004.
/// [Demmel 1992] Demmel, Veselić. Jacobi's Method is More Accurate than QR. SIAM J. Matrix Anal.
///               Appl. 13(4).
inline RotationSvd rotation_svd(const Mat3& F) {
  // Columns count as orthogonal at a cosine of round-off. Convergence is quadratic: four or five
  // sweeps do; the bound only ends the chase of round-off in columns that cancelled to nothing.
  constexpr double kOrthogonal = 2 * std::numeric_limits<double>::epsilon();  // [-]
  constexpr int kMaxSweeps = 12;

  Mat3 A = F, V = Mat3::Identity();  // A = F V throughout
  const auto orthogonalize = [&A, &V](int p, int q) {
    const double alpha = A.col(p).squaredNorm(), beta = A.col(q).squaredNorm();
    const double gamma = A.col(p).dot(A.col(q));
    if (gamma * gamma <= kOrthogonal * kOrthogonal * alpha * beta) return false;
    const double zeta = (beta - alpha) / (2 * gamma);
    const double t = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
    const double c = 1 / std::sqrt(1 + t * t), s = c * t;
    for (Mat3* M : {&A, &V}) {
      const Vec3 column_p = M->col(p);
      M->col(p) = c * column_p - s * M->col(q);
      M->col(q) = s * column_p + c * M->col(q);
    }
    return true;
  };
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    const bool rotated01 = orthogonalize(0, 1);
    const bool rotated02 = orthogonalize(0, 2);
    const bool rotated12 = orthogonalize(1, 2);
    if (!rotated01 && !rotated02 && !rotated12) break;
  }

  // Descending order; a swap negates one column, so that V stays a rotation.
  Vec3 length2 = A.colwise().squaredNorm().transpose();
  for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    if (length2[p] >= length2[q]) continue;
    std::swap(length2[p], length2[q]);
    for (Mat3* M : {&A, &V}) {
      const Vec3 column_p = M->col(p);
      M->col(p) = M->col(q);
      M->col(q) = -column_p;
    }
  }

  RotationSvd svd{.U = Mat3::Identity(), .V = V, .sigma = Vec3::Zero()};
  const double sigma0 = A.col(0).norm();
  if (sigma0 == 0) return svd;
  const Vec3 u0 = A.col(0) / sigma0;
  // A second column within round-off of the first has no direction of its own: any one serves.
  Vec3 u1 = A.col(1) - u0.dot(A.col(1)) * u0;
  u1 = u1.norm() > kOrthogonal * sigma0 ? u1.normalized() : u0.unitOrthogonal();
  svd.U.col(0) = u0;
  svd.U.col(1) = (u1 - u0.dot(u1) * u0).normalized();
  svd.U.col(2) = u0.cross(svd.U.col(1));
  svd.sigma << sigma0, svd.U.col(1).dot(A.col(1)), svd.U.col(2).dot(A.col(2));
  return svd;
}

/// The twist T_k = U [e_k]× Vᵀ/√2, stacked: the change of F that turns its stretches i and j into
/// each other (i, j, k cyclic) [Kim 2022, ch. 5].
///
/// [Kim 2022] Kim, Eberle. Dynamic Deformables: Implementation and Production Practicalities.
///            SIGGRAPH 2022 Courses.
inline Vec9 twist(const RotationSvd& svd, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Mat3 T = svd.U.col(j) * svd.V.col(i).transpose() - svd.U.col(i) * svd.V.col(j).transpose();
  return T.reshaped() / std::sqrt(2.0);
}

/// σi + σj of twist k. Where it is 0 (an element turned inside out just so far) the rotation jumps,
/// and its derivative has no bound; a smaller sum counts as 1e-6, which leaves a stiffness that
/// still can be factored.
inline double twist_stretch(const RotationSvd& svd, int k) {
  constexpr double kSmallestSum = 1e-6;  // [-]
  return std::max(svd.sigma[(k + 1) % 3] + svd.sigma[(k + 2) % 3], kSmallestSum);
}

/// ∂vec(R)/∂vec(F) = Σ_k 2/(σi + σj) T_k⊗T_k of the rotation R = U Vᵀ nearest to F.
inline Mat9 rotation_derivative(const RotationSvd& svd) {
  Mat9 result = Mat9::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec9 t = twist(svd, k);
    result += 2 / twist_stretch(svd, k) * t * t.transpose();
  }
  return result;
}

}  // namespace articular::fem
