#pragma once

#include <Eigen/Core>
#include <memory>

#include "fem/solver/linear_solver.hpp"
#include "sim/assembly/dynamics.hpp"

namespace articular::sim {

/// How a state changes with some inputs, to first order: a column each. Inputs are whatever
/// excitations depend on.
struct StateResponse {
  Eigen::MatrixXd motion;      // of the unknown blocks [m, rad]
  Eigen::MatrixXd velocity;    // of the same [m/s, rad/s]; 0 in a static analysis
  Eigen::MatrixXd activation;  // of each muscle
  /// The largest part of the forces that was left unbalanced when a column was solved for.
  double error = 0;
};

/// Of a state that depends on none of them.
StateResponse no_response(const Model& model, Eigen::Index inputs);

/// Two states, a little below and above y along one input.
struct NearbyStates {
  Eigen::VectorXd below, above;
  double apart = 0;  // in the input
};

/// They are so near that forces are linear between them. Activations stay within 0 and 1, beyond
/// which muscles do not pull any less or more.
NearbyStates nearby_states(const Model& model, const Eigen::VectorXd& y,
                           const StateResponse& response, Eigen::Index input);

/// Responses by Newton's matrix, which is factored once for all inputs. The matrix lacks some
/// terms, such as the descending part of force-length. So what it leaves of the balance is found
/// from forces on both sides along the response, and solved for again.
class ResponseSolver {
 public:
  ResponseSolver(const Model& model, Dynamics& dynamics);

  /// Of an equilibrium y, whose activations are its excitations: K x = ∂f/∂a a.
  /// @param excitation  change of the excitations, muscles x inputs
  /// @return false where the matrix can't be solved
  [[nodiscard]] bool follow_equilibrium(const Eigen::VectorXd& y, double t,
                                        const Eigen::MatrixXd& excitation, StateResponse& response);
  /// Of the state y that a step from t_before to t led to, by the equations of implicit Euler. What
  /// relaxing tissue remembers is left out. So are terms of second order in a step's turn: the
  /// slopes of a bone that turns fast are off by half a percent after twenty steps (its test).
  /// @param response  of the state before it on entry
  [[nodiscard]] bool follow_step(const Eigen::VectorXd& y, double t_before, double t,
                                 const Eigen::MatrixXd& excitation, StateResponse& response);

 private:
  struct Column {
    Eigen::VectorXd motion, velocity, activation;
  };
  [[nodiscard]] bool factor(const SystemScale& scale);
  Eigen::VectorXd force_change(const Column& column);
  Eigen::MatrixXd pulls(const Eigen::MatrixXd& activation);
  template <class Residual>
  [[nodiscard]] bool solve(const Residual& residual, Eigen::VectorXd& x, double& error);

  const Model& model_;
  Dynamics& dynamics_;
  std::unique_ptr<fem::LinearSolver> solver_;
  Eigen::VectorXd y_;
  Conditions conditions_;
  double t_ = 0;
};

}  // namespace articular::sim
