#include "tools/process/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

[[noreturn]] void fail(const char* stream) {
  const int reason = errno;
  std::string message = std::string(stream) + " can't be written";
  if (reason != 0) message += ": " + std::system_category().message(reason);
  throw sim::SystemError(message);
}

void flush(std::FILE* stream, const char* name) {
  const bool lost = std::ferror(stream) != 0;
  errno = 0;
  if (std::fflush(stream) != 0 || lost) fail(name);
}

}  // namespace

void open_closed_streams() {
  // The lowest number that is free is taken, so that each comes to its place.
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(standard, F_GETFD) >= 0) continue;
    const int flags = standard == STDIN_FILENO ? O_WRONLY : O_RDONLY;  // the wrong way round
    if (::open("/dev/null", flags) != standard)
      throw sim::SystemError("a standard stream is closed, and /dev/null can't be opened");
  }
}

void flush_streams() {
  flush(stdout, "standard output");
  flush(stderr, "standard error");
}

bool is_text_lost() { return std::ferror(stdout) != 0 || std::ferror(stderr) != 0; }

}  // namespace articular::tools
