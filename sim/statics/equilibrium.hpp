#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sim/assembly/dynamics.hpp"
#include "sim/model/state.hpp"
#include "sim/model/step_settings.hpp"
#include "sim/statics/supports.hpp"

namespace articular::sim {

/// One iteration of Newton's method.
struct NewtonIteration {
  double residual = 0;    // largest force that is not balanced, relative to the largest force
  double correction = 0;  // [m] largest displacement
  double fraction = 1;    // of the correction that the line search took
  std::vector<SupportChange> changes = {};  // where it begins, since the one before
};

/// Told of each iteration, towards the loads of t [s]; true asks to stop: Interruption is thrown.
using IterationWatch = std::function<bool(double t, const NewtonIteration&)>;

/// Told before things move from where they are: afterwards contacts are known wherever they may go.
/// @param motion  [m] that nothing moves farther than
using ContactCover = std::function<void(const Configuration& where, double motion)>;

/// Equilibrium of forces by KINSOL: Newton's iteration on the displacements u of nodes and rigid
/// bodies (rotations: rotation vectors) from where they are,
///
///   r(u) = −f(u) + d M u = 0,
///
/// with the matrix K + d M renewed in each iteration, and a line search on the work of the residual
/// along the correction, δ·r, which for conservative forces is the slope of the potential energy
/// [Crisfield 1991, ch. 9.4]. d = 0 is equilibrium; d > 0 is one step of pseudo-time of length
/// d^(−1/2) from rest, for what nothing holds.
///
/// [Crisfield 1991] Crisfield. Non-linear Finite Element Analysis of Solids and Structures, vol. 1.
class Equilibrium {
 public:
  Equilibrium(const Model& model, Dynamics& dynamics, const StepSettings& settings);
  ~Equilibrium();
  Equilibrium(const Equilibrium&) = delete;
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// @param y        where to begin on entry, the solution on exit; velocities are not touched
  /// @param t        [s] of loads and motions
  /// @param damping  d [1/s²]
  /// @param conditions  but for soft contact and pressures, which the iteration chooses
  /// @param cover    empty: nothing can touch, or contacts are to stay those that were found
  /// @return false when the iteration did not converge; y is as before
  [[nodiscard]] bool solve(Eigen::VectorXd& y, double t, double damping,
                           const Conditions& conditions = {}, const ContactCover& cover = {});
  /// Moves y by (K + d M)⁻¹ f, where the last Dynamics::evaluate() was.
  /// @param f        block forces [N]
  /// @param damping  d [1/s²]
  /// @return false when that can't be solved; y is as before
  [[nodiscard]] bool yield(const Eigen::VectorXd& f, double damping, Eigen::VectorXd& y);
  /// Makes (K + d M) of the last Dynamics::evaluate() ready, or the projected matrix where that
  /// one is not positive definite.
  /// @return false when neither can be factored
  [[nodiscard]] bool linearise(double damping);
  /// Whether every small motion from the last Dynamics::evaluate() meets a force that drives it
  /// back, beside that of `damping` [1/s²] by mass: the consistent matrix is positive definite.
  bool is_stable(double damping);
  /// x = (K + d M)⁻¹ f, with the matrix that was made ready last.
  /// @param f  block forces [N]  @param[out] x  of the unknown blocks [m, rad]
  [[nodiscard]] bool respond(const Eigen::VectorXd& f, Eigen::VectorXd& x);
  void set_watch(IterationWatch watch);
  /// Asked before each evaluation, assembly, factorization and solution, any of which may take
  /// long: where the answer is true, an Interruption is thrown, and y is as before.
  void set_stop(std::function<bool()> is_to_stop);
  /// Drops what the linear solver knows of earlier ones.
  void restart();

  /// Largest force, or moment by the rigid body's size, that is not balanced at the last
  /// Dynamics::evaluate() [N].
  double residual() const;
  /// Whether that is at most this part of the largest force. Forces that are no numbers are not.
  bool is_balanced(double part) const;
  /// The largest acceleration of a node or rigid body there [m/s²].
  double largest_acceleration() const;

  /// Of the last solve().
  const std::vector<NewtonIteration>& iterations() const;
  const SolverCounts& counts() const;
  double solve_seconds() const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

/// A residual below this part of the largest force is equilibrium.
constexpr double kBalanced = 1e-6;

}  // namespace articular::sim
