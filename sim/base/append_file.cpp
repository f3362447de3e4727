#include "sim/base/append_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

constexpr int kFlags = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW;
constexpr mode_t kReadAndWrite = 0666;  // less what the user's mask takes away

/// As far as the file goes, at most that of so many bytes. @return 0, or the error number
int read_extent(int descriptor, std::uint64_t most_bytes, FileExtent& extent) {
  std::array<char, 1 << 16> part{};
  while (extent.bytes < most_bytes) {
    const std::size_t wanted = std::min<std::uint64_t>(part.size(), most_bytes - extent.bytes);
    const ssize_t count =
        ::pread(descriptor, part.data(), wanted, static_cast<off_t>(extent.bytes));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) break;
    extent.hash = hash_bytes({part.data(), static_cast<std::size_t>(count)}, extent.hash);
    extent.bytes += static_cast<std::uint64_t>(count);
  }
  return 0;
}

}  // namespace

AppendFile::AppendFile(const std::filesystem::path& file)
    : file_(file),
      descriptor_(::open(file.c_str(), kFlags | O_TRUNC, kReadAndWrite)),
      is_new_(true) {
  if (descriptor_ < 0) fail(errno);
}

AppendFile::AppendFile(const std::filesystem::path& file, const FileExtent& extent)
    : file_(file),
      descriptor_(::open(file.c_str(), kFlags & ~O_CREAT)),
      extent_(extent),
      is_cut_(false) {
  FileExtent found;
  if (descriptor_ < 0 && errno != ENOENT) fail(errno);
  if (descriptor_ >= 0) {
    const int error = read_extent(descriptor_, extent.bytes, found);
    if (error == 0 && found == extent) return;
    ::close(descriptor_);
    if (error != 0) fail(error);
  }
  throw InputError(
      {file.string()},
      fmt::format(
          "does not begin with the {} bytes that the run had written up to its "
          "checkpoint (found {}): put them back, or run without --resume",
          extent.bytes,
          found.bytes < extent.bytes ? std::to_string(found.bytes) : std::string("others")));
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendFile::cut() {
  if (is_cut_) return;
  if (::ftruncate(descriptor_, static_cast<off_t>(extent_.bytes)) != 0) fail(errno);
  is_cut_ = true;
}

void AppendFile::append(const std::string& text, const std::string& closing) {
  cut();
  const std::string bytes = text + closing;
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done,
                                   static_cast<off_t>(extent_.bytes + done));
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  extent_.hash = hash_bytes(text, extent_.hash);
  extent_.bytes += text.size();
}

void AppendFile::sync() {
  cut();
  if (::fsync(descriptor_) != 0 && errno != EINVAL)
    fail(errno);  // EINVAL: a device, nothing to sync
  if (std::exchange(is_new_, false)) sync_name(file_);
}

void AppendFile::fail(int error) const {
  throw SystemError(file_.string() + (error == ELOOP ? ": is a symbolic link; results are not "
                                                       "written through one"
                                                     : ": can't be written: " +
                                                           std::system_category().message(error)));
}

}  // namespace articular::sim
