#include "fem/material/fibre_invariants.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

Jet fourth_invariant(const Mat3& F, const Vec3& a0) {
  const Vec3 b = F * a0;
  return {b.squaredNorm(), 2 * b * a0.transpose(), 2 * on_columns(a0 * a0.transpose())};
}

Mat3 fifth_invariant_gradient(const Mat3& F, const Vec3& a0) {
  const Vec3 b = F * a0, w = F.transpose() * b;
  return 2 * (b * w.transpose() + F * w * a0.transpose());
}

Jet fifth_invariant(const Mat3& F, const Vec3& a0) {
  const Vec3 b = F * a0, w = F.transpose() * b;
  Eigen::Matrix<double, 3, 9> dw;
  for (int j = 0; j < 3; ++j)
    dw.middleCols<3>(3 * j) = Vec3::Unit(j) * b.transpose() + a0[j] * F.transpose();
  const Mat3 A = w * a0.transpose();
  return {w.squaredNorm(), fifth_invariant_gradient(F, a0),
          2 * dw.transpose() * dw + 2 * on_columns(A + A.transpose())};
}

double fibre_stretch(const Mat3& F, const Vec3& a0) { return (F * a0).norm(); }

Mat3 fibre_stretch_gradient(const Mat3& F, const Vec3& a0) {
  const Vec3 b = F * a0;
  return b * a0.transpose() / b.norm();
}

Jet fibre_stretch_jet(const Mat3& F, const Vec3& a0) {
  const Jet I4 = fourth_invariant(F, a0);
  const double stretch = std::sqrt(I4.value);
  return composed(I4, stretch, 0.5 / stretch, -0.25 / (stretch * I4.value));
}

double isochoric_fibre_stretch(const Mat3& F, const Vec3& a0) {
  return std::pow(F.determinant(), -1.0 / 3) * (F * a0).norm();
}

Mat3 isochoric_fibre_stretch_gradient(const Mat3& F, const Vec3& a0) {
  const double J = F.determinant();
  const Vec3 b = F * a0;
  const double stretch = b.norm();
  return std::pow(J, -1.0 / 3) * (b * a0.transpose() / stretch - stretch / (3 * J) * cofactor(F));
}

Jet isochoric_fibre_stretch_jet(const Mat3& F, const Vec3& a0) {
  return times_power_of_volume(fibre_stretch_jet(F, a0), -1.0 / 3, F);
}

}  // namespace articular::fem
