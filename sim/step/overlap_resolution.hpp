#pragma once

#include "sim/statics/equilibrium.hpp"

namespace articular::sim {

/// What contact finds before anything has moved.
struct OverlapAtStart {
  ContactId contact = 0;
  double depth = 0;           // [m] of the deepest point
  bool is_set_apart = false;  // by resolve_overlaps()
};

/// Of every contact that is deeper than round-off: what resolve_overlaps() goes by.
/// @throws SimulationError when contact can't tell the way out
std::vector<OverlapAtStart> overlaps_at_start(const Scenario& scenario, const Model& model,
                                              const Eigen::VectorXd& y);

/// Bodies that overlap before anything has moved, as segmented anatomy does, are pushed apart as
/// gently as can be: each contact is allowed the depth that it has, and the allowance shrinks to
/// zero in steps of a quarter of an element (the shrink fit of structural analysis). In each,
/// contact and the tissues' elasticity alone, without gravity, loads, lines and activation, move
/// bodies in pseudo-time until they have given way; tissue between held ones keeps the stress.
///
/// Overlaps within the contact's max_penetration stay as they are; of two rigid bodies without a
/// layer none does that is deeper than round-off.
/// @param scenario  that the model was built from
/// @param y  at the start, in the order of Layout; on return positions have moved, nothing else
/// @param watch  told of each iteration, see Equilibrium; may be empty
/// @return no overlaps: nothing was to be done
/// @throws SimulationError when that does not end, or contact can't tell the way out;
/// Interruption when `watch` asks to stop
OverlapResolution resolve_overlaps(const Scenario& scenario, const Model& model, Eigen::VectorXd& y,
                                   const IterationWatch& watch = {});

}  // namespace articular::sim
