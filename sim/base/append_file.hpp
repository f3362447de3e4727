#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/base/hash.hpp"

namespace articular::sim {

/// How a file begins: enough to know it again.
struct FileExtent {
  std::uint64_t bytes = 0;
  std::uint64_t hash = kHashOfNothing;  // of those bytes

  bool operator==(const FileExtent&) const = default;
};

/// A file that grows at its end and is never written whole again. What a killed run or a full disk
/// left half-written lies behind the extent that a checkpoint knows, and is cut off before anything
/// is appended there. No symbolic link is followed.
class AppendFile {
 public:
  /// A new file, in the place of one that may be there. @throws SystemError
  explicit AppendFile(const std::filesystem::path& file);
  /// Goes on where an earlier file had that extent. @throws InputError where it does not begin so
  AppendFile(const std::filesystem::path& file, const FileExtent& extent);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// @param closing  written behind the text, for those who read the file meanwhile; the next text
  ///                 takes its place and must not be shorter
  /// @throws SystemError
  void append(const std::string& text, const std::string& closing = "");
  /// What was appended outlasts a power cut from now on. @throws SystemError
  void sync();

  /// Of what was appended, without the closing.
  const FileExtent& extent() const { return extent_; }

 private:
  [[noreturn]] void fail(int error) const;

  void cut();

  std::filesystem::path file_;
  int descriptor_ = -1;
  FileExtent extent_;
  bool is_new_ = false;  // the name of the file may not outlast a power cut
  bool is_cut_ = true;
};

}  // namespace articular::sim
