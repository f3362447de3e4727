#pragma once

#include <Eigen/Core>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Weights 1/tolerance of the unknowns: positions against position_tolerance, velocities against
/// what moves them so far in a time h [s] and the least slip velocity of friction, rotations by the
/// rigid body's size.
void set_weights(const Model& model, double h, Eigen::Ref<Eigen::VectorXd> weight);

/// What the scenario gives, or its part of the mean element size of the finest tissue; without
/// tissue, of the smallest rigid body's radius of gyration [m].
double position_tolerance(const Integrator& integrator, const Model& model);

/// Radius of gyration [m]: how far a turn by one radian moves the rigid body's mass.
double turning_radius(const RigidBody& rigid);

}  // namespace articular::sim
