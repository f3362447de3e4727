#include "sim/run/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "sim/base/append_file.hpp"
#include "sim/base/atomic_file.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/build/build_model.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/output/convergence.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/output/frames.hpp"
#include "sim/output/history.hpp"
#include "sim/output/output_size.hpp"
#include "sim/output/results_folder.hpp"
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

/// Rows of the history that wait for the next frame take no more memory than this.
constexpr std::size_t kMostPendingBytes = 1 << 16;

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

class Run {
 public:
  Run(const Scenario& scenario, const Model& model, const RunOptions& options)
      : scenario_(scenario),
        model_(model),
        options_(options),
        folder_(options.directory),
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
      write_and_sync();
      if (options_.warn)
        for (const std::string& warning : run_warnings(model_, state_, stepper_))
          options_.warn(warning);
      if (options_.note)
        for (const std::string& note : run_notes(model_, state_, stepper_)) options_.note(note);
      write_text_file(
          options_.directory / "summary.json",
          summary_json(scenario_, model_, state_, stepper_, stepper_.times(), wall, inputs_, how));
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
      finish();
      throw;
    }
    finish();
    return outcome;
  }

 private:
  std::filesystem::path checkpoints() const { return options_.directory / "checkpoint"; }
  std::string scenario_name() const { return scenario_.file.filename().string(); }

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
    inputs_ = input_files(scenario_);
    fingerprint_ = fingerprint(scenario_, model_);
    // A run that goes on with another arithmetic would have the bits of neither.
    if (scenario_.reproducible) fingerprint_ = "reproducible " + fingerprint_;
    std::optional<Checkpoint> from;
    if (options_.resume) from = read_checkpoint(checkpoints(), fingerprint_, options_.warn);
    if (from) {
      go_on(std::move(*from));
      return;
    }
    check_start();
    refuse_more_than_fits(estimated_output(scenario_, model_), options_.directory);
    clear_results(options_.directory, scenario_name(), options_.overwrite);
    open_tables({}, {});
    resolve_initial_overlaps();
    history_.record(state_, stepper_);
    output_frame();
  }

  void go_on(Checkpoint from) {
    state_ = std::move(from.state);
    stepper_.restart(state_);
    check_start();
    open_tables(from.history, from.convergence);
    // Before anything is cut: results that were whole are not from here on.
    write_unfinished_summary(options_.directory, scenario_name());
    if (from.series.bytes > 0) writer_.resume_at(from.series);
  }

  /// With what an earlier run wrote, or new ones.
  void open_tables(const FileExtent& history, const FileExtent& convergence) {
    const auto open = [&](const char* name, const FileExtent& extent, const std::string& header,
                          std::optional<AppendFile>& table) {
      if (extent.bytes > 0) {
        table.emplace(options_.directory / name, extent);
      } else {
        table.emplace(options_.directory / name);
        table->append(header);
      }
    };
    open("history.csv", history, history_.header(), history_file_);
    if (is_static())
      open("convergence.csv", convergence, convergence_header(scenario_.output.length_unit),
           convergence_file_);
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

  void observe() {
    history_.record(state_, stepper_);
    if (!is_static()) note_balance(numerical_loss(state_, stepper_.stored_energy()), state_);
    const bool end = state_.t >= scenario_.duration;
    if (frames_.due(state_.t) || end) output_frame();
    if (history_.num_pending_bytes() > kMostPendingBytes) write_tables();
    if (checkpoints_.due(state_.t) && !end) {
      const Stopwatch watch(output_seconds_);
      write_checkpoint();
      stepper_.restart(state_);
    }
  }

  void output_frame() {
    const Stopwatch watch(output_seconds_);
    if (scenario_.output.frames) {
      write_frame(model_, stepper_, scenario_.output.contact_surfaces, state_.frames, state_.t,
                  writer_);
      ++state_.frames;
    }
    write_tables();
  }

  void write_tables() {
    if (!history_file_) return;  // nothing began
    history_file_->append(history_.take_rows());
    if (convergence_file_)
      convergence_file_->append(
          convergence_rows(model_, stepper_.take_convergence(), scenario_.output.length_unit));
  }

  /// All results so far are on the disk.
  void write_and_sync() {
    write_tables();
    for (auto* table : {&history_file_, &convergence_file_})
      if (*table) (*table)->sync();
    writer_.sync();
  }

  void write_checkpoint() {
    write_and_sync();  // what it refers to, before it is there
    Checkpoint checkpoint{state_, history_file_->extent(), writer_.series(), {}};
    if (convergence_file_) checkpoint.convergence = convergence_file_->extent();
    sim::write_checkpoint(checkpoints(), checkpoint, fingerprint_);
  }

  const Scenario& scenario_;
  const Model& model_;
  const RunOptions& options_;
  ResultsFolder folder_;  // this run's alone, from before the first file to after the last
  FrameWriter writer_;
  Stepper stepper_;
  History history_;
  std::vector<double> kinks_;
  Schedule frames_, checkpoints_;
  State state_;
  std::string fingerprint_;
  std::vector<InputFile> inputs_;
  std::optional<AppendFile> history_file_, convergence_file_;
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
  for (const SurfaceLoadModel& load : model.surface_loads) add(load.profile.time);
  for (const GravityModel& gravity : model.gravity) add(gravity.profile.time);
  for (const RigidBody& rigid : model.rigid_bodies)
    if (rigid.motion) add(kinks_of(*rigid.motion));
  std::erase_if(times, [&](double t) { return t <= 0 || t >= duration; });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

RunOutcome run(const Scenario& scenario, const Model& model, const RunOptions& options) {
  return Run(scenario, model, options).go();
}

}  // namespace articular::sim
