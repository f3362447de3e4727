#pragma once

#include <chrono>
#include <string>

#include "sim/scenario/scenario.hpp"
#include "sim/statics/equilibrium.hpp"
#include "tools/process/status_line.hpp"

namespace articular::tools {

/// Progress of a run on stderr: a bar on a terminal; else a line every tenth of the way, and every
/// ten seconds in which no step was done.
class Progress {
 public:
  Progress(const sim::Scenario& scenario, bool quiet);
  void update(const sim::State& state);
  /// Of a static load step to t, or of overlap resolution (t = 0).
  void update(double t, const sim::NewtonIteration& iteration);
  void finish();

 private:
  static constexpr int kBarWidth = 24;
  void print(const sim::State& state);
  void put(const std::string& line);

  using Clock = std::chrono::steady_clock;
  bool quiet_, is_static_;
  int most_iterations_;  // of a load step
  double duration_;      // [s]
  StatusLine status_;
  Clock::time_point start_ = Clock::now(), shown_ = Clock::now();
  double first_time_ = -1;  // simulated time at the first update [s]
  std::int64_t first_step_ = 0;
  int tenth_ = 0;
  int iterations_ = 0;  // since the last step
  std::string bar_ = "[" + std::string(kBarWidth, '.') + "]";
};

}  // namespace articular::tools
