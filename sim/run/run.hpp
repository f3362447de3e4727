#pragma once

#include <filesystem>
#include <functional>

#include "sim/run/course.hpp"

namespace articular::sim {

struct RunOptions {
  std::filesystem::path directory;  // of the results
  bool resume = false;
  bool overwrite = false;  // also results of another scenario
  /// Called once bodies that overlapped at the start have been pushed apart.
  std::function<void(const OverlapResolution&)> after_overlap_resolution;
  /// Called after every iteration of a static load step, and of overlap resolution (t = 0); true
  /// stops the run: a load step may take minutes.
  IterationWatch after_iteration;
  /// Asked within each step, many times; true stops the run at the end of the last one.
  std::function<bool()> is_to_stop;
  /// Called at the end with each warning that the run itself has given cause for, if any.
  std::function<void(const std::string&)> warn;
  /// And with each note, see run_notes().
  std::function<void(const std::string&)> note;
  /// Called after every step; true stops the run (as after Ctrl-C).
  std::function<bool(const State&, double duration)> after_step;
  /// Called before the first step and after every one, when what is due has been written. Unlike
  /// the others it may change what the next step is made of: activations, and of the model, which
  /// who calls run() owns, excitations. A resumed run has the same bits if what it does follows
  /// from the state alone.
  std::function<void(Course&)> steer;
};

enum class RunOutcome { Finished, Interrupted };

/// Runs a model from the start (or its checkpoint) to the scenario's duration and writes frames,
/// history, checkpoints and the summary.
/// @param scenario  that the model was built from
/// @throws SimulationError when it can't go on; what was written stays valid, the summary says
/// until when
/// @throws SystemError when results can't be written
RunOutcome run(const Scenario& scenario, const Model& model, const RunOptions& options);
}  // namespace articular::sim
