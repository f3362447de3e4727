#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace articular::tools {

/// Another program, found on PATH, that runs beside this one and does not outlive this object. What
/// it prints goes into a file.
class StartedProgram {
 public:
  /// @throws sim::SystemError  when it can't be started, or the file not be written
  StartedProgram(const std::vector<std::string>& command, const std::filesystem::path& log);
  ~StartedProgram();
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  bool is_running();

 private:
  pid_t pid_ = -1;
};

}  // namespace articular::tools
