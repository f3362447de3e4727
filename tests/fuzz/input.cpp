#include "tests/fuzz/input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

namespace articular::fuzz {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("articular-fuzz-" + std::to_string(::getpid()));

  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

fs::path as_file(const char* name, std::string_view bytes) {
  static const Folder folder;
  const fs::path file = folder.path / name;
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t count = ::write(descriptor, rest.data(), rest.size());
    if (count < 0) {
      std::perror(file.c_str());
      std::_Exit(4);
    }
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  if (descriptor < 0 || ::close(descriptor) != 0) {
    std::perror(file.c_str());
    std::_Exit(4);
  }
  return file;
}

void expect_readable(const char* message) {
  const std::string_view text(message);
  bool fine = !text.empty();
  for (const char c : text) fine = fine && c != '\x7f' && (c == '\n' || !(c >= 0 && c < ' '));
  if (fine) return;
  std::fprintf(stderr, "a message that is no readable text: %s\n", message);
  std::abort();
}

}  // namespace articular::fuzz
