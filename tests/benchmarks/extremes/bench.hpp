#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/model/model.hpp"
#include "sim/model/state.hpp"

namespace articular::benchmarks {

/// What became of `articular run`.
struct ProgramRun {
  int exit_code = -1;  // -1: ended by a signal, or by us
  bool timed_out = false;
  double seconds = 0;             // wall time
  std::string message;            // why it could not go on, or the last line on stderr
  std::filesystem::path results;  // folder
};

/// Where one extreme is tried: a folder of its own and the program.
class Bench {
 public:
  Bench(std::filesystem::path program, std::filesystem::path folder);

  /// Writes NAME.toml and runs it, with one thread and a limit of wall time [s].
  ProgramRun run(const std::string& name, const std::string& scenario, double limit) const;

  /// As run(), but everything begins in a state that no scenario can express: `change` gets what
  /// the scenario starts with. The program gets it as a checkpoint at t = 0.
  ProgramRun run_from(const std::string& name, const std::string& scenario, double limit,
                      const std::function<void(const sim::Model&, sim::State&)>& change) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  ProgramRun start(const std::vector<std::string>& arguments, const std::string& name,
                   double limit) const;

  std::filesystem::path program_, folder_;
};

}  // namespace articular::benchmarks
