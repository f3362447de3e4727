#include "fem/base/thread_pool.hpp"

#include <cassert>
#include <system_error>
#include <utility>

namespace articular::fem {
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
  assert(num_threads >= 1);
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
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::take_tasks(int worker) {
  for (std::uint64_t ticket = ticket_; next_task(ticket) < task_count(ticket);) {
    if (!ticket_.compare_exchange_weak(ticket, ticket + 1)) continue;
    try {
      job_.call(job_.task, next_task(ticket), worker);
    } catch (...) {
      const std::scoped_lock lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
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

}  // namespace articular::fem
