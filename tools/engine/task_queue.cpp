#include "tools/engine/task_queue.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "tools/process/child_process.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char *kTask = ".task", *kTaken = ".taken", *kEnded = ".ended", *kStop = "stop";

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

void remove_file(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

/// "" where it can't be read: it may have gone meanwhile.
std::string text_of_file(const fs::path& path) {
  try {
    return sim::file_bytes(path);
  } catch (const std::exception&) {
    return "";
  }
}

/// Seconds of the file system's clock, as it is now where the file lies. Opened first: that asks a
/// file server anew.
std::optional<double> date_of(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat info {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0) return {};
  return static_cast<double>(info.st_mtim.tv_sec) +
         1e-9 * static_cast<double>(info.st_mtim.tv_nsec);
}

bool set_date(const fs::path& path) { return ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0) == 0; }

}  // namespace

void TaskQueue::open(const std::vector<Task>& tasks) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw sim::SystemError(folder_.string() + ": can't be made: " + error.message());
  remove_file(folder_ / kStop);
  const Listing found = list();
  for (const std::string& name : found.waiting) remove_file(file(name, kTask));
  for (const std::string& name : found.ended) {
    const std::optional<TaskEnd> end = read_end(text_of_file(file(name, kEnded)));
    const bool fits = end && std::any_of(tasks.begin(), tasks.end(), [&](const Task& task) {
                        return task.name == name && task.key == end->key;
                      });
    if (!fits) remove_file(file(name, kEnded));
  }
  for (const std::string& name : found.taken) {
    const std::optional<Task> taken = read_task(text_of_file(file(name, kTaken)));
    const bool fits = taken && std::any_of(tasks.begin(), tasks.end(), [&](const Task& task) {
                        return task.name == name && task.key == taken->key;
                      });
    if (!fits) remove_file(file(name, kTaken));
  }
}

void TaskQueue::offer(const Task& task) {
  sim::write_text_file(file(task.name, kTask), task_text(task), sim::Durable::Later);
}

void TaskQueue::close() {
  for (const std::string& name : list().waiting) remove_file(file(name, kTask));
  sim::write_text_file(folder_ / kStop, "");
}

TaskQueue::Listing TaskQueue::list() const {
  Listing listing;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string ending = entry->path().extension().string();
    if (ending == kTask) listing.waiting.insert(entry->path().stem().string());
    if (ending == kTaken) listing.taken.insert(entry->path().stem().string());
    if (ending == kEnded) listing.ended.insert(entry->path().stem().string());
  }
  return listing;
}

std::optional<TaskEnd> TaskQueue::end_of(const Task& task) const {
  const fs::path path = file(task.name, kEnded);
  if (!is_file(path)) return {};
  std::optional<TaskEnd> end = read_end(text_of_file(path));
  if (end && end->key != task.key) return {};
  return end;
}

std::optional<double> TaskQueue::silence(const Task& task) const {
  const std::optional<double> heard = date_of(file(task.name, kTaken));
  if (!heard) return {};
  // Clocks of machines differ: "now" is the date that a file in the same folder gets.
  const fs::path clock = folder_ / "clock";
  if (!set_date(clock)) sim::write_text_file(clock, "");
  return date_of(clock).value_or(*heard) - *heard;
}

void TaskQueue::forget(const Task& task) {
  for (const char* ending : {kTask, kTaken, kEnded}) remove_file(file(task.name, ending));
}

std::optional<Task> TaskQueue::take() {
  for (const std::string& name : list().waiting) {
    if (is_stopped()) return {};
    if (std::optional<Task> task = take(name)) return task;
  }
  return {};
}

std::optional<Task> TaskQueue::take(const std::string& name) {
  const fs::path waiting = file(name, kTask), taken = file(name, kTaken);
  set_date(waiting);  // before it is ours, so that it is never seen taken and old
  if (std::rename(waiting.c_str(), taken.c_str()) != 0) return {};
  std::optional<Task> task = read_task(text_of_file(taken));
  if (!task || task->name != name) {
    finish({name, "", {}, {}, {}, {}}, {"", {}, "damaged task"});
    return {};
  }
  return task;
}

bool TaskQueue::renew(const Task& task) const {
  return set_date(file(task.name, kTaken)) && !is_stopped();
}

void TaskQueue::put_back(const Task& task) {
  std::rename(file(task.name, kTaken).c_str(), file(task.name, kTask).c_str());
}

void TaskQueue::finish(const Task& task, const TaskEnd& end) {
  sim::write_text_file(file(task.name, kEnded), end_text(end), sim::Durable::Later);
  remove_file(file(task.name, kTaken));
}

bool TaskQueue::is_stopped() const { return is_file(folder_ / kStop); }

bool TaskQueue::is_of_a_study() const {
  const Listing now = list();
  return is_stopped() || !(now.waiting.empty() && now.taken.empty() && now.ended.empty());
}

}  // namespace articular::tools
