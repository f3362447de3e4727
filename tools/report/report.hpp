#pragma once

#include <filesystem>
#include <string>

namespace articular::tools {

struct ReportOptions {
  std::string what;           // the folder of a run, or a scenario
  std::filesystem::path out;  // empty: DIR/report.html, or NAME_setup.html in the working folder
};

/// Writes one HTML page of a run, or of a scenario's set-up, that needs no other file.
/// @return 0
/// @throws InputError, SystemError
int report(const ReportOptions& options);

}  // namespace articular::tools
