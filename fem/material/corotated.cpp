#include "fem/material/corotated.hpp"

#include <algorithm>

#include "fem/base/rotation_svd.hpp"

namespace articular::fem {

double Corotated::energy_density(const Mat3& F) const {
  const Vec3 strain = rotation_svd(F).sigma - Vec3::Ones();
  return lame_.mu * strain.squaredNorm() + 0.5 * lame_.lambda * strain.sum() * strain.sum();
}

Mat3 Corotated::first_piola(const Mat3& F) const {
  const RotationSvd svd = rotation_svd(F);
  const Mat3 R = svd.U * svd.V.transpose();
  return 2 * lame_.mu * (F - R) + lame_.lambda * (svd.sigma.sum() - 3) * R;
}

template <class Function>
Mat9 Corotated::tangent(const Mat3& F, Function twist_stiffness) const {
  const RotationSvd svd = rotation_svd(F);
  const Mat3 R = svd.U * svd.V.transpose();
  const Vec9 r = R.reshaped();
  const double of_rotation = lame_.lambda * (svd.sigma.sum() - 3) - 2 * lame_.mu;
  Mat9 C = lame_.lambda * r * r.transpose();
  C.diagonal().array() += 2 * lame_.mu;
  for (int k = 0; k < 3; ++k) {
    const double eigenvalue = 2 * lame_.mu + of_rotation * 2 / twist_stretch(svd, k);
    const Vec9 t = twist(svd, k);
    C += (twist_stiffness(eigenvalue) - 2 * lame_.mu) * t * t.transpose();
  }
  return C;
}

Mat9 Corotated::tangent(const Mat3& F) const {
  return tangent(F, [](double eigenvalue) { return eigenvalue; });
}

Mat9 Corotated::projected_tangent(const Mat3& F) const {
  return tangent(F, [](double eigenvalue) { return std::max(eigenvalue, 0.0); });
}

}  // namespace articular::fem
