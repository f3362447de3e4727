#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "tools/process/status_line.hpp"

namespace articular::tools {

/// Progress through frames on stderr, if it takes longer than a moment: a line that changes on a
/// terminal, a line every tenth of the way else.
class FrameProgress {
 public:
  explicit FrameProgress(std::string what);
  ~FrameProgress();
  FrameProgress(const FrameProgress&) = delete;
  FrameProgress& operator=(const FrameProgress&) = delete;
  void update(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  StatusLine status_;
  std::size_t tenth_ = 0;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
};

}  // namespace articular::tools
