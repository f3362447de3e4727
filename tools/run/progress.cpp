#include "tools/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace articular::tools {
namespace {

constexpr std::chrono::milliseconds kBarInterval(100);

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::update(const sim::State& state, double duration) {
  if (quiet_) return;
  iterations_ = 0;
  if (first_time_ < 0) {
    first_time_ = state.t;
    first_step_ = state.counts.steps;
    tenth_ = static_cast<int>(10 * state.t / duration);
    return;
  }
  if (terminal_) {
    if (Clock::now() - shown_ < kBarInterval && state.t < duration) return;
    print(state, duration);
  } else if (const int tenth = static_cast<int>(10 * state.t / duration); tenth > tenth_) {
    tenth_ = tenth;
    print(state, duration);
  }
}

void Progress::update(double t, const sim::NewtonIteration& iteration) {
  if (quiet_) return;
  constexpr std::chrono::seconds kLineInterval(10);
  ++iterations_;
  if (Clock::now() - shown_ < (terminal_ ? Clock::duration(kBarInterval) : kLineInterval)) return;
  const std::string what =
      t > 0 ? fmt::format("load step to t = {:.1f} ms", 1e3 * t) : std::string("settling");
  put(fmt::format("{}: iteration {}, residual {:.1e} of the largest force", what, iterations_,
                  iteration.residual));
}

void Progress::print(const sim::State& state, double duration) {
  const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = state.t / duration;
  const double rate = static_cast<double>(state.counts.steps - first_step_) / wall;
  const double left = wall * (duration - state.t) / std::max(state.t - first_time_, 1e-12);
  const auto filled = static_cast<std::size_t>(std::lround(kBarWidth * done));
  bar_ = "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "]";
  put(
      fmt::format("{:3.0f} %  t = {:.1f} ms  {:.1f} steps/s  {:.0f} s left  largest "
                  "penetration {:.1f} um",
                  100 * done, 1e3 * state.t, rate, left, 1e6 * state.max_penetration));
}

void Progress::put(const std::string& line) {
  shown_ = Clock::now();
  bar_shown_ = terminal_;
  const std::string text = terminal_ ? "\r" + bar_ + " " + line + "\x1b[K" : line + "\n";
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void Progress::finish() {
  if (bar_shown_) std::fputc('\n', stderr);
  bar_shown_ = false;
}

}  // namespace articular::tools
