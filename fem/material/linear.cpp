#include "fem/material/linear.hpp"

namespace articular::fem {
namespace {

Mat3 small_strain(const Mat3& F) { return 0.5 * (F + F.transpose()) - Mat3::Identity(); }

}  // namespace

double Linear::energy_density(const Mat3& F) const {
  const Mat3 strain = small_strain(F);
  const double trace = strain.trace();
  return lame_.mu * strain.squaredNorm() + 0.5 * lame_.lambda * trace * trace;
}

Mat3 Linear::first_piola(const Mat3& F) const {
  const Mat3 strain = small_strain(F);
  return 2 * lame_.mu * strain + lame_.lambda * strain.trace() * Mat3::Identity();
}

Mat9 Linear::tangent(const Mat3&) const {
  Mat9 C = Mat9::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      C(3 * j + i, 3 * j + i) += lame_.mu;  // ∂F_ij/∂F_ij
      C(3 * j + i, 3 * i + j) += lame_.mu;  // ∂F_ji/∂F_ij
      C(4 * i, 4 * j) += lame_.lambda;      // tr(F) I
    }
  }
  return C;
}

}  // namespace articular::fem
