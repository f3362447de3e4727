#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace articular::tools {

/// Words for +x, +y and +z, such as "left", "posterior", "superior"; empty where a scenario states
/// none.
using Directions = std::array<std::string, 3>;

/// What a picture says of a run beside its frames.
struct RunSummary {
  std::string title;  // of the scenario; "" where there is no summary
  std::optional<double>
      whole_load;  // [s] of a static analysis: time says how much of the load acts
  Directions directions;
};

/// From summary.json in the folder. What it lacks stays empty: frames can be drawn without it.
RunSummary read_run_summary(const std::filesystem::path& folder);

}  // namespace articular::tools
