#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/call_log.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::faults {

/// What comes over the call of that number, from 1: see fault_layer.cpp.
struct Fault {
  std::string with;
  std::size_t at = 0;  // 0: none
};

/// `articular run scene.toml --out area/out` in the folder, with the fault layer in between. The
/// layer looks at folder/area.
/// @param more  arguments
ProgramResult run_with_fault(const TemporaryFolder& folder, const Fault& fault,
                             const std::string& more = "");

/// The same without a fault; the calls that it made.
std::vector<Call> calls_of_run(const TemporaryFolder& folder, const std::string& more = "");

/// All files below a folder by their path, but for what summary.json has of times and memory, and
/// for the checkpoint before the newest.
std::map<std::string, std::string> results(const std::filesystem::path& folder);

/// "" where both are equal, else the first file that differs.
std::string difference(const std::map<std::string, std::string>& expected,
                       const std::map<std::string, std::string>& found);

/// Of summary.json; "" where there is none.
std::string outcome(const std::filesystem::path& folder);

}  // namespace articular::faults
