#include "tools/process/this_program.hpp"

#include <dlfcn.h>

#include <system_error>

#include "sim/base/error.hpp"

namespace articular::tools {

std::filesystem::path this_program() {
  std::error_code error;
  std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw sim::SystemError("can't tell where this program lies: " + error.message());
  return self;
}

std::filesystem::path this_library() {
  Dl_info found{};
  if (dladdr(reinterpret_cast<const void*>(&this_library), &found) == 0)
    throw sim::SystemError("can't tell where this library lies");
  std::error_code error;
  std::filesystem::path file = std::filesystem::canonical(found.dli_fname, error);
  return error ? this_program() : file;  // of a program it is as the program was called
}

}  // namespace articular::tools
