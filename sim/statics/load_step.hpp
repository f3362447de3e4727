#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sim/assembly/rigid_body_modes.hpp"
#include "sim/model/state.hpp"
#include "sim/statics/equilibrium.hpp"

namespace articular::sim {

/// One iteration of a static analysis, for convergence.csv.
struct ConvergenceRow {
  double t = 0;        // [s] of the load step
  int solution = 0;    // of this load step: those with pseudo-time damping count each
  double damping = 0;  // [1/s²]
  int iteration = 0;   // of this solution
  NewtonIteration newton;
};

/// What a load step needs of contact search. All may be empty: nothing can touch.
struct ContactHooks {
  /// @param motion  [m] how far things may move until the next time
  std::function<void(const Configuration& where, double motion)> find;
  /// Looks again where things may leave, by this motion, what the last find() covers.
  ContactCover cover;
  /// Contacts found where find() looked hold at the state evaluated last.
  std::function<bool()> covered;
};

/// A load step that was reached, or why not.
struct LoadStepResult {
  bool reached = false;
  double settling_loss = 0;  // [J] work against pseudo-time damping while something was loose
  std::optional<RigidBodyMode> loose;  // what nothing holds where it ended
  Snap snap;                           // without time and loss
  int iterations = 0;                  // of Newton, of all solutions
};

/// Equilibrium under the loads of time t, from the one that y is at t_before.
///
/// Where a rigid motion has no resistance (nothing touches yet), or the iteration fails, bodies are
/// carried in pseudo-time: each solution with damping d moves them on from rest by what the forces
/// do in a time d^(−1/2); then d falls, and contacts are looked for again. The load step is reached
/// when the forces balance without damping.
/// @param most_iterations  once they were taken, no more solutions begin and it is not reached
LoadStepResult take_load_step(const Model& model, Dynamics& dynamics, Equilibrium& equilibrium,
                              const ContactHooks& contacts, double t_before, double t,
                              int most_iterations, Eigen::VectorXd& y,
                              std::vector<ConvergenceRow>& convergence);

}  // namespace articular::sim
