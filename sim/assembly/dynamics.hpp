#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/assembly/newton_matrix.hpp"
#include "sim/assembly/pressure_prediction.hpp"
#include "sim/contact/contact_summary.hpp"

/// Forces, rates and the Newton matrix of the whole scene.
namespace articular::sim {

/// Wall time by phase [s].
struct DynamicsTimes {
  double elastic_force = 0, contact_force = 0, assembly = 0;
};

/// Pressures of smoothed tissues that go along with a correction; none: those of the positions.
struct PredictedPressures {
  const PressurePrediction* prediction = nullptr;
  double part = 0;  // of the way
};

/// Where all that may be driven stands: poses by rigid body, shifts [m] by support.
struct DrivenPlaces {
  std::vector<Pose> poses;
  std::vector<Vec3> shifts;
};

/// What forces are computed for, besides a state and a time.
struct Conditions {
  double step_start = 0;  // [s] accelerations that jump there are those after it
  bool unloaded = false;  // without gravity, loads and lines
  ContactConditions contact = {};
  const DrivenPlaces* driven = nullptr;  // what is driven stands there
  PredictedPressures pressures = {};
};

/// Computes moments and their matrices. Holds what contact remembers from one to the next.
class Dynamics {
 public:
  explicit Dynamics(const Model& model);
  Dynamics(const Dynamics&) = delete;
  Dynamics& operator=(const Dynamics&) = delete;

  /// The candidates for the coming step, which are referred to.
  void set_candidates(std::span<const CandidateList> candidates);
  /// Drops what depends on the past: couplings of earlier candidates, multipliers and duals.
  void forget();

  /// Where the paths of lines that wrap are pulled from, in all that is evaluated from now on.
  void set_wraps(const WrapHistory& wraps);

  /// How far food is crushed, in all that is evaluated from now on.
  void set_boluses(const std::vector<BolusState>& boluses);

  /// Reads the state y at t and computes all forces there.
  const Moment& evaluate(const double* y, double t, const Conditions& conditions = {});
  /// Of the last evaluate().
  const Moment& now() const { return moment_; }
  /// Whose multipliers and duals count from the next evaluate() on.
  ContactResponse& contact() {
    assembled_.reset();
    return contact_;
  }
  /// See contact_summaries().
  std::vector<ContactSummary> contacts() const;
  /// Of one contact of the model.
  ContactSummary contact_summary(ContactId contact) const;

  /// ẏ from the forces of now().
  void rate(const double* y, double* y_dot) const;
  /// r = M b for block velocities b.
  void multiply_mass(const Eigen::VectorXd& b, Eigen::VectorXd& r) const;

  /// Mass, damping and stiffness of now(). Asked again for the same, it does nothing.
  /// @param pressures  what now() has from then on, if any
  NewtonEquations assemble(const SystemScale& scale, fem::Tangent tangent,
                           const PredictedPressures& pressures = {});
  /// The last of these with changes of contact, or a new one where its pattern lacks a coupling.
  /// now() and all arguments but the changes must be as they were then.
  NewtonEquations assemble_again(const GroupChanges& changes, const SystemScale& scale,
                                 fem::Tangent tangent, const PredictedPressures& pressures = {});
  const NewtonMatrix& matrix() const { return matrix_; }
  /// The next matrix has the fibres' force–velocity as it is, not as the last one led to.
  void forget_fibre_rates() { matrix_.forget_fibre_rates(); }

  DynamicsTimes& times() { return times_; }
  /// Since it was made.
  EvaluationCounts evaluations() const;

 private:
  void place(const DrivenPlaces& driven);
  void find_pressure(std::size_t t, const PredictedPressures& pressures);
  void take_pressures(const PredictedPressures& pressures);
  void find_elastic_force(std::size_t k, const double* y, const Conditions& conditions);
  void find_elastic_forces(const double* y, const Conditions& conditions);
  void read_internal_variables(std::size_t t, const double* y);
  void add_loads();
  void find_paths();
  void add_lines();
  /// For Moment::largest_force.
  void note_force(double force);

  const Model& model_;
  ContactResponse contact_;
  NewtonMatrix matrix_;
  Moment moment_;
  std::span<const CandidateList> candidates_;
  WrapHistory wraps_;
  std::vector<BolusState> boluses_;
  /// What the matrix was assembled for, as long as nothing has changed since.
  std::optional<std::pair<SystemScale, fem::Tangent>> assembled_;
  DynamicsTimes times_;
  mutable EvaluationCounts evaluations_;  // but those of the matrix and of contact
};

/// Time constant of a muscle's activation [s] at the state y.
double activation_time(const Model& model, const double* y, double t, int muscle);

}  // namespace articular::sim
