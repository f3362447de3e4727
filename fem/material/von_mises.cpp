#include "fem/material/von_mises.hpp"

#include <cmath>

namespace articular::fem {

Eigen::VectorXd von_mises(const Eigen::MatrixXd& stress) {
  Eigen::VectorXd result(stress.cols());
  for (Eigen::Index e = 0; e < stress.cols(); ++e) {
    const Eigen::Vector3d normal = stress.col(e).head<3>(), shear = stress.col(e).tail<3>();
    const double deviator = (normal.array() - normal.mean()).matrix().squaredNorm();
    result[e] = std::sqrt(1.5 * (deviator + 2 * shear.squaredNorm()));
  }
  return result;
}

}  // namespace articular::fem
