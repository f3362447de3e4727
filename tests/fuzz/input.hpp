#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "sim/base/error.hpp"

/// What the programs of libFuzzer share: each gives its bytes to readers as a file, since that is
/// what they read, and tells what may come of it.
namespace articular::fuzz {

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The bytes as a file of that name, in a folder of this process under TMPDIR: `run` puts that into
/// memory. The file lasts until the next one of its name.
std::filesystem::path as_file(const char* name, std::string_view bytes);

/// Ends the program unless a message is text of printable lines: others garble a terminal.
void expect_readable(const char* message);

/// Reads something. An InputError with a readable message is fine. Any other exception goes on and
/// ends the program, which libFuzzer counts as a finding.
/// @return whether it was read
template <class Read>
bool read_or_refused(Read read) {
  try {
    read();
    return true;
  } catch (const sim::InputError& error) {
    expect_readable(error.what());
    return false;
  }
}

}  // namespace articular::fuzz
