#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>

#include "sim/assembly/dynamics.hpp"
#include "sim/base/error.hpp"
#include "sim/model/state.hpp"
#include "sim/model/step_settings.hpp"

namespace articular::sim {

/// Advances y' = rate(t, y) by ARKODE.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;

  /// One step from t by h; a scheme that chooses its steps takes one of at most h.
  /// @return the time reached; nothing if it did not succeed: y is as before
  [[nodiscard]] virtual std::optional<double> advance(Eigen::VectorXd& y, double t, double h) = 0;

  /// Drops what a run that is resumed here would not have.
  /// @param next_step  [s] to begin with, of a scheme that chooses its steps
  virtual void restart(double next_step) = 0;

  /// The step that it would take next [s]; nothing if steps are fixed.
  virtual std::optional<double> next_step() const { return std::nullopt; }

  /// Asked at each evaluation of the rate: where the answer is true, advance() throws Interruption.
  void set_stop(std::function<bool()> is_to_stop) { is_to_stop_ = std::move(is_to_stop); }
  /// @throws Interruption
  void stop_if_asked() const {
    if (is_to_stop_ && is_to_stop_()) throw Interruption();
  }

  virtual const SolverCounts& counts() const = 0;
  /// Wall time of factorizations and solutions.
  virtual double solve_seconds() const = 0;

 private:
  std::function<bool()> is_to_stop_;
};

/// The scheme that the settings ask for.
std::unique_ptr<TimeIntegrator> make_time_integrator(const Model& model, Dynamics& dynamics,
                                                     const StepSettings& settings);

}  // namespace articular::sim
