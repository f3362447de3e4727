#pragma once

#include "sim/assembly/moment.hpp"
#include "sim/model/state.hpp"

namespace articular::sim {

/// Notes in state.extrema, and max_penetration, what is worse than it has been, at the last
/// evaluate().
void note_extrema(const Moment& now, State& state);

/// Notes what the balance of energy lacks: what numerical_loss() is below zero [J].
void note_balance(double numerical_loss, State& state);

/// What moved, fell or was put in at any time since the start [J]: what a loss is much or little
/// of. A press that was lifted again has taken back what it had put in.
double turned_over(const State& state);

/// Whether nothing has moved for a tenth of the run so far, but for what does not count.
bool is_at_rest(const State& state);

/// Kinetic energy at velocities that Newton's iteration does not tell from rest [J].
/// @param step  [s]
double energy_of_tolerance(const Model& model, double step);

}  // namespace articular::sim
