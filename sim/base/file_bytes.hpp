#pragma once

#include <filesystem>
#include <string>

namespace articular::sim {

/// All that a file holds, as it is. @throws InputError that says why where it can't be read
std::string file_bytes(const std::filesystem::path& file);

}  // namespace articular::sim
