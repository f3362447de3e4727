#pragma once

#include <filesystem>
#include <string>

namespace articular::sim {

/// All that a file holds, as it is. @throws InputError that says why where it can't be read
/// @throws SystemError where that is for no reason of its name, kind or rights, as a broken disk
std::string file_bytes(const std::filesystem::path& file);

}  // namespace articular::sim
