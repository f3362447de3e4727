#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tools/engine/task_queue.hpp"
#include "tools/engine/workers.hpp"

namespace articular::tools {

/// Offers tasks in a queue until each has an end: that of its commands, or `Lost` where the worker
/// that had it fell silent.
/// @param start  starts the workers, once the tasks are there; not called if none is left to do
/// @param ended  called with the number of a task and its end, in the order in which they come
/// @return false: `interrupted` became true. Tasks that wait are gone then, and workers told to end
/// @throws sim::SystemError  when no worker is left, and tasks are
bool serve_tasks(TaskQueue& queue, const std::vector<Task>& tasks, double silence_limit,
                 const std::function<Workers()>& start,
                 const std::function<void(std::size_t, const TaskEnd&)>& ended,
                 const std::function<bool()>& interrupted);

}  // namespace articular::tools
