#include "tools/collide/collide_progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace articular::tools {

FrameProgress::FrameProgress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0) {}

FrameProgress::~FrameProgress() {
  if (line_open_) std::fputs("\r\x1b[K", stderr);
}

void FrameProgress::update(std::size_t done, std::size_t all) {
  constexpr std::chrono::seconds kMoment(1);
  constexpr std::chrono::milliseconds kInterval(100);
  const Clock::time_point now = Clock::now();
  const std::size_t tenth = 10 * done / all;
  if (done == all || now - start_ < kMoment) return;
  if (terminal_ ? now - shown_ < kInterval : tenth == tenth_) return;
  shown_ = now;
  tenth_ = tenth;
  line_open_ = terminal_;
  fmt::print(stderr, "{}{}: {} of {} frames{}", terminal_ ? "\r" : "", what_, done, all,
             terminal_ ? "\x1b[K" : "\n");
  std::fflush(stderr);
}

}  // namespace articular::tools
