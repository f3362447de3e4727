#include "tools/collide/collide_progress.hpp"

#include <fmt/format.h>
namespace articular::tools {

FrameProgress::FrameProgress(std::string what) : what_(std::move(what)) {}

FrameProgress::~FrameProgress() { status_.erase(); }

void FrameProgress::update(std::size_t done, std::size_t all) {
  constexpr std::chrono::seconds kMoment(1);
  constexpr std::chrono::milliseconds kInterval(100);
  const Clock::time_point now = Clock::now();
  const std::size_t tenth = 10 * done / all;
  if (done == all || now - start_ < kMoment) return;
  if (status_.is_terminal() ? now - shown_ < kInterval : tenth == tenth_) return;
  shown_ = now;
  tenth_ = tenth;
  status_.show(fmt::format("{}: {} of {} frames", what_, done, all));
}

}  // namespace articular::tools
