#include "sim/run/run.hpp"

#include <chrono>
#include <optional>

#include "sim/base/append_file.hpp"
#include "sim/base/atomic_file.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/output/convergence.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/output/frames.hpp"
#include "sim/output/history.hpp"
#include "sim/output/output_size.hpp"
#include "sim/output/results_folder.hpp"
#include "sim/output/run_warnings.hpp"
#include "sim/output/summary.hpp"

namespace articular::sim {
namespace {

/// Rows of the history that wait for the next frame take no more memory than this.
constexpr std::size_t kMostPendingBytes = 1 << 16;

class Run {
 public:
  Run(const Scenario& scenario, const Model& model, const RunOptions& options)
      : scenario_(scenario),
        model_(model),
        options_(options),
        folder_(options.directory),
        writer_(options.directory, scenario.name, scenario.output.length_unit,
                scenario.threads > 1 ? FrameThread::OfItsOwn : FrameThread::Callers),
        course_(scenario, model),
        history_(model, scenario.output.length_unit),
        overlaps_(scenario, model) {}

  RunOutcome go() {
    const auto start = std::chrono::steady_clock::now();
    RunOutcome outcome = RunOutcome::Finished;
    std::string how = "finished";
    const auto finish = [&] {
      WallTimes wall = times_;
      wall.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      write_and_sync();
      std::vector<std::string> warnings = run_warnings(model_, state(), stepper());
      overlaps_.look(stepper().now().configuration);
      for (std::string& warning : overlap_warnings(model_, overlaps_.since_start()))
        warnings.push_back(std::move(warning));
      if (options_.warn)
        for (const std::string& warning : warnings) options_.warn(warning);
      if (options_.note)
        for (const std::string& note : run_notes(model_, state(), stepper())) options_.note(note);
      write_text_file(options_.directory / "summary.json",
                      summary_json(scenario_, model_, state(), stepper(), stepper().times(), wall,
                                   inputs_, warnings, how));
    };
    course_.set_watch(options_.after_iteration);
    course_.set_stop(options_.is_to_stop);
    try {
      begin();
      while (!course_.is_done()) {
        course_.step();
        observe();
        if (options_.after_step && options_.after_step(state(), scenario_.duration) &&
            !course_.is_done()) {
          outcome = RunOutcome::Interrupted;
          how = "interrupted";
          break;
        }
      }
    } catch (const Interruption&) {
      outcome = RunOutcome::Interrupted;
      how = "interrupted";
      course_.restart();  // energies are those of the last step that was done
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

  void begin() {
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
    course_.begin();
    refuse_more_than_fits(estimated_output(scenario_, model_), options_.directory);
    clear_results(options_.directory, scenario_.file, options_.overwrite);
    open_tables({}, {});
    if (set_apart() && options_.after_overlap_resolution)
      options_.after_overlap_resolution(state().overlap_resolution);
    history_.record(state(), stepper());
    output_frame();
    steer();
  }

  bool set_apart() {
    const Stopwatch watch(times_.overlap_resolution);
    return course_.set_apart();
  }

  void go_on(Checkpoint from) {
    course_.go_on(std::move(from.state));
    open_tables(from.history, from.convergence);
    // Before anything is cut: results that were whole are not from here on.
    write_unfinished_summary(options_.directory, scenario_.file);
    if (from.series.bytes > 0) writer_.resume_at(from.series);
    steer();
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

  State& state() { return course_.state(); }
  Stepper& stepper() { return course_.stepper(); }
  bool is_static() const { return model_.is_static; }

  void steer() {
    if (options_.steer) options_.steer(course_);
  }

  void observe() {
    history_.record(state(), stepper());
    if (course_.frame_is_due()) output_frame();
    if (history_.num_pending_bytes() > kMostPendingBytes) write_tables();
    if (course_.checkpoint_is_due()) {
      const Stopwatch watch(times_.output);
      write_checkpoint();
      course_.restart();
    }
    steer();
  }

  void output_frame() {
    const Stopwatch watch(times_.output);
    overlaps_.look(stepper().now().configuration);
    if (scenario_.output.frames) {
      write_frame(model_, stepper(), scenario_.output.contact_surfaces, state().frames, state().t,
                  writer_);
      ++state().frames;
    }
    write_tables();
  }

  void write_tables() {
    if (!history_file_) return;  // nothing began
    history_file_->append(history_.take_rows());
    if (convergence_file_)
      convergence_file_->append(
          convergence_rows(model_, stepper().take_convergence(), scenario_.output.length_unit));
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
    Checkpoint checkpoint{state(), history_file_->extent(), writer_.series(), {}};
    if (convergence_file_) checkpoint.convergence = convergence_file_->extent();
    sim::write_checkpoint(checkpoints(), checkpoint, fingerprint_);
  }

  const Scenario& scenario_;
  const Model& model_;
  const RunOptions& options_;
  ResultsFolder folder_;  // this run's alone, from before the first file to after the last
  FrameWriter writer_;
  Course course_;
  History history_;
  OverlapWatch overlaps_;  // of a run that goes on: from there on
  std::string fingerprint_;
  std::vector<InputFile> inputs_;
  std::optional<AppendFile> history_file_, convergence_file_;
  WallTimes times_;  // but for the total
};

}  // namespace

RunOutcome run(const Scenario& scenario, const Model& model, const RunOptions& options) {
  return Run(scenario, model, options).go();
}

}  // namespace articular::sim
