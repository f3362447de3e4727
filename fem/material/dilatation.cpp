#include "fem/material/dilatation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/base/cofactor.hpp"
#include "fem/base/rotation_svd.hpp"

namespace articular::fem {

double VolumeChange::value(const Mat3& F) { return F.determinant() - 1; }

Mat3 VolumeChange::gradient(const Mat3& F) { return cofactor(F); }

Mat9 VolumeChange::hessian(const Mat3& F) { return cofactor_derivative(F); }

double LogVolumeChange::value(const Mat3& F) { return std::log(F.determinant()); }

Mat3 LogVolumeChange::gradient(const Mat3& F) { return cofactor(F) / F.determinant(); }

Mat9 LogVolumeChange::hessian(const Mat3& F) {
  const double J = F.determinant();
  const Vec9 c = cofactor(F).reshaped();
  return cofactor_derivative(F) / J - c * c.transpose() / (J * J);
}

double StretchDilatation::value(const Mat3& F) { return rotation_svd(F).sigma.sum() - 3; }

Mat3 StretchDilatation::gradient(const Mat3& F) {
  const RotationSvd svd = rotation_svd(F);
  return svd.U * svd.V.transpose();
}

Mat9 StretchDilatation::hessian(const Mat3& F) { return rotation_derivative(rotation_svd(F)); }

double GreenDilatation::value(const Mat3& F) { return 0.5 * (F.squaredNorm() - 3); }

Mat3 GreenDilatation::gradient(const Mat3& F) { return F; }

Mat9 GreenDilatation::hessian(const Mat3&) { return Mat9::Identity(); }

double SmallDilatation::value(const Mat3& F) { return F.trace() - 3; }

Mat3 SmallDilatation::gradient(const Mat3&) { return Mat3::Identity(); }

Mat9 SmallDilatation::hessian(const Mat3&) { return Mat9::Zero(); }

}  // namespace articular::fem
