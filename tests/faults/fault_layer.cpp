// A library for LD_PRELOAD, between a program and the system: it counts the calls that change what
// lies below one folder, writes them down, and makes one of them fail.
//
//   FAULTS_FOLDER  absolute path of the folder
//   FAULTS_LOG     where calls are written down (call_log.hpp); none: nowhere
//   FAULTS_AT      the number of the call, from 1; none: no call
//   FAULTS_WITH    what comes over it:
//                    ENOSPC, EIO, EROFS, EDQUOT  the call does nothing and gives this error
//                    ENOSPC+                     so do all that need space from then on
//                    short                       a write takes half of its bytes, and says so
//                    kill                        the process is killed in place of the call
//                    tear                        and half of a write is done
//
// The calls are made straight (syscall(2)), so that the C library's own functions of these names
// need not be found; only fopen() is.

#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <string_view>

#include "tests/faults/call_log.hpp"

namespace {

using articular::faults::Call;
using Kind = Call::Kind;

constexpr int kMostDescriptors = 1024;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// What is watched, and what is to happen.
struct Layer {
  std::string folder = variable("FAULTS_FOLDER"), with = variable("FAULTS_WITH");
  long at = std::atol(variable("FAULTS_AT").c_str());
  int log = -1;
  long num_calls = 0;
  int num_handles = 0;
  std::array<int, kMostDescriptors> handles{};  // by descriptor, from 1; 0: not watched
  std::recursive_mutex mutex;

  Layer() {
    const std::string name = variable("FAULTS_LOG");
    if (!name.empty())
      log = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, name.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  }

  bool watches(const std::string& path) const {
    return !folder.empty() && path.compare(0, folder.size(), folder) == 0 &&
           (path.size() == folder.size() || path[folder.size()] == '/');
  }

  void write_down(const Call& call) const {
    if (log < 0) return;
    const std::string text = articular::faults::packed(call);
    if (::syscall(SYS_write, log, text.data(), text.size()) != static_cast<long>(text.size()))
      std::abort();
  }
};

Layer& layer() {
  static Layer the_layer;
  return the_layer;
}

int handle_of(int descriptor) {
  if (descriptor < 0 || descriptor >= kMostDescriptors) return 0;
  return layer().handles[static_cast<std::size_t>(descriptor)];
}

/// A descriptor may have been closed within the C library, where this layer does not see it.
void forget(int descriptor) {
  if (handle_of(descriptor) != 0) layer().handles[static_cast<std::size_t>(descriptor)] = 0;
}

/// The path from the root.
std::string absolute(int folder, const char* path) {
  if (path[0] == '/') return path;
  std::array<char, 4096> here{};
  const std::string link =
      folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/" + std::to_string(folder);
  if (::readlink(link.c_str(), here.data(), here.size() - 1) < 0) return path;
  return std::string(here.data()) + "/" + path;
}

int error_named(std::string_view name) {
  if (name == "ENOSPC" || name == "ENOSPC+") return ENOSPC;
  if (name == "EIO") return EIO;
  if (name == "EROFS") return EROFS;
  if (name == "EDQUOT") return EDQUOT;
  return 0;
}

bool needs_space(Kind kind) {
  return kind == Kind::Write || kind == Kind::OpenEmpty || kind == Kind::MakeFolder;
}

[[noreturn]] void die() {
  ::syscall(SYS_kill, ::getpid(), SIGKILL);
  for (;;) ::pause();
}

/// Counts a call. @return the error that it is to give, or 0
int fault(Kind kind) {
  Layer& l = layer();
  ++l.num_calls;
  if (l.at == 0 || l.num_calls < l.at) return 0;
  if (l.num_calls > l.at) return l.with == "ENOSPC+" && needs_space(kind) ? ENOSPC : 0;
  if (l.with == "kill" || (l.with == "tear" && kind != Kind::Write)) die();
  return error_named(l.with);
}

/// A watched call: makes it, unless it is to fail, and writes it down.
template <class Make>
long make_call(Call call, Make&& make) {
  const std::lock_guard lock(layer().mutex);
  const int error = fault(call.kind);
  const long result = error != 0 ? -1 : make();
  const int reason = error != 0 ? error : errno;
  if (result < 0) call.kind = Kind::Failed;
  if (result >= 0 && call.kind == Kind::Write) call.data.resize(static_cast<std::size_t>(result));
  layer().write_down(call);
  errno = reason;
  return result;
}

long open_call(int folder, const char* path, int flags, mode_t mode) {
  const auto make = [&] { return ::syscall(SYS_openat, folder, path, flags, mode); };
  const std::string full = absolute(folder, path);
  if (!layer().watches(full)) {
    const long descriptor = make();
    forget(static_cast<int>(descriptor));
    return descriptor;
  }
  const std::lock_guard lock(layer().mutex);
  Call call;
  call.kind = (flags & O_TRUNC) != 0 ? Kind::OpenEmpty : Kind::Open;
  call.path = full;
  call.handle = ++layer().num_handles;
  const long descriptor = make_call(call, make);
  if (descriptor >= 0 && descriptor < kMostDescriptors)
    layer().handles[static_cast<std::size_t>(descriptor)] = call.handle;
  return descriptor;
}

/// @param write  does it, with so many bytes
template <class Write>
ssize_t write_call(int descriptor, const void* bytes, std::size_t size, off_t offset,
                   Write&& write) {
  const int handle = handle_of(descriptor);
  if (handle == 0) return write(size);
  const std::lock_guard lock(layer().mutex);
  Call call;
  call.kind = Kind::Write;
  call.handle = handle;
  call.offset = static_cast<std::uint64_t>(offset);
  call.data.assign(static_cast<const char*>(bytes), size);
  const Layer& l = layer();
  const bool is_it = l.at > 0 && l.num_calls + 1 == l.at;
  if (is_it && l.with == "tear") {
    write(size / 2);
    die();
  }
  const bool half = is_it && l.with == "short" && size > 1;
  return make_call(std::move(call), [&] { return write(half ? size / 2 : size); });
}

off_t position(int descriptor) {
  return static_cast<off_t>(::syscall(SYS_lseek, descriptor, 0, SEEK_CUR));
}

int sync_call(int descriptor, long number) {
  const auto make = [&] { return ::syscall(number, descriptor); };
  const int handle = handle_of(descriptor);
  if (handle == 0) return static_cast<int>(make());
  Call call;
  call.kind = Kind::Sync;
  call.handle = handle;
  return static_cast<int>(make_call(call, make));
}

int cut_call(int descriptor, off_t size) {
  const auto make = [&] { return ::syscall(SYS_ftruncate, descriptor, size); };
  const int handle = handle_of(descriptor);
  if (handle == 0) return static_cast<int>(make());
  Call call;
  call.kind = Kind::Cut;
  call.handle = handle;
  call.offset = static_cast<std::uint64_t>(size);
  return static_cast<int>(make_call(call, make));
}

template <class Make>
int path_call(Kind kind, const char* path, const char* to, Make&& make) {
  Call call;
  call.kind = kind;
  call.path = absolute(AT_FDCWD, path);
  if (to != nullptr) call.to = absolute(AT_FDCWD, to);
  if (!layer().watches(call.path)) return static_cast<int>(make());
  return static_cast<int>(make_call(std::move(call), make));
}

mode_t mode_of(int flags, va_list list) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? static_cast<mode_t>(va_arg(list, int)) : 0;
}

}  // namespace

