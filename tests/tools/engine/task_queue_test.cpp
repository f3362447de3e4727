// Cases in a folder, and those who run them.
#include "tools/engine/task_queue.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/sim/support/temporary_folder.hpp"
#include "tools/engine/serve_tasks.hpp"
#include "tools/engine/work.hpp"

namespace articular::tools::task_queue_test {

namespace fs = std::filesystem;
using End = ProgramUse::End;

class TaskQueueTest : public ::testing::Test {
 protected:
  Task task(const std::string& name, std::vector<std::string> command) const {
    return {name, "key of " + name, {std::move(command)}, {}, folder_ / (name + ".log"), {}};
  }
  std::vector<std::pair<std::size_t, TaskEnd>> serve(const std::vector<Task>& tasks,
                                                     const std::function<Workers()>& start,
                                                     double silence_limit = 60) {
    std::vector<std::pair<std::size_t, TaskEnd>> ends;
    serve_tasks(
        queue_, tasks, silence_limit, start,
        [&](std::size_t i, const TaskEnd& end) { ends.emplace_back(i, end); },
        [] { return false; });
    return ends;
  }
  /// A worker that has done its work before anybody waits for it.
  Workers quick_worker() {
    WorkOptions options;
    options.quiet = true;
    work(queue_, options);
    return {[] { return true; }, "here", {}};
  }

  TemporaryFolder folder_;
  TaskQueue queue_{folder_ / "queue"};
};

TEST_F(TaskQueueTest, ATaskReadsAsItWasWritten) {
  Task written = task("a", {"sh", "-c", "echo \"$X\"\n"});
  written.commands.push_back({"true"});
  written.environment = {"X=1 2"};
  written.time_limit = 1.5;
  const std::optional<Task> read = read_task(task_text(written));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, written.name);
  EXPECT_EQ(read->key, written.key);
  EXPECT_EQ(read->commands, written.commands);
  EXPECT_EQ(read->environment, written.environment);
  EXPECT_EQ(read->log, written.log);
  EXPECT_EQ(read->time_limit, written.time_limit);
  for (const char* damaged : {"", "{", "[]", "{\"name\": 1}", "{\"name\": \"a\", \"key\": \"\"}"})
    EXPECT_FALSE(read_task(damaged)) << damaged;
  for (const char* damaged : {"", "{\"key\": \"k\", \"end\": \"never\", \"code\": 0}",
                              "{\"key\": \"k\", \"end\": \"exited\", \"code\": 1e308}"})
    EXPECT_FALSE(read_end(damaged)) << damaged;
}

TEST_F(TaskQueueTest, CommandsOfATaskRunUntilOneFails) {
  Task both = task("a", {"sh", "-c", "exit 3"});
  both.commands.push_back({"touch", folder_ / "never"});
  const ProgramUse use = run_task(both, [] { return false; });
  EXPECT_EQ(use.code, 3);
  EXPECT_FALSE(fs::exists(folder_ / "never"));
}

TEST_F(TaskQueueTest, EveryTaskIsTakenOnce) {
  queue_.open({});
  queue_.offer(task("a", {"true"}));
  TaskQueue other(folder_ / "queue");
  EXPECT_TRUE(queue_.take("a"));
  EXPECT_FALSE(other.take("a"));
  EXPECT_FALSE(other.take());
}

TEST_F(TaskQueueTest, EndsAndFailuresArriveWithTheirCauses) {
  const std::vector<Task> tasks = {task("a", {"true"}), task("b", {"sh", "-c", "exit 3"}),
                                   task("c", {"no-such-program"})};
  const auto ends = serve(tasks, [&] { return quick_worker(); });
  ASSERT_EQ(ends.size(), 3u);
  for (const auto& [i, end] : ends) {
    EXPECT_EQ(end.use.end, End::Exited);
    EXPECT_EQ(end.use.code, (std::vector<int>{0, 3, 4})[i]);
  }
  EXPECT_NE(ends[2].second.why.find("can't start no-such-program"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "queue/a.ended"));
}

// A machine that dies says nothing: its case is lost, the others are not.
TEST_F(TaskQueueTest, AWorkerThatFallsSilentCostsItsCaseOnly) {
  const std::vector<Task> tasks = {task("a", {"true"}), task("b", {"true"})};
  const auto ends = serve(
      tasks,
      [&] {
        queue_.take("a");  // by somebody who is never heard of again
        return quick_worker();
      },
      0.3);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].first, 1u);
  EXPECT_EQ(ends[0].second.use.end, End::Exited);
  EXPECT_EQ(ends[1].second.use.end, End::Lost);
  EXPECT_NE(ends[1].second.why.find("fell silent"), std::string::npos);
}

TEST_F(TaskQueueTest, WithoutWorkersItSaysSo) {
  const std::vector<Task> tasks = {task("a", {"true"})};
  try {
    serve(tasks, [] { return Workers{[] { return false; }, "nobody", {}}; });
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("no worker is left (nobody), and 1 cases are"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(folder_ / "queue/a.task"));
}

// A study that was killed finds what ended meanwhile, and only that which is its own.
TEST_F(TaskQueueTest, WhatEndedMeanwhileIsNotRunAgain) {
  const std::vector<Task> tasks = {task("a", {"touch", folder_ / "again"}),
                                   task("b", {"touch", folder_ / "new"})};
  queue_.open({});
  queue_.finish(tasks[0], {"key of a", {}, ""});
  queue_.finish(tasks[1], {"another key", {}, ""});
  EXPECT_EQ(serve(tasks, [&] { return quick_worker(); }).size(), 2u);
  EXPECT_FALSE(fs::exists(folder_ / "again"));
  EXPECT_TRUE(fs::exists(folder_ / "new"));
}

TEST_F(TaskQueueTest, AWorkerThatIsToldToStopPutsItsCaseBack) {
  queue_.open({});
  const Task endless = task("a", {"sleep", "1000"});
  queue_.offer(endless);
  const std::optional<Task> taken = queue_.take();
  ASSERT_TRUE(taken);
  EXPECT_TRUE(queue_.renew(*taken));
  queue_.close();
  EXPECT_FALSE(queue_.renew(*taken));
  queue_.put_back(*taken);
  EXPECT_TRUE(queue_.list().waiting.contains("a"));
}

TEST_F(TaskQueueTest, IsOfAStudyFromItsFirstCaseOn) {
  fs::create_directories(queue_.folder());
  std::ofstream(folder_ / "queue/history.csv") << "a run's, or anything";
  EXPECT_FALSE(queue_.is_of_a_study());
  queue_.offer(task("a", {"true"}));
  EXPECT_TRUE(queue_.is_of_a_study());
  const std::optional<Task> taken = queue_.take();
  ASSERT_TRUE(taken);
  EXPECT_TRUE(queue_.is_of_a_study());
  queue_.finish(*taken, {taken->key, {}, ""});
  EXPECT_TRUE(queue_.is_of_a_study());
  queue_.forget(*taken);
  EXPECT_FALSE(queue_.is_of_a_study());
  queue_.close();
  EXPECT_TRUE(queue_.is_of_a_study());
}

}  // namespace articular::tools::task_queue_test
