#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/engine/task.hpp"

/// A folder in which cases wait for workers, on this machine or on others that see the same folder:
///
///     NAME.task    waits; whoever renames it to NAME.taken has it, and nobody else
///     NAME.taken   is run; its date is renewed, so that a machine that died is noticed
///     NAME.ended   how it went
///     stop         workers end, and put back what they run
namespace articular::tools {

class TaskQueue {
 public:
  explicit TaskQueue(std::filesystem::path folder) : folder_(std::move(folder)) {}
  const std::filesystem::path& folder() const { return folder_; }

  // What a study does.

  /// Makes the folder, and takes away tasks that nobody has taken, ends that fit none of these
  /// tasks, and `stop`. @throws sim::SystemError
  void open(const std::vector<Task>& tasks);
  /// @throws sim::SystemError
  void offer(const Task& task);
  /// Takes back what nobody has taken, and asks workers to end.
  void close();
  /// Names of tasks by how far they are, from one look at the folder.
  struct Listing {
    std::set<std::string> waiting, taken, ended;
  };
  Listing list() const;
  std::optional<TaskEnd> end_of(const Task& task) const;
  /// Since whoever has taken it was last heard of, by the clock of the folder [s]; none: it is not
  /// taken.
  std::optional<double> silence(const Task& task) const;
  void forget(const Task& task);

  // What a worker does.

  /// The next task in the order of names; none: none is left.
  std::optional<Task> take();
  /// The task of this name, if it waits.
  std::optional<Task> take(const std::string& name);
  /// Tells that it is still being run. @return false: it was given up, or everybody is to stop
  bool renew(const Task& task) const;
  void put_back(const Task& task);
  void finish(const Task& task, const TaskEnd& end);
  bool is_stopped() const;
  /// Whether a study has ever put anything here.
  bool is_of_a_study() const;

 private:
  std::filesystem::path file(const std::string& name, const char* ending) const {
    return folder_ / (name + ending);
  }

  std::filesystem::path folder_;
};

}  // namespace articular::tools
