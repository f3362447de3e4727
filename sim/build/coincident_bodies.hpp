#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Two bodies that may touch, with surfaces that lie within a tenth of an element of each other all
/// over, however they are meshed: no face enters the other body as contact would need it. One of
/// them is a copy left by mistake. Bodies that are tied to each other may lie so.
/// @throws InputError naming both
void refuse_coincident_bodies(const Scenario& scenario, const Model& model);

/// A body that may touch another lies wholly inside it, be that tissue or a surface alone. Where a
/// surface has a hole, what lies more in it than out of it counts as inside.
/// @throws InputError naming both
void refuse_bodies_within_others(const Scenario& scenario, const Model& model);

}  // namespace articular::sim
