#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Is tissue of one body tied to the other? Then it belongs there.
bool are_tied(const Model& model, const ContactModel& contact);

/// Two bodies that may touch, with surfaces whose nodes lie at the same places within rounding, in
/// any order: no face enters the other body, so that contact would find nothing. One of them is a
/// copy left by mistake. Bodies that are tied to each other may lie so.
/// @throws InputError naming both
void refuse_coincident_bodies(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
