#pragma once

#include "sim/model/configuration.hpp"

namespace articular::sim {

/// Work [J] of the scenario's forces, moments, surface loads and gravity with a profile, on a
/// straight way between two configurations on which factors go from those of one time to those of
/// the other.
/// @param t_from, t_to  [s]; the configurations' own times are not looked at
double load_work(const Model& model, const Configuration& from, const Configuration& to,
                 double t_from, double t_to);

}  // namespace articular::sim
