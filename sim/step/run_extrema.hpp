#pragma once

#include "sim/assembly/moment.hpp"
#include "sim/model/state.hpp"

namespace articular::sim {

/// Notes in state.extrema, and max_penetration, what is worse than it has been, at the last
/// evaluate().
void note_extrema(const Moment& now, State& state);

/// Notes what the balance of energy lacks: what numerical_loss() is below zero [J].
void note_balance(double numerical_loss, State& state);

/// Notes where the last step's part of numerical_loss() went: from a motion that it follows, of
/// which it takes little, or from one too fast for it, a vibration or an impact that ends at once.
/// @param kinetic  energy now [J]
void note_damping(double numerical_loss, double kinetic, State& state);

/// What the time integration took from motion that is a result [J]; 0 where none is. It is one
/// where bodies began with half of the energy as velocity: all of the loss counts then. And it is
/// one where things moved for half of the time: what was taken from motion that steps follow. What
/// else a scheme takes brings bodies to rest, where damping changes nothing.
double taken_from_results(const State& state);

/// What moved, fell or was put in at any time since the start [J]: what a loss is much or little
/// of. A press that was lifted again has taken back what it had put in.
double turned_over(const State& state);

/// Kinetic energy at velocities that Newton's iteration does not tell from rest [J].
/// @param step  [s]
double energy_of_tolerance(const Model& model, double step);

}  // namespace articular::sim
