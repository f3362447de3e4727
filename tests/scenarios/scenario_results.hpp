#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular {

/// What a run left in history.csv and summary.json.
class ScenarioResults {
 public:
  explicit ScenarioResults(const std::filesystem::path& folder)
      : summary_(nlohmann::json::parse(content(folder / "summary.json"))) {
    std::istringstream text(content(folder / "history.csv"));
    std::vector<std::string> names;
    std::string line, cell;
    std::getline(text, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    while (std::getline(text, line)) {
      std::size_t column = 0;
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        columns_[names.at(column++)].push_back(
            cell.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(cell));
    }
  }

  /// A column by its name in the file, such as "end.position.z [mm]".
  const std::vector<double>& column(const std::string& name) const { return columns_.at(name); }
  double last(const std::string& name) const { return column(name).back(); }
  double at(const std::string& name, double time) const {
    const std::vector<double>& times = column("time [s]");
    const auto row = std::lower_bound(times.begin(), times.end(), time * (1 - 1e-9));
    if (row == times.end()) throw std::out_of_range("the history ends earlier");
    return column(name)[static_cast<std::size_t>(row - times.begin())];
  }
  double largest(const std::string& name) const {
    return *std::max_element(column(name).begin(), column(name).end());
  }
  double smallest(const std::string& name) const {
    return *std::min_element(column(name).begin(), column(name).end());
  }
  double count(const std::string& name) const { return summary_.at("counts").at(name); }
  const nlohmann::json& summary() const { return summary_; }

 private:
  nlohmann::json summary_;
  std::map<std::string, std::vector<double>> columns_;
};

inline ScenarioResults run_scenario(const sim::Scenario& scenario) {
  const TemporaryFolder folder;
  sim::RunOptions options;
  options.directory = folder.path();
  sim::run(scenario, sim::build_model(scenario), options);
  return ScenarioResults(folder.path());
}

/// scenarios/FILE, or the file of an absolute path, with overrides as of `--set`.
inline sim::Scenario shipped_scenario(const std::string& file,
                                      const std::vector<std::string>& overrides = {}) {
  return sim::read_scenario(std::filesystem::path(ARTICULAR_SOURCE_DIR) / "scenarios" / file,
                            overrides);
}

inline ScenarioResults run_scenario(const std::string& file,
                                    const std::vector<std::string>& overrides = {}) {
  return run_scenario(shipped_scenario(file, overrides));
}

}  // namespace articular
