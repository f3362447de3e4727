#include "tests/benchmarks/extremes/limited_child.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

namespace articular::benchmarks {
namespace {

constexpr int kNotStarted = 127;
constexpr std::chrono::milliseconds kPoll{5};

[[noreturn]] void become(char* const* arguments, const char* log) {
  const int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file >= 0 && dup2(file, STDOUT_FILENO) >= 0 && dup2(file, STDERR_FILENO) >= 0)
    execv(arguments[0], arguments);
  _exit(kNotStarted);
}

}  // namespace

ChildEnd run_limited(const std::vector<std::string>& command, const std::filesystem::path& log,
                     double limit) {
  using Clock = std::chrono::steady_clock;
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));  // exec changes nothing
  arguments.push_back(nullptr);
  const std::string log_name = log.string();
  const Clock::time_point start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become(arguments.data(), log_name.c_str());
  ChildEnd end;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (elapsed() > limit && !end.timed_out) {
      end.timed_out = true;
      kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(kPoll);
  }
  end.seconds = elapsed();
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (end.exit_code == kNotStarted)
    throw std::system_error(ENOENT, std::generic_category(), "cannot start " + command[0]);
  return end;
}

}  // namespace articular::benchmarks
