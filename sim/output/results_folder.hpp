#pragma once

#include <filesystem>
#include <string>

namespace articular::sim {

/// The folder of one run's results, which no other run writes to while this lives.
class ResultsFolder {
 public:
  /// Makes it where it is not there.
  /// @throws SystemError when it can't be made or written
  /// @throws InputError when another run has it
  explicit ResultsFolder(const std::filesystem::path& folder);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

 private:
  int descriptor_;  // locked; the lock goes with the process
};

/// What runs write, and nothing else, is removed: history, frames, series, checkpoints. The summary
/// says "unfinished" before anything is.
/// @param scenario   the file that the new results are of
/// @param overwrite  also those of another scenario, by its name or folder
/// @throws InputError where they are of another one, or a symbolic link stands in their place
/// @throws SystemError where they can't be removed
void clear_results(const std::filesystem::path& folder, const std::filesystem::path& scenario,
                   bool overwrite);

/// Where a scenario lies, as summary.json says it: whole, so that it is the same from everywhere.
std::string folder_of(const std::filesystem::path& scenario);

/// A summary for as long as the run goes on; a killed one leaves it. @throws SystemError
void write_unfinished_summary(const std::filesystem::path& folder,
                              const std::filesystem::path& scenario);

}  // namespace articular::sim
