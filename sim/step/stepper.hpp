#pragma once

#include "sim/assembly/dynamics.hpp"
#include "sim/assembly/energies.hpp"
#include "sim/assembly/reactions.hpp"
#include "sim/assembly/tissue_damping.hpp"
#include "sim/contact/contact_search.hpp"
#include "sim/contact/crossing.hpp"
#include "sim/model/state.hpp"
#include "sim/statics/load_step.hpp"
#include "sim/step/equilibrium_diagnosis.hpp"
#include "sim/step/state_response.hpp"
#include "sim/time/time_integrator.hpp"

namespace articular::sim {

/// Energies stored now [J].
struct StoredEnergy {
  double kinetic = 0, elastic = 0, gravity = 0, contact = 0;
  double lines = 0;  // ligaments and passive muscles
  double total() const { return kinetic + elastic + gravity + contact + lines; }
};

/// What the balance start + work − losses = stored energy leaves: dissipation of the time
/// integration (positive: lost) [J].
double numerical_loss(const State& state, const StoredEnergy& now);

/// Wall time by phase [s].
struct PhaseTimes {
  double collision_update = 0, collision_traversal = 0, collision_narrow = 0, crossings = 0;
  double elastic_force = 0, contact_force = 0, assembly = 0, solve = 0;
};

/// Why a step was not taken.
enum class Rejection { NoConvergence, NoEquilibrium, TooFast, NotFinite, Crossing };

/// Newton's iterations that a load step may take, with its shorter tries, until a part of it is
/// reached. Shipped scenarios take at most 130 with 20 a solution, and a block that folds between
/// plates more than a thousand; who allows more in each allows more in all.
int most_load_step_iterations(const StepSettings& settings);

/// Scratch memory, trees, integrator and factors for one model.
class Stepper {
 public:
  Stepper(const Model& model, const StepSettings& settings);

  State initial();

  /// One step of Listing 1.5.1 towards t_target: find contacts, advance (or, in a static analysis,
  /// find equilibrium under the loads of its end), check, account. Halves the step as often as
  /// needed, also where surfaces have gone through each other.
  /// @throws SimulationError when that does not help: the step would get shorter than 2^-13 of the
  /// one that was asked for, or no part of a load step was reached in most_load_step_iterations()
  void step(State& state, double t_target);

  /// Of a static analysis: told of each iteration, see Equilibrium. step() then throws Interruption
  /// where it asks to stop: the state is as before, but for counts; go on with restart().
  void set_watch(IterationWatch watch);
  /// Asked within a step, at each evaluation of forces, and in a static analysis before each
  /// assembly, factorization and solution too; likewise.
  void set_stop(const std::function<bool()>& is_to_stop);

  /// Takes a response of the state before the last step() over to the state that it led to: to the
  /// equilibrium there, or by one implicit Euler step of the same length.
  /// @param excitation  how excitations at the step's end change, muscles x inputs
  /// @return false where the matrix there can't be solved
  [[nodiscard]] bool follow(const State& state, const Eigen::MatrixXd& excitation,
                            StateResponse& response);
  /// now() is y at the time of the state, a little beside that of the last step(), so that
  /// contacts found for it hold. look_at(state, state.y) must follow before anything else.
  void look_at(const State& state, const Eigen::VectorXd& y);

  /// A restart point: drops everything that a run resumed from `state` would not have.
  void restart(const State& state);

  const StepSettings& settings() const { return settings_; }
  /// Forces, lines and contacts at the state of the last step() or restart().
  const Dynamics& dynamics() const { return *dynamics_; }
  const Moment& now() const { return dynamics_->now(); }
  const StoredEnergy& stored_energy() const;
  std::vector<Positions> contact_forces() const;  // at colliders' nodes, by body [N]
  PhaseTimes times();
  /// Since it was made; those of State::counts are of the steps alone.
  EvaluationCounts evaluations() const;

  /// Of a static analysis: every iteration since the last call.
  std::vector<ConvergenceRow> take_convergence() { return std::exchange(convergence_, {}); }
  /// Bodies that nothing holds, though nothing drives them either: they stay where they were.
  const std::vector<RigidBodyMode>& indifferent() const { return indifferent_; }
  /// At the end of a static analysis: whether a small push would let things go on from where they
  /// are. Not asked of what nothing holds.
  void judge_stability();
  bool is_unstable() const { return is_unstable_; }
  /// What no force resists where things are now, see find_rigid_body_mode().
  std::optional<RigidBodyMode> loose() { return find_rigid_body_mode(model_, *dynamics_); }

 private:
  void find_contacts(const Configuration& where, double margin);
  void remember_start(const State& state);
  bool try_step(State& state, double h);
  bool is_finite() const;
  bool is_exhausted() const;
  bool crosses(State& state);
  bool holds_with_contacts_of_end(const State& state, double t);
  bool try_time_step(State& state, double h);
  bool try_load_step(State& state, double h);
  SolverCounts solver_counts() const;
  bool has_parted(int body) const;
  void account(State& after);
  void note_snap(State& after) const;
  void crush_boluses(State& state) const;
  std::vector<BolusState> about_to_be_crushed(const State& state) const;
  double work_on_supports(double t) const;
  void stop_where_energy_is_made(const State& state) const;
  [[noreturn]] void fail(const State& state, double h);
  EquilibriumDiagnosis why_no_equilibrium(const State& state, double h);

  const Model& model_;
  const StepSettings settings_;
  std::unique_ptr<ContactSearch> search_;
  std::unique_ptr<CrossingSearch> crossings_;
  std::unique_ptr<Dynamics> dynamics_;
  TissueDamping damping_;
  std::unique_ptr<TimeIntegrator> integrator_;  // dynamic analysis
  std::unique_ptr<Equilibrium> equilibrium_;    // static analysis
  std::unique_ptr<ResponseSolver> response_;    // once it is asked for
  std::vector<ConvergenceRow> convergence_;
  std::optional<RigidBodyMode> loose_;  // in the last load step: what nothing holds
  std::vector<RigidBodyMode> indifferent_;
  Snap snap_;  // in the last load step
  bool is_unstable_ = false;
  /// Of Newton's iterations, all towards the load step that is being tried.
  std::size_t first_row_ = 0;
  int iterations_ = 0;
  Eigen::VectorXd y_;                         // being tried
  Eigen::VectorXd forces_at_end_;             // of the step that was tried
  Rejection why_ = Rejection::NoConvergence;  // the last step that was not taken
  std::optional<Crossing> crossing_;          // in that step
  double crossing_seconds_ = 0;               // of looking for them

  /// What the step started from, for the prediction and the ledger.
  Configuration start_;
  std::vector<LineState> lines_before_;
  std::vector<Vec6> reactions_before_;       // of held rigid bodies that are driven, by rigid body
  std::vector<Vec3> support_forces_before_;  // without inertia, by support
  Eigen::VectorXd forces_before_;
  std::vector<double> touched_before_;  // force on bodies [N]
  ContactDepths depths_before_;         // of any point
  double t_before_ = 0;
  double stored_before_ = 0, loss_before_ = 0;  // [J] of a load step
  mutable StoredEnergy stored_;                 // of the moment with that number
  mutable std::int64_t stored_moment_ = 0;      // none yet
  double damping_before_ = 0;                   // [W]
  double contact_power_before_ = 0;             // [W]
  std::vector<double> fibre_energy_before_;     // [J] per activation, of each tissue
};

}  // namespace articular::sim
