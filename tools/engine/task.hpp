#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/process/measured_program.hpp"

/// One case of a study as another machine can run it: commands, and files that they read and write.
namespace articular::tools {

struct Task {
  std::string name;  // of its files in a queue: letters, digits, `.`, `-` and `_`
  std::string key;   // says of what; a result with another key is of something else
  std::vector<std::vector<std::string>> commands;  // one after the other, until one fails
  std::vector<std::string> environment;            // "NAME=VALUE", added
  std::filesystem::path log;                       // what the last command says; absolute
  std::optional<double> time_limit;                // of all together [s]
};

/// Runs the commands of a task. Times are sums, memory is the largest.
/// @throws sim::SystemError  when one can't be started, or the log not be written
ProgramUse run_task(const Task& task, const std::function<bool()>& interrupted);

/// The files of a queue: README.md of tools has the format.
std::string task_text(const Task& task);
std::optional<Task> read_task(const std::string& text);  // none: damaged

/// How a task went.
struct TaskEnd {
  std::string key;
  ProgramUse use;
  std::string why;  // of a task that could not be started; else ""
};
std::string end_text(const TaskEnd& end);
std::optional<TaskEnd> read_end(const std::string& text);

}  // namespace articular::tools
