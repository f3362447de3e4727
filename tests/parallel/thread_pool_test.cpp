#include "parallel/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace articular::thread_pool_test {

TEST(ThreadPool, DoesEachTaskOnce) {
  for (const int num_threads : {1, 2, 5}) {
    ThreadPool pool(num_threads);
    for (const int num_tasks : {0, 1, 2, 7, 1000}) {
      std::vector<int> done(static_cast<std::size_t>(num_tasks));  // a race, were one done twice
      pool.run(num_tasks, [&](int k, int) { ++done[static_cast<std::size_t>(k)]; });
      EXPECT_EQ(done, std::vector<int>(done.size(), 1)) << num_threads << " threads";
    }
  }
}

TEST(ThreadPool, TasksOfOneWorkerFollowEachOther) {
  ThreadPool pool(4);
  std::vector<int> done(static_cast<std::size_t>(pool.num_threads()));  // a race, were they not
  pool.run(10000, [&](int, int worker) { ++done[static_cast<std::size_t>(worker)]; });
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 10000);
}

TEST(ThreadPool, ThreadsWorkAtTheSameTime) {
  ThreadPool pool(2);
  if (pool.num_threads() < 2) GTEST_SKIP() << "the system gives no threads";
  std::latch both(2);
  pool.run(2, [&](int, int) { both.arrive_and_wait(); });
  EXPECT_TRUE(both.try_wait());
}

// Threads fall asleep and wake, while a late one may still look at the job before.
TEST(ThreadPool, ManyShortJobsFollowEachOther) {
  ThreadPool pool(3);
  std::vector<int> sum(4);
  for (int job = 0; job < 5000; ++job) {
    pool.run(2 + job % 3, [&](int k, int) { sum[static_cast<std::size_t>(k)] += job; });
    if (job % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  int of_all = 0, of_three = 0, of_four = 0;
  for (int job = 0; job < 5000; ++job) {
    of_all += job;
    if (job % 3 >= 1) of_three += job;
    if (job % 3 == 2) of_four += job;
  }
  EXPECT_EQ(sum, (std::vector<int>{of_all, of_all, of_three, of_four}));
}

TEST(ThreadPool, PiecesDependOnTheirSizeAlone) {
  using Piece = std::pair<int, int>;
  for (const int num_threads : {1, 3}) {
    ThreadPool pool(num_threads);
    std::vector<Piece> pieces(3);
    pool.run_pieces(10, 4, [&](int begin, int end, int) {
      pieces[static_cast<std::size_t>(begin / 4)] = {begin, end};
    });
    EXPECT_EQ(pieces, (std::vector<Piece>{{0, 4}, {4, 8}, {8, 10}}));
  }
}

TEST(ThreadPool, ThrowsTheFirstExceptionLeavesTheRestOutAndGoesOn) {
  constexpr int kMany = 1000;
  for (const int num_threads : {1, 3}) {
    ThreadPool pool(num_threads);
    for (int round = 0; round < 2; ++round) {
      std::atomic<int> num_begun = 0;
      const auto task = [&](int k, int) {
        ++num_begun;
        if (k == 1) throw std::runtime_error("task 1");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      };
      EXPECT_THROW(pool.run(kMany, task), std::runtime_error);
      EXPECT_LT(num_begun, kMany);
    }
    std::atomic<int> num_done = 0;
    pool.run(kMany, [&](int, int) { ++num_done; });
    EXPECT_EQ(num_done, kMany);
  }
}

TEST(ThreadPool, EndsWithoutEverHavingWorked) {
  for (int k = 0; k < 100; ++k) EXPECT_GE(ThreadPool(3).num_threads(), 1);
}

TEST(ThreadPool, RefusesToHaveNoThread) {
  EXPECT_THROW(ThreadPool(0), std::invalid_argument);
  EXPECT_THROW(ThreadPool(-1), std::invalid_argument);
}

}  // namespace articular::thread_pool_test
