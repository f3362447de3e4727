#include "tools/render/movie.hpp"

#include "tests/tools/render/drawing.hpp"
#include "tools/render/film_frames.hpp"

namespace articular::tools::render_test {

/// Of an Ogg file: packets of all pages [RFC 3533, 6], and whether the last page says that it is
/// it.
std::pair<int, bool> packets_of(const std::string& ogg) {
  constexpr std::size_t kFlags = 5, kNumSegments = 26, kSegments = 27;
  int packets = 0;
  bool ends = false;
  for (std::size_t page = 0; page + kSegments < ogg.size();) {
    EXPECT_EQ(ogg.compare(page, 4, "OggS"), 0);
    ends = (ogg[page + kFlags] & 4) != 0;
    const auto count = static_cast<unsigned char>(ogg[page + kNumSegments]);
    std::size_t size = kSegments + count;
    for (std::size_t s = 0; s < count; ++s) {
      const auto length = static_cast<unsigned char>(ogg[page + kSegments + s]);
      packets += length < 255 ? 1 : 0;
      size += length;
    }
    page += size;
  }
  return {packets, ends};
}

TEST_F(Drawing, AMovieIsWrittenWholeAndWithoutPictures) {
  options_.movie = run_ / "tiny.ogv";
  render(options_);
  constexpr int kTheoraHeaders = 3, kFrames = 3;
  EXPECT_EQ(packets_of(content(options_.movie)), std::pair(kTheoraHeaders + kFrames, true));
  EXPECT_FALSE(std::filesystem::exists(run_ / "tiny.ogv.part"));
  EXPECT_FALSE(std::filesystem::exists(run_ / "render"));
}

/// A program `ffmpeg` that runs these lines of shell, found before any other.
class FakeFfmpeg {
 public:
  explicit FakeFfmpeg(const std::string& lines)
      : path_("PATH", folder_.path().string() + ":" + std::getenv("PATH")) {
    const auto program = folder_.file("ffmpeg", "#!/bin/sh\n" + lines + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }

 private:
  TemporaryFolder folder_;
  Environment path_;
};

TEST_F(Drawing, FfmpegGetsEveryFrameForMp4) {
  // Its last argument is the file.
  const FakeFfmpeg ffmpeg("for file; do :; done; cat > \"$file\"");
  options_.movie = run_ / "tiny.mp4";
  render(options_);
  EXPECT_EQ(std::filesystem::file_size(options_.movie), 3U * 320 * 200 * 3);
}

// Converted by one matrix and shown by another, the colours of a legend are off by 14 of 255; with
// the same, by 2 (measured with ffmpeg 5.1).
TEST_F(Drawing, Mp4IsWrittenWithTheMatrixOfColoursThatItSaysItHas) {
  const FakeFfmpeg ffmpeg("for file; do :; done; cat > /dev/null; echo \"$@\" > \"$file\"");
  options_.movie = run_ / "tiny.mp4";
  render(options_);
  const std::string arguments = content(options_.movie);
  EXPECT_NE(arguments.find("out_color_matrix=bt709:out_range=tv "), std::string::npos) << arguments;
  EXPECT_NE(arguments.find(" -colorspace bt709 "), std::string::npos) << arguments;
  EXPECT_NE(arguments.find(" -color_range tv "), std::string::npos) << arguments;
}

TEST_F(Drawing, WhenFfmpegFailsThereIsNoMovie) {
  for (const std::string lines : {"exit 1", "cat > /dev/null; exit 1"}) {
    const FakeFfmpeg ffmpeg(lines);
    options_.movie = run_ / "tiny.mp4";
    EXPECT_THROW(render(options_), sim::SystemError) << lines;
    EXPECT_FALSE(std::filesystem::exists(options_.movie));
    EXPECT_FALSE(std::filesystem::exists(run_ / "tiny.mp4.part"));
  }
}

TEST_F(Drawing, AFilmWithoutEndingIsWhatThisMachineCanWrite) {
  {
    const Environment no_programs("PATH", "/nonexistent");
    EXPECT_EQ(movie_file("film"), "film.ogv");
  }
  const FakeFfmpeg ffmpeg("exit 1");
  EXPECT_EQ(movie_file("film"), "film.mp4");
  EXPECT_EQ(movie_file("film.ogv"), "film.ogv");
}

// 2 s of simulation at a tenth of its speed are 20 s of film: 500 frames after the first.
TEST(FilmFrames, ShowEachMomentAtItsTime) {
  EXPECT_EQ(film_frames({0, 1, 5}, std::nullopt, 25), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(film_frames({0, 1, 2}, 0.1, 25), (std::vector<int>{250, 250, 1}));
  EXPECT_EQ(film_frames({0, 0.5, 2}, 0.1, 25), (std::vector<int>{125, 375, 1}));
  // In fast motion frames are left out, but for the last one.
  EXPECT_EQ(film_frames({0, 0.1, 0.2, 0.3, 0.4, 0.5}, 5, 25), (std::vector<int>{1, 0, 1, 0, 1, 1}));
  EXPECT_EQ(film_frames({1}, 5, 25), (std::vector<int>{1}));
}

TEST_F(Drawing, AFilmInSlowMotionRepeatsFrames) {
  const FakeFfmpeg ffmpeg("for file; do :; done; cat > \"$file\"");
  options_.movie = run_ / "tiny.mp4";
  options_.speed = 0.1;  // 20 ms in 0.2 s: 5 frames and the last one
  EXPECT_NE(print_of(options_).find("(6 frames, "), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(options_.movie), 6U * 320 * 200 * 3);
}

}  // namespace articular::tools::render_test
