#include "tools/process/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>
#include <system_error>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

constexpr long kPatience = 600'000'000;  // [ns]; the end takes time too, of one second in all

std::atomic<bool> asked = false, heard = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // else a signal handler may not touch it

timer_t patience{};
bool has_timer = false;

void set_patience(long nanoseconds) {
  const itimerspec once = {.it_interval = {}, .it_value = {0, nanoseconds}};
  ::timer_settime(patience, 0, &once, nullptr);
}

// What follows runs within a signal: only calls that are allowed there.

[[noreturn]] void end(int) {
  constexpr std::string_view kWords = "articular: interrupted\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kWords.data(), kWords.size());
  ::_exit(kInterruptedExitCode);
}

void ask(int signal) {
  if (asked.exchange(true)) end(signal);
  const int error = errno;
  set_patience(kPatience);
  errno = error;
}

void at_interruption(void (*act)(int)) {
  std::signal(SIGINT, act);
  std::signal(SIGTERM, act);
  if (std::signal(SIGHUP, act) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

}  // namespace

void end_at_interruption() { at_interruption(end); }

void listen_for_interruption() {
  std::signal(SIGALRM, end);
  if (!has_timer && ::timer_create(CLOCK_MONOTONIC, nullptr, &patience) != 0)
    throw sim::SystemError("no timer is to be had: " + std::system_category().message(errno));
  has_timer = true;
  at_interruption(ask);
}

bool interruption_asked() {
  if (asked && !heard.exchange(true)) set_patience(0);
  return asked;
}

}  // namespace articular::tools
