#pragma once

#include "sim/contact_search.hpp"
#include "sim/dynamics.hpp"
#include "sim/integrator.hpp"
#include "sim/state.hpp"

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
  double collision_update = 0, collision_traversal = 0, collision_narrow = 0;
  double elastic_force = 0, contact_force = 0, assembly = 0, solve = 0;
};

/// Scratch memory, trees, integrator and factors for one model.
class Stepper {
 public:
  explicit Stepper(const Model& model);

  State initial();

  /// One step of Listing 1.5.1 towards t_target: find contacts, advance, check, account. Halves the
  /// step as often as needed.
  /// @throws SimulationError when the step would get smaller than the scenario's least one
  void step(State& state, double t_target);

  /// A restart point: drops everything that a run resumed from `state` would not have.
  void restart(const State& state);

  /// Forces, lines and contacts at the state of the last step() or restart().
  const Dynamics& dynamics() const { return *dynamics_; }
  StoredEnergy stored_energy() const;
  std::vector<Positions> contact_forces() const;  // at colliders' nodes, by body [N]
  PhaseTimes times();

 private:
  void find_contacts(const Configuration& where, double margin);
  void remember_start(const State& state);
  bool try_step(State& state, double h);
  double margin_for(double stray) const;
  void account(State& after);
  [[noreturn]] void fail(const State& state, double h) const;

  const Model& model_;
  std::unique_ptr<ContactSearch> search_;
  std::unique_ptr<Dynamics> dynamics_;
  std::unique_ptr<ImplicitIntegrator> integrator_;
  Eigen::VectorXd y_;  // being tried

  /// What the step started from, for the prediction and the ledger.
  Configuration start_;
  std::vector<LineState> lines_before_;
  std::vector<Vec3> loads_before_;
  Eigen::VectorXd forces_before_;
  double t_before_ = 0;
};

}  // namespace articular::sim
