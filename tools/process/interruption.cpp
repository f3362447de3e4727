#include "tools/process/interruption.hpp"

#include <atomic>
#include <csignal>

namespace articular::tools {
namespace {

std::atomic<bool> asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // else a signal handler may not touch it

void ask(int signal) {
  asked = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void listen_for_interruption() {
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
  if (std::signal(SIGHUP, ask) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

bool interruption_asked() { return asked; }

}  // namespace articular::tools