extern "C" {

#define OPEN_CALL(name, folder_parameter, folder)                  \
  int name(folder_parameter const char* path, int flags, ...) {    \
    va_list list;                                                  \
    va_start(list, flags);                                         \
    const mode_t mode = mode_of(flags, list);                      \
    va_end(list);                                                  \
    return static_cast<int>(open_call(folder, path, flags, mode)); \
  }
#define FOLDER_PARAMETER int folder,
OPEN_CALL(open, , AT_FDCWD)
OPEN_CALL(open64, , AT_FDCWD)
OPEN_CALL(openat, FOLDER_PARAMETER, folder)
OPEN_CALL(openat64, FOLDER_PARAMETER, folder)

/// Opened here, and then given to the C library.
std::FILE* fopen64(const char* path, const char* how) {
  using Fopen = std::FILE*(const char*, const char*);
  static const auto real = reinterpret_cast<Fopen*>(::dlsym(RTLD_NEXT, "fopen64"));
  if (!layer().watches(absolute(AT_FDCWD, path))) {
    std::FILE* const file = real(path, how);
    if (file != nullptr) forget(::fileno(file));
    return file;
  }
  int flags = how[0] == 'r' ? O_RDONLY : O_WRONLY | O_CREAT | (how[0] == 'w' ? O_TRUNC : O_APPEND);
  if (std::string_view(how).find('+') != std::string_view::npos)
    flags = (flags & ~(O_WRONLY | O_RDONLY)) | O_RDWR;
  const long descriptor = open_call(AT_FDCWD, path, flags | O_CLOEXEC, 0666);
  return descriptor < 0 ? nullptr : ::fdopen(static_cast<int>(descriptor), how);
}
std::FILE* fopen(const char* path, const char* how) { return fopen64(path, how); }

int close(int descriptor) {
  forget(descriptor);
  return static_cast<int>(::syscall(SYS_close, descriptor));
}

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  const off_t at = handle_of(descriptor) != 0 ? position(descriptor) : 0;
  return write_call(descriptor, bytes, size, at, [&](std::size_t part) {
    return ::syscall(SYS_write, descriptor, bytes, part);
  });
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (handle_of(descriptor) == 0) return ::syscall(SYS_writev, descriptor, parts, count);
  std::string bytes;
  for (int i = 0; i < count; ++i)
    bytes.append(static_cast<const char*>(parts[i].iov_base), parts[i].iov_len);
  return write(descriptor, bytes.data(), bytes.size());
}

ssize_t pwrite64(int descriptor, const void* bytes, std::size_t size, off_t offset) {
  return write_call(descriptor, bytes, size, offset, [&](std::size_t part) {
    return ::syscall(SYS_pwrite64, descriptor, bytes, part, offset);
  });
}
ssize_t pwrite(int descriptor, const void* bytes, std::size_t size, off_t offset) {
  return pwrite64(descriptor, bytes, size, offset);
}

int fsync(int descriptor) { return sync_call(descriptor, SYS_fsync); }
int fdatasync(int descriptor) { return sync_call(descriptor, SYS_fdatasync); }

int ftruncate64(int descriptor, off_t size) noexcept { return cut_call(descriptor, size); }
int ftruncate(int descriptor, off_t size) noexcept { return cut_call(descriptor, size); }

int rename(const char* path, const char* to) noexcept {
  return path_call(Kind::Rename, path, to, [&] { return ::syscall(SYS_rename, path, to); });
}

int unlink(const char* path) noexcept {
  return path_call(Kind::Remove, path, nullptr, [&] { return ::syscall(SYS_unlink, path); });
}

int remove(const char* path) noexcept {
  return path_call(Kind::Remove, path, nullptr, [&] {
    const long result = ::syscall(SYS_unlink, path);
    return result < 0 && errno == EISDIR ? ::syscall(SYS_rmdir, path) : result;
  });
}

int mkdir(const char* path, mode_t mode) noexcept {
  return path_call(Kind::MakeFolder, path, nullptr,
                   [&] { return ::syscall(SYS_mkdir, path, mode); });
}

}  // extern "C"
