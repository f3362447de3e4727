#include "tools/process/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

std::string reason(int error) { return std::system_category().message(error); }

/// The child's side of start(): only calls that are allowed between fork and exec.
[[noreturn]] void become(char* const* arguments, pid_t parent, int inherited, int as, int report) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
  const int null = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null, standard);
  if (inherited == as)
    ::fcntl(inherited, F_SETFD, 0);
  else
    ::dup2(inherited, as);
  ::execvp(arguments[0], arguments);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(report, &error, sizeof error);
  ::_exit(127);
}

}  // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    close();
    fd_ = other.release();
  }
  return *this;
}

int FileDescriptor::release() { return std::exchange(fd_, -1); }

void FileDescriptor::close() {
  if (fd_ >= 0) ::close(release());
}

Pipe::Pipe() {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw sim::SystemError("can't make a pipe to another program: " + reason(errno));
  read_end = FileDescriptor(ends[0]);
  write_end = FileDescriptor(ends[1]);
}

ChildProcess::Started ChildProcess::start(const std::vector<std::string>& command, int inherited,
                                          int as, ChildProcess& child) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));  // exec changes nothing
  arguments.push_back(nullptr);
  Pipe report;  // closed by a successful exec, else the error number comes through
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw sim::SystemError("can't start " + command[0] + ": " + reason(errno));
  if (pid == 0) become(arguments.data(), parent, inherited, as, report.write_end.get());
  child.pid_ = pid;
  report.write_end.close();
  int error = 0;
  if (::read(report.read_end.get(), &error, sizeof error) != sizeof error) return Started::Yes;
  child.wait();
  if (error == ENOENT) return Started::NotInstalled;
  throw sim::SystemError("can't start " + command[0] + ": " + reason(error));
}

/// An X server that has just begun forgets the signal, and would be waited for without end: it is
/// asked again.
ChildProcess::~ChildProcess() {
  constexpr int kMostRequests = 100;
  for (int request = 0; pid_ > 0 && request < kMostRequests; ++request) {
    ::kill(pid_, SIGTERM);
    for (int look = 0; look < 10; ++look) {
      if (::waitpid(pid_, nullptr, WNOHANG) == pid_) return;
      ::poll(nullptr, 0, 2);  // [ms]
    }
  }
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  wait();
}

bool ChildProcess::wait() {
  if (pid_ <= 0) return false;
  int status = 0;
  pid_t done = -1;
  do done = ::waitpid(pid_, &status, 0);
  while (done < 0 && errno == EINTR);
  pid_ = -1;
  return done > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace articular::tools
