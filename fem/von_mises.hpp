#pragma once

#include <Eigen/Core>

namespace articular::fem {

/// sqrt(3/2 s : s) of the deviator s of each stress [Pa].
/// @param stress  6 x M (xx yy zz xy yz xz) [Pa]
inline Eigen::VectorXd von_mises(const Eigen::MatrixXd& stress) {
  const auto normal = stress.topRows<3>().array();
  const auto deviator = normal.rowwise() - normal.colwise().mean();
  const auto squares = deviator.square().colwise().sum() +
                       2 * stress.bottomRows<3>().array().square().colwise().sum();
  return (1.5 * squares).sqrt().transpose();
}

}  // namespace articular::fem
