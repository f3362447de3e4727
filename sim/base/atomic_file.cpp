#include "sim/base/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
  throw SystemError(file.string() + ": can't be written: " + std::system_category().message(error));
}

/// Closes on leaving; close() itself reports what a network drive says only then.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path) : fd_(::open(path.c_str(), kFlags, 0666)) {}
  ~OpenFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// 0, or the error number of the first call that failed.
  int write_and_close(const std::string& text, Durable durable) {
    if (fd_ < 0) return errno;
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t count = ::write(fd_, text.data() + done, text.size() - done);
      if (count < 0 && errno != EINTR) return errno;
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    if (durable == Durable::Now && ::fsync(fd_) != 0 && errno != EINVAL) return errno;
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0 ? 0 : errno;
  }

 private:
  static constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
  int fd_;
};

}  // namespace

void write_text_file(const fs::path& file, const std::string& text, Durable durable) {
  std::error_code status;
  fs::path target = file;
  if (fs::is_symlink(file, status)) {  // the link stays, what it points to is replaced
    target = fs::weakly_canonical(file, status);
    if (status) fail(file, status.value());
  }
  // A pipe or device (/dev/stdout, /dev/full) must be written itself: a rename would replace it.
  if (fs::exists(target, status) && fs::is_other(target, status)) {
    if (const int error = OpenFile(target).write_and_close(text, Durable::Later)) fail(file, error);
    return;
  }
  // A fixed name, so that what a killed run left is overwritten by the next.
  fs::path temporary = target;
  temporary += ".part";
  if (const int error = OpenFile(temporary).write_and_close(text, durable)) {
    ::unlink(temporary.c_str());
    fail(file, error);
  }
  fs::rename(temporary, target, status);
  if (status) {
    ::unlink(temporary.c_str());
    fail(file, status.value());
  }
  if (durable == Durable::Now) sync_name(target);
}

void make_folders(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> above;  // of those that are new: what their names are written into
  for (fs::path path = fs::absolute(folder);
       path.has_relative_path() && !fs::is_directory(path, error); path = path.parent_path())
    above.push_back(path.parent_path());
  fs::create_directories(folder, error);
  if (error) throw SystemError(folder.string() + ": the folder can't be made: " + error.message());
  for (const fs::path& path : above)
    if (::access(path.c_str(), R_OK) == 0) sync_file(path);
}

void sync_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, errno);
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0 && error != EINVAL) fail(file, error);  // EINVAL: a file system that can't
}

void sync_name(const fs::path& file) {
  const fs::path folder = file.parent_path();
  sync_file(folder.empty() ? "." : folder);
}

}  // namespace articular::sim
