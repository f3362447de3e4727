#include "tools/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/build/build_model.hpp"
#include "sim/step/stepper.hpp"

namespace articular::tools {
namespace {

constexpr std::chrono::milliseconds kBarInterval(100);

}  // namespace

Progress::Progress(const sim::Scenario& scenario, bool quiet)
    : quiet_(quiet),
      is_static_(scenario.analysis == sim::Scenario::Analysis::Static),
      most_iterations_(sim::most_load_step_iterations(sim::step_settings(scenario))),
      duration_(scenario.duration) {}

void Progress::update(const sim::State& state) {
  if (quiet_) return;
  iterations_ = 0;
  if (first_time_ < 0) {
    first_time_ = state.t;
    first_step_ = state.counts.steps;
    tenth_ = static_cast<int>(10 * state.t / duration_);
    return;
  }
  if (status_.is_terminal()) {
    if (Clock::now() - shown_ < kBarInterval && state.t < duration_) return;
    print(state);
  } else if (const int tenth = static_cast<int>(10 * state.t / duration_); tenth > tenth_) {
    tenth_ = tenth;
    print(state);
  }
}

void Progress::update(double t, const sim::NewtonIteration& iteration) {
  if (quiet_) return;
  constexpr std::chrono::seconds kLineInterval(10);
  ++iterations_;
  if (Clock::now() - shown_ <
      (status_.is_terminal() ? Clock::duration(kBarInterval) : kLineInterval))
    return;
  const std::string what =
      t > 0 ? fmt::format("load step to {:.4g} % of the load", 100 * t / duration_)
            : std::string("pushing bodies apart");
  int changed = 0;
  for (const sim::SupportChange& change : iteration.changes)
    changed += change.began + change.ceased;
  const std::string limit =
      t > 0 ? fmt::format(" of at most {} a load step", most_iterations_) : std::string();
  put(fmt::format("{}: iteration {}{}, residual {:.1e} of the largest force{}", what, iterations_,
                  limit, iteration.residual,
                  changed > 0 ? fmt::format(", {} nodes begin or cease to touch", changed) : ""));
}

void Progress::print(const sim::State& state) {
  const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
  const double done = state.t / duration_;
  const double rate = static_cast<double>(state.counts.steps - first_step_) / wall;
  const double left = wall * (duration_ - state.t) / std::max(state.t - first_time_, 1e-12);
  const auto filled = static_cast<std::size_t>(std::lround(kBarWidth * done));
  bar_ = "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "]";
  const std::string when =
      is_static_ ? std::string("of the load") : fmt::format("t = {:.1f} ms", 1e3 * state.t);
  put(fmt::format("{:3.0f} %  {}  {:.1f} steps/s  {:.0f} s left  largest penetration {:.1f} um",
                  100 * done, when, rate, left, 1e6 * state.max_penetration));
}

void Progress::put(const std::string& line) {
  shown_ = Clock::now();
  status_.show(status_.is_terminal() ? bar_ + " " + line : line);
}

void Progress::finish() { status_.end(); }

}  // namespace articular::tools
