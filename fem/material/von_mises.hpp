#pragma once

#include <Eigen/Core>

namespace articular::fem {

/// sqrt(3/2 s : s) of the deviator s of each stress [Pa].
/// @param stress  6 x M (xx yy zz xy yz xz) [Pa]
Eigen::VectorXd von_mises(const Eigen::MatrixXd& stress);

}  // namespace articular::fem
