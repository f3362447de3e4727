#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace articular {

/// Threads that wait, asleep, for numbered tasks. Whoever is free takes the next one, so that a
/// thread the system does not run holds nobody up; what a task computes must not depend on who runs
/// it.
class ThreadPool {
 public:
  /// @param num_threads  with the caller's; fewer where the system gives no more
  /// @throws std::invalid_argument below 1
  explicit ThreadPool(int num_threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int num_threads() const { return static_cast<int>(threads_.size()) + 1; }

  /// task(k, worker) for k = 0 .. num_tasks - 1, each once, in any order; returns when all are
  /// done. worker, in [0, num_threads()), is not used by two tasks at the same time: for scratch
  /// memory. The first exception of a task is thrown here; tasks that have not begun by then are
  /// left out. One caller at a time (a pool of one thread keeps nothing of a run, and serves
  /// several); tasks do not call run().
  template <class Task>
  void run(int num_tasks, const Task& task) {
    if (threads_.empty() || num_tasks <= 1) {
      for (int k = 0; k < num_tasks; ++k) task(k, 0);
      return;
    }
    job_.call = [](const void* t, int k, int w) { (*static_cast<const Task*>(t))(k, w); };
    job_.task = &task;
    share(num_tasks);
  }

  /// task(begin, end, worker) for pieces of [0, size) that depend on `piece` alone, not on threads.
  template <class Task>
  void run_pieces(int size, int piece, const Task& task) {
    const int last = (size + piece - 1) / piece;
    run(last, [&](int k, int worker) {
      const int begin = k * piece;
      task(begin, begin + std::min(piece, size - begin), worker);
    });
  }

 private:
  struct Job {
    void (*call)(const void* task, int k, int worker) = nullptr;
    const void* task = nullptr;
  };

  void share(int num_tasks);
  void take_tasks(int worker);
  void wait_for_work(int worker);

  Job job_;
  // Number of the job (24 bits), its number of tasks (20), the next task (20): who raises the last
  // has a task of that job and may read job_, which stays until all tasks are finished.
  std::atomic<std::uint64_t> ticket_{0};
  std::atomic<int> num_finished_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> failed_{false};
  std::exception_ptr failure_;  // written by the task that raises failed_
  std::vector<std::jthread> threads_;
};

}  // namespace articular
