#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace articular::benchmarks {

/// A table that is on the disk line by line, so that one can watch it grow.
class Csv {
 public:
  Csv(const std::filesystem::path& path, const char* header)
      : file_(std::fopen(path.c_str(), "w")) {
    if (!file_) throw std::runtime_error("cannot write " + path.string());
    line("%s\n", header);
  }

  template <class... Values>
  void line(const char* format, Values... values) {
    std::fprintf(file_.get(), format, values...);
    std::fflush(file_.get());
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace articular::benchmarks
