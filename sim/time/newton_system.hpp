#pragma once

#include <limits>
#include <optional>

#include "sim/assembly/dynamics.hpp"
#include "sim/assembly/pressure_prediction.hpp"
#include "sim/assembly/relaxation_rows.hpp"
#include "sim/assembly/solver_setup.hpp"
#include "sim/assembly/tissue_damping.hpp"
#include "sim/contact/contact_forecast.hpp"
#include "sim/model/state.hpp"
#include "sim/time/anderson.hpp"

namespace articular::sim {

/// The linear solves of Newton's iteration for y' = rate(t, y), reduced to block velocities: with
/// δx = b_x + γ δv for the kinematic rows (rotations: δθ in place of quaternions) and
/// w = δv + b_x/γ,
///   (M + γ D + γ² K) w = M (b_v + b_x/γ) + D b_x + γ ∂f/∂a δa,   δx = γ w.
/// Gyroscopic terms are left out of the matrix, never out of the residual.
///
/// They are solved at the state that `dynamics` evaluated last. A matrix is
/// kept from one iteration, and from one step, to the next as long as the residual falls fast with
/// it.
class NewtonSystem {
 public:
  NewtonSystem(const Model& model, Dynamics& dynamics);

  /// Drops what the linear solver knows of earlier steps.
  void restart();
  /// A new step begins; with `keep_matrix` the last one's matrix may serve its first iteration.
  /// @param tangent  Projected: does without the consistent one
  void begin_step(bool keep_matrix, fem::Tangent tangent);
  /// From now on, corrections from this one of an iteration on (0: all of them) go as far as a line
  /// search lets them (line_search.hpp). Near the solution that ends cycles of contacts that open
  /// and close; afar, it would creep from each contact that closes to the next.
  void search_lines(int from) { searches_from_ = from; }
  /// A step ends where forces were evaluated last: the pressures there are those to begin with.
  void end_step();
  /// The iteration of one of the step's stages begins. Where it is slow it is accelerated
  /// (anderson.hpp).
  void begin_iteration();

  /// Solves (I − γ ∂rate/∂y) x = b, reduced to block velocities.
  /// @param conditions  of the step, for trials of a line search
  /// @return false when the matrix can't be made positive definite or the solver fails
  [[nodiscard]] bool solve(const double* y, double gamma, const double* b, double* x,
                           const Conditions& conditions, SolverCounts& counts);

  /// This step did without a consistent matrix: with the projected one it would go the same way.
  bool used_projected_only() const { return !used_consistent_; }
  /// The last correction is not Newton's own: however small, it says nothing of convergence.
  bool changed() const { return changed_; }
  /// body_imbalance() of the state that the last solve() corrected.
  double imbalance() const { return imbalance_; }
  double solve_seconds() const { return solve_seconds_; }

 private:
  /// Pressures go along with the correction w.
  void predict_pressures(double gamma);
  bool needs_matrix(double gamma) const;
  /// A body that was touched where the matrix was taken, whose contact would hold it now, is not.
  bool has_parted() const;
  /// Part of the correction w that stays within Model::trusted_motion.
  double step_fraction(double gamma) const;
  /// w is far below the tolerance, and what touches in balance.
  bool is_at_end(double gamma) const;
  /// Part of the correction w to take, which is x for the whole state y; at most the given one.
  double searched_fraction(double most, const double* y, double gamma, const double* x,
                           const Conditions& conditions, SolverCounts& counts);
  /// Makes w better where the iteration is slow. @return whether it did
  bool accelerate(double gamma);
  /// How far w moves a node or rigid body at most [m].
  double largest_motion(double gamma) const;
  [[nodiscard]] bool prepare(double gamma, fem::Tangent tangent, SolverCounts& counts);
  [[nodiscard]] bool prepare(const NewtonEquations& equations, double gamma, SolverCounts& counts);
  /// w for a right-hand side r, its free part.
  [[nodiscard]] bool solve_linear(const Eigen::VectorXd& r, SolverCounts& counts);
  /// w = A⁻¹ r with the matrix that is factored.
  [[nodiscard]] bool solve_symmetric(const Eigen::VectorXd& r, Eigen::VectorXd& w,
                                     SolverCounts& counts);
  /// w, with the consistent matrix if it is positive definite, else with the projected one.
  [[nodiscard]] bool find_correction(double gamma, SolverCounts& counts);
  /// Solves for w anew, with contact as it opens and closes on the way (contact_forecast.hpp),
  /// where forces would else be off by more than what w corrects.
  void correct_for_contact(double gamma, SolverCounts& counts);
  /// w with contact as it is foreseen.
  [[nodiscard]] bool solve_foreseen(double gamma, const GroupChanges& changes,
                                    SolverCounts& counts);
  /// Its matrix.
  [[nodiscard]] bool prepare_foreseen(double gamma, const GroupChanges& changes,
                                      SolverCounts& counts);

  const Model& model_;
  Dynamics& dynamics_;
  std::unique_ptr<fem::LinearSolver> solver_;
  const FrictionCoupling* friction_ = nullptr;  // of the matrix that is factored
  ContactForecast forecast_;
  TissueDamping damping_;
  RelaxationRows relaxation_;
  std::optional<PressurePrediction> start_;  // at the step's start, where that is known
  PressurePrediction prediction_;            // along the last correction
  PredictedPressures pressures_;             // that the next matrix takes; none: of the positions
  Eigen::VectorXd velocity_rhs_, mass_rhs_, shift_, pull_, w_, velocity_change_;
  Eigen::VectorXd way_, foreseen_rhs_, plain_w_;         // of correct_for_contact()
  Eigen::VectorXd weighted_, forces_, trial_;            // of the line search
  double gamma_ = 0;                                     // of the matrix that is factored; 0: none
  std::uint64_t pattern_ = 0;                            // of that matrix
  std::vector<double> touching_;                         // force on bodies then [N]
  fem::Tangent tangent_ = fem::Tangent::Consistent;      // of that matrix
  fem::Tangent first_ = fem::Tangent::Consistent;        // to try in this step
  bool is_new_ = false;                                  // the matrix is of this iteration
  bool used_consistent_ = false;                         // in this step
  int iteration_ = 0;                                    // in this step
  bool changed_ = false;                                 // the last correction, see changed()
  int correction_ = 0;                                   // of this iteration
  int searches_from_ = std::numeric_limits<int>::max();  // see search_lines()
  Anderson anderson_;
  double imbalance_ = 0;                     // see imbalance()
  double residual_ = 0, last_residual_ = 0;  // of this iteration and the one before
  double solve_seconds_ = 0;
};

}  // namespace articular::sim
