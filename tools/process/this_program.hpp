#pragma once

#include <filesystem>

namespace articular::tools {

/// The file of the running program. @throws sim::SystemError
std::filesystem::path this_program();

}  // namespace articular::tools
