#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/study_values.hpp"

/// What a search for a target leaves behind, so that one that was stopped need not begin anew.
namespace articular::tools {

/// Makes the folder, and empties it of what was found for other inputs.
/// @throws sim::InputError  where it is a symbolic link
void open_kept_runs(const std::filesystem::path& folder, const std::string& inputs);

/// The history and the time of a run with these overrides.
class KeptRun {
 public:
  KeptRun(const std::filesystem::path& folder, const std::vector<std::string>& overrides);

  bool is_finished() const;
  /// A checkpoint in the folder of the results, if there is one, is this run's.
  bool is_begun() const;
  void begin() const;
  void keep(const std::filesystem::path& results, double seconds) const;

  RunHistory history() const;  // with the sizes of forces
  double seconds() const;
  /// Whether this folder holds its whole results.
  bool is_in(const std::filesystem::path& results) const;

 private:
  std::filesystem::path folder_, begun_;
  std::string key_;
};

}  // namespace articular::tools
