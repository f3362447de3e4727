#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace articular::tools {

/// What a program used, and how it ended.
struct ProgramUse {
  /// Lost: it ran on another machine, and nobody knows.
  enum class End { Exited, Signalled, TimeLimit, Interrupted, Lost };
  End end = End::Exited;
  int code = 0;  // exit code, or number of the signal
  double wall_seconds = 0, cpu_seconds = 0, peak_megabytes = 0;
};

/// Runs a program, found on PATH, to its end with stdout and stderr in a file. It gets SIGTERM, and
/// ten seconds later SIGKILL, when its time is up or `interrupted` becomes true, and ends with this
/// process.
/// @param environment  "NAME=VALUE", added to that of this process
/// @param time_limit   [s]
/// @throws sim::SystemError  when it can't be started or the file not be written
ProgramUse run_measured(const std::vector<std::string>& command,
                        const std::vector<std::string>& environment,
                        const std::filesystem::path& log, std::optional<double> time_limit,
                        const std::function<bool()>& interrupted);

}  // namespace articular::tools
