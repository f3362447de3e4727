#pragma once

#include "sim/model/model.hpp"

/// Gravity without a profile is a stored energy. With one it is a load, whose work is counted: a
/// potential that changes with time would have an energy of its own, by where the origin lies.
namespace articular::sim {

/// All of it at a time [m/s²].
Vec3 gravity_at(const Model& model, double t);

/// Without a profile [m/s²].
Vec3 steady_gravity(const Model& model);

/// With a profile, the mean of two times [m/s²].
Vec3 mean_changing_gravity(const Model& model, double t_from, double t_to);

}  // namespace articular::sim
