#pragma once

#include <Eigen/Core>

#include "sim/model.hpp"

namespace articular::sim {

/// Weights 1/tolerance of the unknowns: positions against position_tolerance, velocities against
/// what moves them so far in a time h [s], rotations by the bone's size.
void set_weights(const Model& model, double h, Eigen::Ref<Eigen::VectorXd> weight);

/// Radius of gyration [m]: how far a turn by one radian moves the bone's mass.
double turning_radius(const Bone& bone);

}  // namespace articular::sim
