#include "sim/run/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>

#include "sim/base/atomic_file.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/build/build_model.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/output/convergence.hpp"
#include "sim/output/frames.hpp"
#include "sim/output/history.hpp"
#include "sim/output/run_warnings.hpp"
#include "sim/output/summary.hpp"
#include "sim/step/failure_diagnosis.hpp"
#include "sim/step/overlap_resolution.hpp"
#include "sim/step/run_extrema.hpp"

namespace articular::sim {
namespace {

/// Frames between two checkpoints where the scenario gives no interval. What lies between two
/// frames of a static analysis may take minutes.
int frames_per_checkpoint(const Model& model) { return model.is_static ? 1 : 10; }

/// Multiples of an interval are computed, not summed: a resumed run has the same ones.
struct Schedule {
  double interval = 0;
  /// The first multiple after t.
  double next(double t) const {
    return interval * (std::floor(t / interval * (1 + 1e-12) + 1e-9) + 1);
  }
  bool due(double t) const {
    const double count = t / interval;
    return std::abs(count - std::round(count)) < 1e-9 * std::max(1.0, count);
  }
};

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Run {
 public:
  Run(const Scenario& scenario, const Model& model, const RunOptions& options)
      : scenario_(scenario),
        model_(model),
        options_(options),
        writer_(options.directory, scenario.name, scenario.output.length_unit),
        stepper_(model, step_settings(scenario)),
        history_(model, scenario.output.length_unit),
        kinks_(kink_times(model, scenario.duration)),
        frames_{scenario.output.interval},
        checkpoints_{scenario.output.checkpoint_interval.value_or(frames_per_checkpoint(model) *
                                                                  scenario.output.interval)} {}

  RunOutcome go() {
    const auto start = std::chrono::steady_clock::now();
    const double duration = scenario_.duration;
    RunOutcome outcome = RunOutcome::Finished;
    std::string how = "finished";
    const auto finish = [&] {
      WallTimes wall;
      wall.output = output_seconds_;
      wall.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      write_history();
      if (options_.warn)
        for (const std::string& warning : run_warnings(model_, state_, stepper_))
          options_.warn(warning);
      write_text_file(
          options_.directory / "summary.json",
          summary_json(scenario_, model_, state_, stepper_, stepper_.times(), wall, how));
    };
    stepper_.set_watch(options_.after_iteration);
    stepper_.set_stop(options_.is_to_stop);
    try {
      begin();
      while (state_.t < duration) {
        stepper_.step(state_, next_event());
        observe();
        if (options_.after_step && options_.after_step(state_, duration) && state_.t < duration) {
          outcome = RunOutcome::Interrupted;
          how = "interrupted";
          break;
        }
      }
    } catch (const Interruption&) {
      outcome = RunOutcome::Interrupted;
      how = "interrupted";
      stepper_.restart(state_);  // energies are those of the last step that was done
    } catch (const SimulationError& error) {
      how = error.what();
      convergence_ += convergence_rows(stepper_.take_convergence(), scenario_.output.length_unit);
      finish();
      throw;
    }
    finish();
    return outcome;
  }

 private:
  std::filesystem::path checkpoint_file() const {
    return options_.directory / "checkpoint" / "state.bin";
  }

  /// A law that can't be turned inside out, a start that is: nothing to begin from.
  void check_start() const {
    const Moment& now = stepper_.now();
    if (now.forces.allFinite() && std::isfinite(stepper_.stored_energy().total())) return;
    throw InputError({scenario_.file.string()},
                     "forces at the start are not finite" +
                         failure_diagnosis(model_, now.configuration, now.configuration));
  }

  void begin() {
    state_ = stepper_.initial();
    fingerprint_ = fingerprint(scenario_, model_);
    if (options_.resume) {
      if (auto stored = read_checkpoint(checkpoint_file(), fingerprint_)) {
        state_ = std::move(*stored);
        stepper_.restart(state_);
        check_start();
        writer_.resume_at(state_.t);
        history_.resume(read_text(options_.directory / "history.csv"), state_.t);
        if (is_static()) convergence_ = rows_until(read_text(convergence_file()), state_.t);
        return;
      }
    }
    check_start();
    // Nothing of an earlier run must stand beside what this one leaves when it is interrupted.
    std::error_code ignored;
    std::filesystem::remove(checkpoint_file(), ignored);
    std::filesystem::remove(options_.directory / (scenario_.name + ".pvd"), ignored);
    resolve_initial_overlaps();
    history_.record(state_, stepper_);
    output_frame();
  }

  void resolve_initial_overlaps() {
    state_.overlap_resolution =
        resolve_overlaps(scenario_, model_, state_.y, options_.after_iteration);
    if (state_.overlap_resolution.overlaps.empty()) return;
    stepper_.restart(state_);
    state_.extrema = {};  // overlaps before the start are told as their resolution
    state_.max_penetration = 0;
    note_extrema(stepper_.now(), state_);
    state_.energy.start = stepper_.stored_energy().total();
    if (options_.after_overlap_resolution)
      options_.after_overlap_resolution(state_.overlap_resolution);
  }

  double next_event() const {
    double next =
        std::min({scenario_.duration, frames_.next(state_.t), checkpoints_.next(state_.t)});
    const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), state_.t * (1 + 1e-12));
    if (kink != kinks_.end()) next = std::min(next, *kink);
    return next;
  }

