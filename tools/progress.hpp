#pragma once

#include <chrono>

#include "sim/state.hpp"

namespace articular::tools {

/// Progress of a run on stderr: a bar on a terminal, a line every tenth of the way else.
class Progress {
 public:
  explicit Progress(bool quiet);
  void update(const sim::State& state, double duration);
  void finish();

 private:
  void print(const sim::State& state, double duration) const;

  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_;
  Clock::time_point start_ = Clock::now(), shown_ = Clock::now();
  double first_time_ = -1;  // simulated time at the first update [s]
  std::int64_t first_step_ = 0;
  int tenth_ = 0;
  bool bar_shown_ = false;
};

}  // namespace articular::tools
