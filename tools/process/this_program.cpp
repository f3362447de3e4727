#include "tools/process/this_program.hpp"

#include <system_error>

#include "sim/base/error.hpp"

namespace articular::tools {

std::filesystem::path this_program() {
  std::error_code error;
  std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw sim::SystemError("can't tell where this program lies: " + error.message());
  return self;
}

}  // namespace articular::tools
