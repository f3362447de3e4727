#pragma once

#include <filesystem>

namespace articular::tools {

/// A folder of its own under TMPDIR (/tmp), removed with all that is in it.
class TemporaryFolder {
 public:
  /// @throws sim::SystemError  when none can be made
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace articular::tools
