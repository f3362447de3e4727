#include "parallel/thread_pool.hpp"

#include <cassert>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace articular {
namespace {

constexpr int kTaskBits = 20;
constexpr std::uint64_t kTaskMask = (std::uint64_t{1} << kTaskBits) - 1;

int next_task(std::uint64_t ticket) { return static_cast<int>(ticket & kTaskMask); }
int task_count(std::uint64_t ticket) { return static_cast<int>(ticket >> kTaskBits & kTaskMask); }
std::uint64_t next_job(std::uint64_t ticket, int num_tasks) {
  const std::uint64_t number = (ticket >> 2 * kTaskBits) + 1;
  return number << 2 * kTaskBits | static_cast<std::uint64_t>(num_tasks) << kTaskBits;
}

}  // namespace

ThreadPool::ThreadPool(int num_threads) {
  if (num_threads < 1) {
    throw std::invalid_argument("a pool of " + std::to_string(num_threads) +
                                " threads, must be at least 1");
  }
  try {
    for (int worker = 1; worker < num_threads; ++worker) {
      threads_.emplace_back([this, worker] { wait_for_work(worker); });
    }
  } catch (const std::system_error&) {
    // The system gives no more threads: those that there are do the work.
  }
}

ThreadPool::~ThreadPool() {
  stop_ = true;
  ticket_ = next_job(ticket_, 0);
  ticket_.notify_all();
  threads_.clear();  // joins
}

void ThreadPool::share(int num_tasks) {
  assert(static_cast<std::uint64_t>(num_tasks) <= kTaskMask);
  num_finished_ = 0;
  ticket_ = next_job(ticket_, num_tasks);
  ticket_.notify_all();
  take_tasks(0);
  for (int n = num_finished_; n < num_tasks; n = num_finished_) num_finished_.wait(n);
  if (failed_.exchange(false)) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::take_tasks(int worker) {
  for (std::uint64_t ticket = ticket_; next_task(ticket) < task_count(ticket);) {
    if (!ticket_.compare_exchange_weak(ticket, ticket + 1)) continue;
    try {
      if (!failed_) job_.call(job_.task, next_task(ticket), worker);
    } catch (...) {
      if (!failed_.exchange(true)) failure_ = std::current_exception();
    }
    if (++num_finished_ == task_count(ticket)) num_finished_.notify_one();
    ticket = ticket_;
  }
}

void ThreadPool::wait_for_work(int worker) {
  while (!stop_) {
    take_tasks(worker);
    const std::uint64_t ticket = ticket_;
    if (next_task(ticket) == task_count(ticket) && !stop_) ticket_.wait(ticket);
  }
}

}  // namespace articular
