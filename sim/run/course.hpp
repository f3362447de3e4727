#pragma once

#include <functional>
#include <vector>

#include "sim/model/step_settings.hpp"
#include "sim/statics/equilibrium.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

/// Times at which a step must end: kinks of curves and motions, within (0, duration).
/// @param duration  [s]
std::vector<double> kink_times(const Model& model, double duration);

/// Multiples of an interval are computed, not summed: a resumed run has the same ones.
struct Schedule {
  double interval = 0;          // [s]
  double next(double t) const;  // the first multiple after t
  bool is_due(double t) const;  // t is one
};

/// A run but for its results: from the start through every step to the scenario's duration. Steps
/// end at kinks, frames and checkpoints of the scenario, whether or not these are written, so that
/// all who follow it have the same states.
class Course {
 public:
  /// @param scenario  that the model was built from; both must outlive this
  Course(const Scenario& scenario, const Model& model);

  /// See Stepper. A step that is interrupted leaves the state as before; go on with restart().
  void set_watch(const IterationWatch& watch);
  void set_stop(const std::function<bool()>& is_to_stop) { stepper_.set_stop(is_to_stop); }

  /// To the start. @throws InputError where forces there are not finite
  void begin();
  /// Pushes bodies apart that overlap at the start. @return whether any did
  bool set_apart();
  /// To the state of a checkpoint. @throws InputError as begin() does
  void go_on(State state);

  bool is_done() const { return state_.t >= scenario_.duration; }
  /// To the next time at which a step ends. Where a checkpoint is due then, restart() must follow.
  /// @throws SimulationError, Interruption  see Stepper
  void step();
  bool frame_is_due() const { return is_done() || frames_.is_due(state_.t); }
  bool checkpoint_is_due() const { return !is_done() && checkpoints_.is_due(state_.t); }
  void restart() { stepper_.restart(state_); }

  const State& state() const { return state_; }
  State& state() { return state_; }
  const Stepper& stepper() const { return stepper_; }
  Stepper& stepper() { return stepper_; }

 private:
  void check_forces() const;
  double next_event() const;

  const Scenario& scenario_;
  const Model& model_;
  Stepper stepper_;
  IterationWatch watch_;
  std::vector<double> kinks_;
  Schedule frames_, checkpoints_;
  State state_;
};

}  // namespace articular::sim
