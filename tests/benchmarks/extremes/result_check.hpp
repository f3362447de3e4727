#pragma once

#include <filesystem>
#include <string>

namespace articular::benchmarks {

/// Reads all that a run has written as a user would: summary.json, history.csv, the series and its
/// frames. @return what is missing, unreadable or not finite; "" if nothing is
std::string what_is_invalid(const std::filesystem::path& results);

}  // namespace articular::benchmarks
