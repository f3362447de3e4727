#include "tools/process/started_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

constexpr std::chrono::seconds kTimeToEnd{10};  // between asking for the end and making it

}  // namespace

StartedProgram::StartedProgram(const std::vector<std::string>& command,
                               const std::filesystem::path& log) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));  // exec changes nothing
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  const int error = ::posix_spawnp(&pid_, arguments[0], &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (error == 0) return;
  pid_ = -1;
  throw sim::SystemError("can't start " + command[0] + ": " +
                         std::system_category().message(error));
}

StartedProgram::~StartedProgram() {
  if (!is_running()) return;
  ::kill(pid_, SIGTERM);
  const auto start = std::chrono::steady_clock::now();
  while (is_running() && std::chrono::steady_clock::now() - start < kTimeToEnd)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (!is_running()) return;
  ::kill(pid_, SIGKILL);
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
}

bool StartedProgram::is_running() {
  if (pid_ <= 0) return false;
  int status = 0;
  const pid_t done = ::waitpid(pid_, &status, WNOHANG);
  if (done == 0 || (done < 0 && errno == EINTR)) return true;
  pid_ = -1;
  return false;
}

}  // namespace articular::tools
