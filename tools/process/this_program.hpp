#pragma once

#include <filesystem>

namespace articular::tools {

/// The file of the running program. @throws sim::SystemError
std::filesystem::path this_program();

/// The file that this code lies in: the program, or a library that another program has loaded.
/// @throws sim::SystemError
std::filesystem::path this_library();

}  // namespace articular::tools
