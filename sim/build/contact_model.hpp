#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// The pairs of bodies that may touch, as the scenario names them or all that can meet, with their
/// stiffness. The colliders are there.
/// @throws InputError for a pair with a body that has nothing to touch with
void make_contacts(const Scenario& scenario, Model& model);

/// How many times as stiff as the elements at the surface contact is: as the scenario says, or by
/// how it is treated.
/// @param averaged  depths are averaged at nodes
double contact_stiffness_factor(const Scenario& scenario, bool averaged);

/// [m] Within which pairs are kept as candidates at least: as the scenario says, or by the
/// elements.
double detection_margin(const Model& model);

}  // namespace articular::sim
