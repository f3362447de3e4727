#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace articular::benchmarks {

/// Processor time of this process [s], of all its threads: other programs do not count, and nobody
/// gains by threads.
inline double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace articular::benchmarks
