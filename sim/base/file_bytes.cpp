#include "sim/base/file_bytes.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "sim/base/error.hpp"

namespace articular::sim {

std::string file_bytes(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string bytes;
  std::array<char, 1 << 16> part;
  while (in.read(part.data(), part.size()) || in.gcount() > 0)
    bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
  // At the end of a file only the last read failed; a folder can be opened, and not read.
  if (!in.is_open() || in.bad())
    throw InputError({file.string()},
                     fmt::format("cannot read this file: {}",
                                 errno != 0 ? std::strerror(errno) : "unknown reason"));
  return bytes;
}

}  // namespace articular::sim
