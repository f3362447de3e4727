#pragma once

#include <filesystem>
#include <string>

#include "tools/study/study_run.hpp"

namespace articular::tools {

/// The record of a case as it is kept in its folder, with a `key` that says of what.
void write_record(const std::filesystem::path& file, const std::string& key,
                  const CaseRecord& record);

/// Empty if there is none, none with this key, or a damaged one.
CaseRecord read_record(const std::filesystem::path& file, const std::string& key);

}  // namespace articular::tools
