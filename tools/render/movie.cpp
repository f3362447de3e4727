#include "tools/render/movie.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <vtkImageData.h>
#include <vtkOggTheoraWriter.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

/// Writing to a program that has ended is an error to report, not a signal that ends us.
class IgnoreBrokenPipe {
 public:
  IgnoreBrokenPipe() : previous_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~IgnoreBrokenPipe() { std::signal(SIGPIPE, previous_); }
  IgnoreBrokenPipe(const IgnoreBrokenPipe&) = delete;
  IgnoreBrokenPipe& operator=(const IgnoreBrokenPipe&) = delete;

 private:
  void (*previous_)(int);
};

bool is_installed(const std::string& program) {
  std::istringstream folders(std::getenv("PATH") != nullptr ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

std::filesystem::path movie_file(const std::filesystem::path& asked) {
  if (asked.has_extension()) return asked;
  std::filesystem::path file = asked;
  file += is_installed("ffmpeg") ? ".mp4" : ".ogv";
  return file;
}

void check_movie(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".ogv" && ending != ".mp4")
    throw sim::InputError(
        {file.string()},
        "unknown movie format `" + ending + "`; known: .ogv, and .mp4 where ffmpeg is installed");
  if (ending == ".mp4" && !is_installed("ffmpeg"))
    throw sim::InputError({file.string()},
                          "a movie .mp4 needs the program ffmpeg, which is not installed "
                          "(Debian: apt install ffmpeg); .ogv works without");
}

Movie::Movie(std::filesystem::path file, int width, int height)
    : file_(std::move(file)), temporary_(file_) {
  temporary_ += ".part";
  check_movie(file_);
  // Neither VTK nor ffmpeg tells why a file can't be opened.
  const FileDescriptor probe(
      ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (probe.get() < 0)
    throw sim::SystemError(file_.string() +
                           ": can't be written: " + std::system_category().message(errno));
  try {
    if (file_.extension() == ".ogv")
      start_theora();
    else
      start_ffmpeg(width, height);
  } catch (...) {
    ::unlink(temporary_.c_str());
    throw;
  }
}

Movie::~Movie() {
  if (finished_) return;
  if (theora_ != nullptr && started_) theora_->End();
  ::unlink(temporary_.c_str());
}

void Movie::start_theora() {
  theora_ = vtkSmartPointer<vtkOggTheoraWriter>::New();
  theora_->SetFileName(temporary_.c_str());
  theora_->SetQuality(2);  // the best of 0, 1, 2
  theora_->SetRate(kFramesPerSecond);
  theora_->SubsamplingOff();  // colours at full resolution: thin muscle lines stay sharp
}

void Movie::start_ffmpeg(int width, int height) {
  Pipe frames;
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  // VTK's rows run upwards; players want even sizes and the 4:2:0 layout. They take the colours of
  // a film that does not say its matrix for those of its size: a field would have others than the
  // legend of a picture.
  const auto started = ChildProcess::start({"ffmpeg",
                                            "-y",
                                            "-f",
                                            "rawvideo",
                                            "-pix_fmt",
                                            "rgb24",
                                            "-s",
                                            size,
                                            "-r",
                                            std::to_string(kFramesPerSecond),
                                            "-i",
                                            "-",
                                            "-vf",
                                            "vflip,pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,"
                                            "scale=out_color_matrix=bt709:out_range=tv",
                                            "-colorspace",
                                            "bt709",
                                            "-color_primaries",
                                            "bt709",
                                            "-color_trc",
                                            "bt709",
                                            "-color_range",
                                            "tv",
                                            "-movflags",
                                            "+faststart",
                                            "-pix_fmt",
                                            "yuv420p",
                                            "-crf",
                                            "18",
                                            "-f",
                                            "mp4",
                                            temporary_.string()},
                                           frames.read_end.get(), STDIN_FILENO, ffmpeg_);
  if (started == ChildProcess::Started::NotInstalled)
    throw sim::SystemError(file_.string() + ": ffmpeg is gone");
  to_ffmpeg_ = std::move(frames.write_end);
}

void Movie::add(vtkImageData& image) {
  if (theora_ != nullptr) {
    theora_->SetInputData(&image);
    if (!started_) theora_->Start();  // it asks the first image for the size
    started_ = true;
    theora_->Write();
    if (theora_->GetError() != 0) fail();
    return;
  }
  const IgnoreBrokenPipe ignore;
  const auto* bytes = static_cast<const char*>(image.GetScalarPointer());
  const auto size = static_cast<std::size_t>(3 * image.GetNumberOfPoints());
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::write(to_ffmpeg_.get(), bytes + done, size - done);
    if (count < 0 && errno != EINTR) fail();
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

void Movie::finish() {
  if (theora_ != nullptr) {
    theora_->End();
    if (theora_->GetError() != 0) fail();
  } else {
    to_ffmpeg_.close();
    if (!ffmpeg_.wait()) fail();
  }
  std::error_code error;
  std::filesystem::rename(temporary_, file_, error);
  if (error) throw sim::SystemError(file_.string() + ": can't be written: " + error.message());
  finished_ = true;
}

void Movie::fail() const {
  throw sim::SystemError(file_.string() + ": the movie can't be written (" +
                         (theora_ != nullptr ? "is the disk full?" : "ffmpeg failed") + ")");
}

}  // namespace articular::tools