  bool is_static() const { return model_.is_static; }
  std::filesystem::path convergence_file() const { return options_.directory / "convergence.csv"; }

  void observe() {
    convergence_ += convergence_rows(stepper_.take_convergence(), scenario_.output.length_unit);
    history_.record(state_, stepper_);
    if (!is_static()) note_balance(numerical_loss(state_, stepper_.stored_energy()), state_);
    const bool end = state_.t >= scenario_.duration;
    if (frames_.due(state_.t) || end) output_frame();
    if (checkpoints_.due(state_.t) && !end) {
      const Stopwatch watch(output_seconds_);
      write_history();
      std::error_code existing;
      std::filesystem::create_directories(checkpoint_file().parent_path(), existing);
      write_checkpoint(checkpoint_file(), state_, fingerprint_);
      stepper_.restart(state_);
    }
  }

  void output_frame() {
    const Stopwatch watch(output_seconds_);
    write_frame(model_, stepper_, scenario_.output.contact_surfaces, state_.frames, state_.t,
                writer_);
    write_history();
    ++state_.frames;
  }

  void write_history() const {
    write_text_file(options_.directory / "history.csv", history_.text());
    if (is_static())
      write_text_file(convergence_file(),
                      convergence_header(scenario_.output.length_unit) + convergence_);
  }

  const Scenario& scenario_;
  const Model& model_;
  const RunOptions& options_;
  FrameWriter writer_;
  Stepper stepper_;
  History history_;
  std::vector<double> kinks_;
  Schedule frames_, checkpoints_;
  State state_;
  std::string fingerprint_;
  std::string convergence_;  // rows
  double output_seconds_ = 0;
};

}  // namespace

std::vector<double> kink_times(const Model& model, double duration) {
  std::vector<double> times;
  const auto add = [&](const std::vector<double>& more) {
    times.insert(times.end(), more.begin(), more.end());
  };
  for (const MuscleModel& muscle : model.muscles) add(muscle.given.excitation.time);
  for (const ForceModel& force : model.forces) add(force.profile.time);
  for (const RigidBody& rigid : model.rigid_bodies)
    if (rigid.motion) add(rigid.motion->time);
  std::erase_if(times, [&](double t) { return t <= 0 || t >= duration; });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

RunOutcome run(const Scenario& scenario, const Model& model, const RunOptions& options) {
  return Run(scenario, model, options).go();
}

}  // namespace articular::sim
