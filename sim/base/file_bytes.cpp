#include "sim/base/file_bytes.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

/// What another name or other rights mend.
bool is_of_the_name(int error) {
  for (const int one : {ENOENT, ENOTDIR, EISDIR, EACCES, EPERM, ELOOP, ENAMETOOLONG, EINVAL, ENXIO})
    if (error == one) return true;
  return false;
}

}  // namespace

std::string file_bytes(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string bytes;
  std::array<char, 1 << 16> part;
  while (in.read(part.data(), part.size()) || in.gcount() > 0)
    bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
  // At the end of a file only the last read failed; a folder can be opened, and not read.
  if (in.is_open() && !in.bad()) return bytes;
  const int error = errno;
  const std::string why = fmt::format("cannot read this file: {}",
                                      error != 0 ? std::strerror(error) : "unknown reason");
  if (error == 0 || is_of_the_name(error)) throw InputError({file.string()}, why);
  throw SystemError(file.string() + ": " + why);
}

}  // namespace articular::sim
