#include "tools/process/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "sim/base/error.hpp"

namespace articular::tools {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error)
    throw sim::SystemError("no folder for temporary files (is TMPDIR one?): " + error.message());
  std::string pattern = (parent / "articular-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw sim::SystemError(parent.string() +
                           ": no temporary folder can be made: " + std::strerror(errno));
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace articular::tools
