#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular {

struct ProgramResult {
  int exit_code = -1;
  std::string out, err;
};

/// The program under test: another one than that beside the tests where the environment says so.
inline std::string program_path() {
  const char* given = std::getenv("ARTICULAR_PROGRAM");
  return given != nullptr ? given : ARTICULAR_PROGRAM;
}

/// Runs a shell script with the folder as working folder. $articular is the program.
inline ProgramResult run_shell(const TemporaryFolder& folder, const std::string& script) {
  const std::string command = "export articular='" + program_path() + "'; cd '" +
                              folder.path().string() + "' || exit 99; { " + script +
                              "; } > .stdout 2> .stderr < /dev/null";
  const int status = std::system(command.c_str());
  ProgramResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  result.out = content(folder / ".stdout");
  result.err = content(folder / ".stderr");
  return result;
}

/// Runs `articular ARGUMENTS`, as the shell reads them.
inline ProgramResult run_program(const TemporaryFolder& folder, const std::string& arguments) {
  return run_shell(folder, "\"$articular\" " + arguments);
}

}  // namespace articular
