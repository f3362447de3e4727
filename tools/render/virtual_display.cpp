#include "tools/render/virtual_display.hpp"

#include <X11/Xlib.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

bool answers() {
  Display* const display = XOpenDisplay(nullptr);
  if (display == nullptr) return false;
  XCloseDisplay(display);
  return true;
}

/// The line that Xvfb writes when it is ready: its display number. Empty if it ends before, or is
/// late.
std::string read_line(int fd, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  std::string line;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - std::chrono::steady_clock::now());
    pollfd ready{fd, POLLIN, 0};
    const int count = left.count() > 0 ? ::poll(&ready, 1, static_cast<int>(left.count())) : 0;
    if (count < 0 && errno == EINTR) continue;
    char c = 0;
    if (count <= 0 || ::read(fd, &c, 1) != 1) return "";
    if (c == '\n') return line;
    line += c;
  }
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  const char* const display = std::getenv("DISPLAY");
  if (display != nullptr) previous_ = display;
  if (display != nullptr && *display != '\0' && answers()) return;

  constexpr int kDisplayFd = 3;                  // the first after the standard ones
  constexpr std::chrono::seconds kPatience{30};  // it takes 0.1 s; loaded machines longer
  Pipe number;
  // Pictures are drawn into a buffer of their own: the size of the screen does not limit theirs.
  const auto started =
      ChildProcess::start({"Xvfb", "-displayfd", std::to_string(kDisplayFd), "-screen", "0",
                           "640x480x24", "-nolisten", "tcp", "-noreset"},
                          number.write_end.get(), kDisplayFd, xvfb_);
  if (started == ChildProcess::Started::NotInstalled)
    throw sim::SystemError(
        "no display to draw on: $DISPLAY names none that answers, and Xvfb is not installed "
        "(Debian: apt install xvfb)");
  number.write_end.close();
  const std::string line = read_line(number.read_end.get(), kPatience);
  if (line.empty())
    throw sim::SystemError(
        "no display to draw on: $DISPLAY names none that answers, and Xvfb did not start");
  ::setenv("DISPLAY", (":" + line).c_str(), 1);
  started_ = true;
}

VirtualDisplay::~VirtualDisplay() {
  if (!started_) return;
  if (previous_)
    ::setenv("DISPLAY", previous_->c_str(), 1);
  else
    ::unsetenv("DISPLAY");
}

}  // namespace articular::tools
