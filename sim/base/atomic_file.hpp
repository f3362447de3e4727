#pragma once

#include <filesystem>
#include <string>

namespace articular::sim {

/// When what was written outlasts a power cut: at once, or once somebody calls sync_file().
enum class Durable { Now, Later };

/// Writes a file (text or bytes) whole or not at all: beside it as `<file>.part`, then renamed.
/// What is no regular file (/dev/stdout, a pipe) is written straight. @throws SystemError
void write_text_file(const std::filesystem::path& file, const std::string& text,
                     Durable durable = Durable::Now);

/// A file, or a folder with the names in it, outlasts a power cut from now on. @throws SystemError
void sync_file(const std::filesystem::path& file);
/// So does the name of a file, in the folder that it lies in. @throws SystemError
void sync_name(const std::filesystem::path& file);

/// Makes a folder and those above it, where they are not there; they outlast a power cut.
/// @throws SystemError
void make_folders(const std::filesystem::path& folder);

}  // namespace articular::sim
