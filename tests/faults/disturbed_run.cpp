#include "tests/faults/disturbed_run.hpp"

#include <nlohmann/json.hpp>

namespace articular::faults {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLog = "calls";

/// A run takes a tenth of a second; `timeout` gives 124 where it hangs.
ProgramResult run_with(const TemporaryFolder& folder, const std::string& variables,
                       const std::string& more) {
  return run_shell(folder,
                   "FAULTS_FOLDER=\"$PWD/area\" " + variables +
                       " LD_PRELOAD='" ARTICULAR_FAULT_LAYER
                       "' timeout 60 \"$articular\" run scene.toml --out area/out --quiet " +
                       more);
}

std::string without_times(const std::string& summary) {
  auto json = nlohmann::json::parse(summary, nullptr, false);
  if (!json.is_object()) return summary;
  for (const char* const key : {"wall_time_s", "peak_memory_MB"}) json.erase(key);
  return json.dump(1);
}

}  // namespace

ProgramResult run_with_fault(const TemporaryFolder& folder, const Fault& fault,
                             const std::string& more) {
  return run_with(folder, "FAULTS_AT=" + std::to_string(fault.at) + " FAULTS_WITH=" + fault.with,
                  more);
}

std::vector<Call> calls_of_run(const TemporaryFolder& folder, const std::string& more) {
  const ProgramResult result = run_with(folder, "FAULTS_LOG=\"$PWD/calls\"", more);
  if (result.exit_code != 0) throw std::runtime_error("an undisturbed run failed: " + result.err);
  return read_calls(folder / kLog);
}

std::map<std::string, std::string> results(const fs::path& folder) {
  std::map<std::string, std::string> files;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none)) {
    if (!entry.is_regular_file() || entry.path().filename() == "previous.bin") continue;
    std::string text = content(entry.path());
    if (entry.path().filename() == "summary.json") text = without_times(text);
    files[fs::relative(entry.path(), folder).string()] = text;
  }
  return files;
}

std::string difference(const std::map<std::string, std::string>& expected,
                       const std::map<std::string, std::string>& found) {
  for (const auto& [name, text] : expected) {
    const auto other = found.find(name);
    if (other == found.end()) return name + " is missing";
    if (other->second != text) return name + " has other bytes";
  }
  for (const auto& [name, text] : found)
    if (!expected.contains(name)) return name + " should not be there";
  return "";
}

std::string outcome(const fs::path& folder) {
  const auto json = nlohmann::json::parse(content(folder / "summary.json"), nullptr, false);
  return json.is_object() ? json.value("outcome", "") : "";
}

}  // namespace articular::faults
