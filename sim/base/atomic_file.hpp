#pragma once

#include <filesystem>
#include <string>

namespace articular::sim {

/// Writes a file (text or bytes) whole or not at all: beside it as `<file>.part`, then renamed.
/// What is no regular file (/dev/stdout, a pipe) is written straight. @throws SystemError
void write_text_file(const std::filesystem::path& file, const std::string& text);

}  // namespace articular::sim
