#include "fem/material/fibre_invariants.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"

namespace articular::fem {

Mat3 fifth_invariant_gradient(const Mat3& F, const Vec3& a0) {
  const Vec3 b = F * a0, w = F.transpose() * b;
  return 2 * (b * w.transpose() + F * w * a0.transpose());
}

double fibre_stretch(const Mat3& F, const Vec3& a0) { return (F * a0).norm(); }

Mat3 fibre_stretch_gradient(const Mat3& F, const Vec3& a0) {
  const Vec3 b = F * a0;
  return b * a0.transpose() / b.norm();
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

}  // namespace articular::fem
