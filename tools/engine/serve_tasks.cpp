#include "tools/engine/serve_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <thread>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProgramUse::End;

constexpr std::chrono::milliseconds kLookEvery{200};

/// One that is offered and has no end yet.
struct Open {
  std::size_t number;
  Clock::time_point last_seen;  // waiting or taken
};

TaskEnd lost(const Task& task) {
  TaskEnd end{task.key, {}, "its worker fell silent: the machine, or the worker on it, has died"};
  end.use.end = End::Lost;
  return end;
}

/// The end of a task, if it has one by now.
std::optional<TaskEnd> end_now(const TaskQueue& queue, const TaskQueue::Listing& seen,
                               const Task& task, double silence_limit, Open& open) {
  if (seen.ended.contains(task.name))
    if (std::optional<TaskEnd> end = queue.end_of(task)) return end;
  const auto now = Clock::now();
  const bool is_taken = seen.taken.contains(task.name);
  const double silence = is_taken ? queue.silence(task).value_or(0) : 0;
  if (seen.waiting.contains(task.name) || (is_taken && silence <= silence_limit)) {
    open.last_seen = now;
    return {};
  }
  // Neither waiting nor taken: it is between the two, or somebody removed it.
  const double unseen = std::chrono::duration<double>(now - open.last_seen).count();
  if (is_taken || unseen > silence_limit) return queue.end_of(task).value_or(lost(task));
  return {};
}

bool any_waits(const TaskQueue::Listing& seen, const std::vector<Task>& tasks,
               const std::list<Open>& left) {
  return std::any_of(left.begin(), left.end(), [&](const Open& open) {
    return seen.waiting.contains(tasks[open.number].name);
  });
}

}  // namespace

bool serve_tasks(TaskQueue& queue, const std::vector<Task>& tasks, double silence_limit,
                 const std::function<Workers()>& start,
                 const std::function<void(std::size_t, const TaskEnd&)>& ended,
                 const std::function<bool()>& interrupted) {
  queue.open(tasks);
  std::list<Open> left;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    left.push_back({i, Clock::now()});
    // Of a study that was killed: it has ended meanwhile, or a worker is still at it.
    if (!queue.end_of(tasks[i]) && !queue.silence(tasks[i])) queue.offer(tasks[i]);
  }
  Workers workers;
  if (any_waits(queue.list(), tasks, left)) workers = start();
  while (!left.empty()) {
    if (interrupted()) {
      queue.close();
      return false;
    }
    const bool are_there = !workers.are_there || workers.are_there();
    const TaskQueue::Listing seen = queue.list();
    for (auto open = left.begin(); open != left.end();) {
      const std::optional<TaskEnd> end =
          end_now(queue, seen, tasks[open->number], silence_limit, *open);
      if (!end) {
        ++open;
        continue;
      }
      queue.forget(tasks[open->number]);
      ended(open->number, *end);
      open = left.erase(open);
    }
    if (!are_there && any_waits(seen, tasks, left)) {
      queue.close();
      throw sim::SystemError(
          fmt::format("no worker is left ({}), and {} cases are; what workers said is in {}/*.log",
                      workers.where, left.size(), queue.folder().string()));
    }
    if (!left.empty()) std::this_thread::sleep_for(kLookEvery);
  }
  return true;
}

}  // namespace articular::tools
