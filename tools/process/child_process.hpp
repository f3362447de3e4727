#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace articular::tools {

/// A file descriptor that closes itself.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  int get() const { return fd_; }
  int release();
  void close();

 private:
  int fd_;
};

/// Both ends are closed in programs started later. @throws SystemError
struct Pipe {
  Pipe();
  FileDescriptor read_end, write_end;
};

/// Another program, found on PATH, that does not outlive this object (nor this process). What it
/// prints is dropped.
class ChildProcess {
 public:
  enum class Started { Yes, NotInstalled };

  /// @param inherited  a descriptor that the program gets as its number `as`
  /// @throws SystemError when the program is there but can't be started
  static Started start(const std::vector<std::string>& command, int inherited, int as,
                       ChildProcess& child);

  ChildProcess() = default;
  ~ChildProcess();  // asks it to end until it does; after a few seconds it is killed
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for the end; true if it ended by itself with status 0.
  bool wait();

 private:
  pid_t pid_ = -1;
};

}  // namespace articular::tools
