#include "tools/engine/work.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "sim/base/error.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProgramUse::End;

constexpr std::chrono::seconds kRenewEvery{2};
constexpr std::chrono::milliseconds kWaitForMore{200};

/// Asked ten times a second while a task runs: tells the others of it, and whether it is to end.
class Pulse {
 public:
  Pulse(const TaskQueue& queue, const Task& task) : queue_(queue), task_(task) {}
  bool operator()() {
    if (interruption_asked()) return true;
    if (Clock::now() < next_) return false;
    next_ = Clock::now() + kRenewEvery;
    return !queue_.renew(task_);
  }

 private:
  const TaskQueue& queue_;
  const Task& task_;
  Clock::time_point next_ = Clock::now() + kRenewEvery;
};

void run_taken(TaskQueue& queue, const Task& task, bool quiet) {
  TaskEnd end{task.key, {}, ""};
  try {
    end.use = run_task(task, Pulse(queue, task));
  } catch (const sim::SystemError& error) {
    end.use.code = 4;
    end.why = error.what();
  }
  if (end.use.end == End::Interrupted || interruption_asked())
    queue.put_back(task);
  else
    queue.finish(task, end);
  if (!quiet)
    fmt::print(stderr, "{}: {}\n", task.name,
               end.use.end == End::Interrupted ? "put back"
                                               : fmt::format("{:.3g} s", end.use.wall_seconds));
}

}  // namespace

int work(TaskQueue& queue, const WorkOptions& options) {
  for (const std::string& name : options.names) {
    if (interruption_asked() || queue.is_stopped()) break;
    if (const std::optional<Task> task = queue.take(name)) run_taken(queue, *task, options.quiet);
  }
  while (options.names.empty() && !interruption_asked() && !queue.is_stopped()) {
    if (const std::optional<Task> task = queue.take())
      run_taken(queue, *task, options.quiet);
    else if (options.wait)
      std::this_thread::sleep_for(kWaitForMore);
    else
      break;
  }
  return interruption_asked() ? kInterruptedExitCode : 0;
}

}  // namespace articular::tools
