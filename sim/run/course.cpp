#include "sim/run/course.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/step/failure_diagnosis.hpp"
#include "sim/step/overlap_resolution.hpp"
#include "sim/step/run_extrema.hpp"

namespace articular::sim {
namespace {

/// Frames between two checkpoints where the scenario gives no interval. What lies between two
/// frames of a static analysis may take minutes.
int frames_per_checkpoint(const Model& model) { return model.is_static ? 1 : 10; }

}  // namespace

std::vector<double> kink_times(const Model& model, double duration) {
  std::vector<double> times;
  const auto add = [&](const std::vector<double>& more) {
    times.insert(times.end(), more.begin(), more.end());
  };
  for (const MuscleModel& muscle : model.muscles) add(muscle.given.excitation.time);
  for (const ForceModel& force : model.forces) add(force.profile.time);
  for (const MomentModel& load : model.moments) add(load.profile.time);
  for (const SurfaceLoadModel& load : model.surface_loads) add(load.profile.time);
  for (const GravityModel& gravity : model.gravity) add(gravity.profile.time);
  for (const RigidBody& rigid : model.rigid_bodies)
    if (rigid.motion) add(kinks_of(*rigid.motion));
  for (const SupportModel& support : model.supports)
    if (support.motion) add(kinks_of(*support.motion));
  std::erase_if(times, [&](double t) { return t <= 0 || t >= duration; });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double Schedule::next(double t) const {
  return interval * (std::floor(t / interval * (1 + 1e-12) + 1e-9) + 1);
}

bool Schedule::is_due(double t) const {
  const double count = t / interval;
  return std::abs(count - std::round(count)) < 1e-9 * std::max(1.0, count);
}

Course::Course(const Scenario& scenario, const Model& model)
    : scenario_(scenario),
      model_(model),
      stepper_(model, step_settings(scenario)),
      kinks_(kink_times(model, scenario.duration)),
      frames_{scenario.output.interval},
      checkpoints_{scenario.output.checkpoint_interval.value_or(frames_per_checkpoint(model) *
                                                                scenario.output.interval)} {}

void Course::set_watch(const IterationWatch& watch) {
  watch_ = watch;
  stepper_.set_watch(watch);
}

/// A law that can't be turned inside out, a start that is: nothing to begin from.
void Course::check_forces() const {
  const Moment& now = stepper_.now();
  if (now.forces.allFinite() && std::isfinite(stepper_.stored_energy().total())) return;
  throw InputError({scenario_.file.string()},
                   "forces at the start are not finite" +
                       failure_diagnosis(model_, now.configuration, now.configuration));
}

void Course::begin() {
  state_ = stepper_.initial();
  check_forces();
}

void Course::go_on(State state) {
  state_ = std::move(state);
  stepper_.restart(state_);
  check_forces();
}

bool Course::set_apart() {
  state_.overlap_resolution = resolve_overlaps(scenario_, model_, state_.y, watch_);
  if (state_.overlap_resolution.overlaps.empty()) return false;
  stepper_.restart(state_);
  state_.extrema = {};  // overlaps before the start are told as their resolution
  state_.max_penetration = 0;
  note_extrema(stepper_.now(), state_);
  state_.energy.start = stepper_.stored_energy().total();
  return true;
}

void Course::step() {
  stepper_.step(state_, next_event());
  if (!model_.is_static)
    note_balance(numerical_loss(state_, stepper_.stored_energy()), state_);
  else if (is_done())
    stepper_.judge_stability();
}

double Course::next_event() const {
  double next = std::min({scenario_.duration, frames_.next(state_.t), checkpoints_.next(state_.t)});
  const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), state_.t * (1 + 1e-12));
  if (kink != kinks_.end()) next = std::min(next, *kink);
  return next;
}

}  // namespace articular::sim
