#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>

#include "tools/process/child_process.hpp"

class vtkImageData;
class vtkOggTheoraWriter;

namespace articular::tools {

/// Without an ending .mp4 where the program ffmpeg is installed, else .ogv.
std::filesystem::path movie_file(const std::filesystem::path& asked);

/// @throws InputError for another ending than .ogv and .mp4, or .mp4 without ffmpeg
void check_movie(const std::filesystem::path& file);

/// A movie file, written frame by frame: .ogv by VTK, .mp4 by the program ffmpeg where it is
/// installed. It appears whole or not at all: as `<file>.part` until finish().
class Movie {
 public:
  static constexpr int kFramesPerSecond = 25;

  /// @throws InputError as check_movie(); SystemError when it can't be written
  Movie(std::filesystem::path file, int width, int height);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// @param image  RGB, as large as said above
  void add(vtkImageData& image);
  void finish();

 private:
  void start_theora();
  void start_ffmpeg(int width, int height);
  [[noreturn]] void fail() const;

  std::filesystem::path file_, temporary_;
  vtkSmartPointer<vtkOggTheoraWriter> theora_;
  ChildProcess ffmpeg_;
  FileDescriptor to_ffmpeg_;
  bool started_ = false, finished_ = false;
};

}  // namespace articular::tools
