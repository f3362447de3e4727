#include "fem/material/st_venant_kirchhoff.hpp"

#include <Eigen/LU>
#include <limits>

#include "fem/base/on_columns.hpp"

namespace articular::fem {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Whether J > 0 and all principal stretches are above 1/√3: C − I/3 is positive definite
/// (Sylvester). False for what is not a number.
bool is_stable(const Mat3& F) {
  const Mat3 A = F.transpose() * F - Mat3::Identity() / 3;
  return F.determinant() > 0 && A(0, 0) > 0 && A.topLeftCorner<2, 2>().determinant() > 0 &&
         A.determinant() > 0;
}

Mat3 green_strain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }

}  // namespace

double StVenantKirchhoff::energy_density(const Mat3& F) const {
  if (!is_stable(F)) return kNoNumber;
  const Mat3 E_green = green_strain(F);
  const double trace = E_green.trace();
  return 0.5 * lame_.lambda * trace * trace + lame_.mu * E_green.squaredNorm();
}

Mat3 StVenantKirchhoff::second_piola(const Mat3& F) const {
  const Mat3 E_green = green_strain(F);
  return lame_.lambda * E_green.trace() * Mat3::Identity() + 2 * lame_.mu * E_green;
}

Mat3 StVenantKirchhoff::first_piola(const Mat3& F) const {
  if (!is_stable(F)) return Mat3::Constant(kNoNumber);
  return F * second_piola(F);
}

// dP = dF S + F dS, which is in indices
// ∂P_ij/∂F_kl = δ_ik S_lj + λ F_ij F_kl + μ (F_il F_kj + (FFᵀ)_ik δ_jl).
Mat9 StVenantKirchhoff::tangent(const Mat3& F) const {
  if (!is_stable(F)) return Mat9::Constant(kNoNumber);
  const Vec9 f = F.reshaped();
  Mat9 C = on_columns(second_piola(F)) + lame_.lambda * f * f.transpose();
  const Mat3 B = lame_.mu * F * F.transpose();
  for (int j = 0; j < 3; ++j) {
    C.block<3, 3>(3 * j, 3 * j) += B;
    for (int l = 0; l < 3; ++l)
      C.block<3, 3>(3 * j, 3 * l) += lame_.mu * F.col(l) * F.col(j).transpose();
  }
  return C;
}

}  // namespace articular::fem
