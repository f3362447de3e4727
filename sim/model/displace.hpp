#pragma once

#include <Eigen/Core>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Moves a state y by displacements of the unknown blocks [m]; the second block of a rigid body has
/// a rotation vector.
void displace(const Model& model, const Eigen::VectorXd& u, Eigen::VectorXd& y);

}  // namespace articular::sim
