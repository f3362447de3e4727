#include "tools/process/status_line.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace articular::tools {

StatusLine::StatusLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

void StatusLine::show(const std::string& text) {
  const std::string line = is_terminal_ ? "\r" + text + "\x1b[K" : text + "\n";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  is_open_ = is_terminal_;
}

void StatusLine::end() {
  if (std::exchange(is_open_, false)) std::fputc('\n', stderr);
}

void StatusLine::erase() {
  if (std::exchange(is_open_, false)) std::fputs("\r\x1b[K", stderr);
}

}  // namespace articular::tools
