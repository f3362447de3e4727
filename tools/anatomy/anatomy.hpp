#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "tools/anatomy/anatomy_tables.hpp"

namespace articular::anatomy {

/// Writes every mesh and table of an anatomy into a folder, which is made if need be.
/// @throws sim::SystemError when that fails
void write_anatomy(const Anatomy& anatomy, const std::filesystem::path& folder);

/// `articular anatomy mandible|knee [--size H] --out DIR`.
/// @param[out] exit_code  0; set when the command ran. Errors are thrown
void add_anatomy_command(CLI::App& app, int& exit_code);

}  // namespace articular::anatomy
