#pragma once

#include <string>
#include <vector>

#include "tools/engine/task_queue.hpp"

namespace articular::tools {

struct WorkOptions {
  std::vector<std::string> names;  // tasks to run; none: all that wait
  bool wait = false;               // for more, until the queue is stopped
  bool quiet = false;
};

/// Runs tasks of a queue, one at a time. What is being run when the end is asked for goes back.
/// @return an exit code: 0, or that of an interruption
int work(TaskQueue& queue, const WorkOptions& options);

}  // namespace articular::tools
