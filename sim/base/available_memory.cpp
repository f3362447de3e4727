#include "sim/base/available_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

namespace articular::sim {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// MemAvailable and, if it counts, SwapFree, in lines such as "SwapFree:    1024 kB".
double free_on_machine(bool swap_counts) {
  std::ifstream in("/proc/meminfo");
  double sum = 0, kilobytes = 0;
  bool found = false;
  for (std::string name, unit; in >> name >> kilobytes; std::getline(in, unit)) {
    if (name == "MemAvailable:" || (swap_counts && name == "SwapFree:")) sum += 1024 * kilobytes;
    found |= name == "MemAvailable:";
  }
  return found ? sum : kUnlimited;
}

/// The first number of a file, which may say "max".
double limit_in(const char* file) {
  double limit = 0;
  return std::ifstream(file) >> limit ? limit : kUnlimited;
}

double limit_of_process() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  return static_cast<double>(limit.rlim_cur);
}

double available(bool swap_counts) {
  return std::min({free_on_machine(swap_counts), limit_in("/sys/fs/cgroup/memory.max"),
                   limit_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"), limit_of_process()});
}

}  // namespace

double available_memory() { return available(true); }

double available_memory_without_swap() { return available(false); }

std::string size_text(double bytes) {
  constexpr std::array kUnits = {"kB", "MB", "GB", "TB", "PB"};
  bytes /= 1000;
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

}  // namespace articular::sim
