#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace articular::benchmarks {

struct ChildEnd {
  int exit_code = -1;  // -1: by a signal
  bool timed_out = false;
  double seconds = 0;  // wall time
};

/// Runs a program, both its outputs to a file; one that takes longer than `limit` [s] is killed.
/// @throws std::system_error when it can't be started
ChildEnd run_limited(const std::vector<std::string>& command, const std::filesystem::path& log,
                     double limit);

}  // namespace articular::benchmarks
