#include "tools/process/measured_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>

#include "sim/base/error.hpp"
#include "tools/process/child_process.hpp"

namespace articular::tools {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProgramUse::End;

constexpr int kLookAroundMs = 100, kNotStarted = 127;
constexpr double kGrace = 10;  // [s] between asking for the end and making it

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

[[noreturn]] void fail(const std::string& what) {
  throw sim::SystemError(what + ": " + std::system_category().message(errno));
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (const std::string& text : texts)
    result.push_back(const_cast<char*>(text.c_str()));  // exec changes nothing
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> whole_environment(const std::vector<std::string>& added) {
  std::vector<std::string> all = added;  // the first of several with one name counts
  for (char** variable = environ; *variable != nullptr; ++variable) all.emplace_back(*variable);
  return all;
}

/// The child's side: only calls that are allowed between fork and exec.
[[noreturn]] void become(char* const* command, char* const* environment, int log, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(kNotStarted);
  const int null = ::open("/dev/null", O_RDONLY);
  ::dup2(null, STDIN_FILENO);
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  ::execvpe(command[0], command, environment);
  ::_exit(kNotStarted);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ProgramUse reap(pid_t child, Clock::time_point start) {
  int status = 0;
  rusage usage{};
  pid_t done = -1;
  do done = ::wait4(child, &status, 0, &usage);
  while (done < 0 && errno == EINTR);
  ProgramUse use;
  use.wall_seconds = since(start);
  use.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  use.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  use.end = WIFEXITED(status) ? End::Exited : End::Signalled;
  use.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
  return use;
}

}  // namespace

ProgramUse run_measured(const std::vector<std::string>& command,
                        const std::vector<std::string>& environment,
                        const std::filesystem::path& log, std::optional<double> time_limit,
                        const std::function<bool()>& interrupted) {
  const FileDescriptor file(::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) fail(log.string() + ": can't be written");
  const std::vector<std::string> variables = whole_environment(environment);
  const std::vector<char*> arguments = pointers(command), environment_list = pointers(variables);
  const pid_t parent = ::getpid();
  const Clock::time_point start = Clock::now();
  const pid_t child = ::fork();
  if (child < 0) fail("can't start " + command[0]);
  if (child == 0) become(arguments.data(), environment_list.data(), file.get(), parent);
  const FileDescriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  if (handle.get() < 0) fail("can't wait for " + command[0]);

  std::optional<End> asked;
  Clock::time_point asked_at;
  while (true) {
    pollfd ended{handle.get(), POLLIN, 0};
    if (::poll(&ended, 1, kLookAroundMs) > 0) break;
    if (asked && since(asked_at) > kGrace) ::kill(child, SIGKILL);
    if (asked) continue;
    if (interrupted())
      asked = End::Interrupted;
    else if (time_limit && since(start) > *time_limit)
      asked = End::TimeLimit;
    if (!asked) continue;
    asked_at = Clock::now();
    ::kill(child, SIGTERM);
  }
  ProgramUse use = reap(child, start);
  if (asked) use.end = *asked;
  if (use.end == End::Exited && use.code == kNotStarted)
    throw sim::SystemError("can't start " + command[0]);
  return use;
}

}  // namespace articular::tools
