#include "tools/render/render.hpp"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>

#include "sim/base/error.hpp"
#include "sim/output/frame_writer.hpp"
#include "tests/sim/support/temporary_folder.hpp"
#include "tools/render/render_legend.hpp"
#include "tools/render/render_series.hpp"
#include "tools/render/virtual_display.hpp"

namespace articular::tools::render_test {

/// Sets or (without a value) unsets a variable of the environment for the time of a test.
class Environment {
 public:
  Environment(std::string name, const std::optional<std::string>& value) : name_(std::move(name)) {
    if (const char* const before = std::getenv(name_.c_str())) before_ = before;
    set(value);
  }
  ~Environment() { set(before_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value)
      ::setenv(name_.c_str(), value->c_str(), 1);
    else
      ::unsetenv(name_.c_str());
  }
  std::string name_;
  std::optional<std::string> before_;
};

/// A tetrahedron that sinks and is pressed, on a plate, with a muscle and a ligament: three frames.
void write_run(const std::filesystem::path& folder) {
  sim::FrameWriter writer(folder, "tiny", {1e-3, "mm"});
  const Tetrahedra tets = Eigen::Vector4i(0, 1, 2, 3);
  const Triangles triangles = Eigen::Vector3i(0, 1, 2);
  Positions plate(3, 3), rest(3, 4);
  plate << -1, 1, 0, -1, -1, 1, 0, 0, 0;
  rest << -1, 1, 0, 0, -1, -1, 1, 0, 0.5, 0.5, 0.5, 2;
  for (int i = 0; i < 3; ++i) {
    Positions x = rest;
    x.row(2).array() -= 0.1 * i;
    const double time = 0.01 * i;
    const Eigen::MatrixXd pressure = Eigen::RowVector4d(0, 1, 2, 0) * 1000 * i;
    const Eigen::MatrixXd stress = Eigen::MatrixXd::Constant(1, 1, 1500.0 * i);
    writer.write_tissue({"disc",
                         x,
                         tets,
                         {{"displacement", "m", x - rest}, {"contact_pressure", "Pa", pressure}},
                         {{"von_mises", "Pa", stress}}},
                        i, time);
    writer.write_contact_surface(
        {"disc", x, triangles, {{"contact_pressure", "Pa", 2 * pressure}}, {}}, i, time);
    writer.write_rigid_body({"skull", plate, triangles, {}, {}}, i, time);
    writer.write_rigid_body({"jaw", x, triangles, {}, {}}, i, time);
    Positions muscle(3, 3), ligament(3, 2);
    muscle << -1, -1.2, -1, 0, 0, 0, 0, 1, 2;
    ligament << 1, 1, 0, 0, 0, 2;
    writer.write_lines({{"masseter", "lateral"},
                        {muscle, ligament},
                        {{"activation", "-", Eigen::RowVector2d(0.5 * i, 0)},
                         {"kind", "-", Eigen::RowVector2d(0, 1)}}},
                       i, time);
    writer.finish_frame(i, time);
  }
}

/// render(), with what it prints.
std::string print_of(const RenderOptions& options) {
  testing::internal::CaptureStdout();
  render(options);
  return testing::internal::GetCapturedStdout();
}

std::string error_of(const RenderOptions& options) {
  try {
    render(options);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "no error";
}

vtkSmartPointer<vtkImageData> read_png(const std::filesystem::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Pixels where one channel stands out: of red, muscles, but neither background nor bones.
int num_pixels_of(int channel, vtkImageData& image) {
  const auto* const bytes = static_cast<const unsigned char*>(image.GetScalarPointer());
  int count = 0;
  for (vtkIdType i = 0; i < image.GetNumberOfPoints(); ++i) {
    const auto of = [&](int shift) { return bytes[3 * i + (channel + shift) % 3]; };
    count += of(0) > 2 * of(1) && of(0) > 2 * of(2) ? 1 : 0;
  }
  return count;
}
int num_red_pixels(vtkImageData& image) { return num_pixels_of(0, image); }
int num_green_pixels(vtkImageData& image) { return num_pixels_of(1, image); }
int num_blue_pixels(vtkImageData& image) { return num_pixels_of(2, image); }

/// Drawing needs a display, or Xvfb to make one.
class Drawing : public testing::Test {
 protected:
  void SetUp() override {
    try {
      const VirtualDisplay display;
    } catch (const sim::SystemError& error) {
      GTEST_SKIP() << error.what();
    }
    write_run(run_.path());
    options_.run = run_.path();
    options_.width = 320;
    options_.height = 200;
  }
  TemporaryFolder run_;
  RenderOptions options_;
};

TEST_F(Drawing, TheLastFrameIsDrawnAtTheSizeAskedFor) {
  const std::string said = print_of(options_);
  const auto file = run_ / "render/tiny_000002.png";
  EXPECT_EQ(said, "wrote " + file.string() + " (frame 2, t = 20.0 ms, von_mises 0 to 3 kPa)\n");
  const auto image = read_png(file);
  EXPECT_EQ(image->GetDimensions()[0], 320);
  EXPECT_EQ(image->GetDimensions()[1], 200);
  double range[2];
  image->GetScalarRange(range);
  EXPECT_GT(range[1] - range[0], 100) << "the picture is all of one colour";
  EXPECT_GT(num_red_pixels(*image), 30) << "no muscle is seen";
}

/// A block that is attached below, and a muscle to its top.
constexpr const char* kSetup = R"(
duration = "1 ms"
[[body]]
name = "floor"
kind = "fixed"
geometry = { box = { size = "8 8 1 mm", cells = [1, 1, 1], center = "0 0 -2.6 mm" } }
[[body]]
name = "block"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.3, element = "plain" }
geometry = { box = { size = "4 4 4 mm", cells = [2, 2, 2] } }
[[body]]
name = "post"
kind = "fixed"
[[attach]]
body = "block"
to = "floor"
region = { box = ["-9 -9 -2.1 mm", "9 9 -1.9 mm"] }
[[muscle]]
name = "lip"
path = [{ body = "post", point = "0 0 8 mm" }, { body = "block", point = "0 0 2 mm", radius = "2.5 mm" }]
max_force = "3 N"
)";

TEST_F(Drawing, AScenarioIsDrawnBeforeAnyRunWithWhatIsAttached) {
  const TemporaryFolder folder;
  options_.width = 960;
  options_.height = 600;
  options_.out = folder.path();
  options_.run = folder.file("block.toml", kSetup);
  EXPECT_EQ(print_of(options_), "wrote " + (folder / "block_setup.png").string() + "\n");
  const auto with = read_png(folder / "block_setup.png");
  std::string text = kSetup;
  text.erase(text.find("[[attach]]"), text.find("[[muscle]]") - text.find("[[attach]]"));
  text.erase(text.find("[[muscle]]"));
  options_.run = folder.file("bare.toml", text);
  print_of(options_);
  const auto bare = read_png(folder / "bare_setup.png");
  EXPECT_GT(num_red_pixels(*with), num_red_pixels(*bare) + 20);
  EXPECT_GT(num_blue_pixels(*with), num_blue_pixels(*bare) + 5);
  text +=
      "[[support]]\nbody = \"block\"\nregion = { box = [\"-9 -9 -2.1 mm\", \"9 9 -1.9 "
      "mm\"] }\nfreedoms = [\"translation.z\"]\n";
  options_.run = folder.file("supported.toml", text);
  print_of(options_);
  const auto supported = read_png(folder / "supported_setup.png");
  EXPECT_GT(num_green_pixels(*supported), num_green_pixels(*bare) + 20);
}

TEST_F(Drawing, AScenarioHasNoFrames) {
  const TemporaryFolder folder;
  options_.out = folder.path();
  options_.run = folder.file("block.toml", kSetup);
  options_.frame = 0;
  EXPECT_THROW(render(options_), sim::InputError);
  options_.frame.reset();
  options_.focus = "blok";
  EXPECT_THROW(render(options_), sim::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "block_setup.png"));
}

/// The words for 20 ms of a run with this summary.
std::string moment_with(const std::string& summary) {
  const TemporaryFolder run;
  write_run(run.path());
  run.file("summary.json", summary);
  return moment_of(open_series(run.path()), 0.02);
}

TEST(Moments, OfAStaticAnalysisArePartsOfTheLoad) {
  EXPECT_EQ(moment_with(R"({"settings": {"analysis": "static", "duration_s": 0.08}})"),
            "load 25 %");
  for (const char* const other :
       {R"({"settings": {"analysis": "dynamic", "duration_s": 0.08}})", "{", "[]", "{}",
        R"({"settings": 1})", R"({"settings": {"analysis": "static", "duration_s": "1 s"}})"})
    EXPECT_EQ(moment_with(other), "t = 20.0 ms") << other;
}

TEST_F(Drawing, TheSamePictureTwice) {
  render(options_);
  const std::string first = content(run_ / "render/tiny_000002.png");
  render(options_);
  EXPECT_EQ(content(run_ / "render/tiny_000002.png"), first);
}

TEST_F(Drawing, AllFramesOrOneGoWhereAskedFor) {
  options_.out = run_ / "deep/er";
  options_.frame = 1;
  render(options_);
  EXPECT_TRUE(std::filesystem::exists(run_ / "deep/er/tiny_000001.png"));
  EXPECT_FALSE(std::filesystem::exists(run_ / "deep/er/tiny_000002.png"));
  options_.frame.reset();
  options_.all = true;
  render(options_);
  EXPECT_TRUE(std::filesystem::exists(run_ / "deep/er/tiny_000000.png"));
  EXPECT_TRUE(std::filesystem::exists(run_ / "deep/er/tiny_000002.png"));
  EXPECT_FALSE(std::filesystem::exists(run_ / "render"));
}

TEST_F(Drawing, EveryFieldViewAndFocusCanBeDrawn) {
  for (const std::string field : {"von_mises", "contact_pressure", "displacement"})
    for (const std::string view : {"front", "left", "top", "three-quarter"})
      for (const std::string focus : {"", "disc"}) {
        options_.field = field;
        options_.view = view;
        options_.focus = focus;
        EXPECT_NE(print_of(options_).find(", " + field + " 0 to "), std::string::npos);
      }
}

TEST_F(Drawing, ContactSurfacesAreNotDrawnOverTheirBodies) {
  for (const FrameEntry& frame : open_series(run_.path()).frames) {
    std::vector<std::string> names;
    for (const sim::SeriesEntry& part : frame.parts) names.push_back(part.part);
    EXPECT_EQ(names, (std::vector<std::string>{"disc", "skull", "jaw", "lines"}));
  }
  for (const FrameEntry& frame : open_series(run_.path(), {"disc:contact"}).frames) {
    ASSERT_EQ(frame.parts.size(), 1U);
    EXPECT_EQ(frame.parts[0].part, "disc:contact");
  }
}

// The tissue alone fills the picture, in its colours; muscles are gone. Of a contact surface the
// face's pressure counts, which its own body does not show.
TEST_F(Drawing, OnePartAloneIsDrawnInItsColours) {
  options_.only = {"disc"};
  options_.field = "contact_pressure";
  options_.view = "bottom";
  const std::string said = print_of(options_);
  EXPECT_NE(said.find("contact_pressure 0 to 2 kPa"), std::string::npos) << said;
  EXPECT_EQ(num_red_pixels(*read_png(run_ / "render/tiny_000002.png")), 0);
  options_.only = {"disc:contact", "jaw"};
  EXPECT_NE(print_of(options_).find("contact_pressure 0 to 4 kPa"), std::string::npos);
}

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

TEST_F(Drawing, WhenFfmpegFailsThereIsNoMovie) {
  for (const std::string lines : {"exit 1", "cat > /dev/null; exit 1"}) {
    const FakeFfmpeg ffmpeg(lines);
    options_.movie = run_ / "tiny.mp4";
    EXPECT_THROW(render(options_), sim::SystemError) << lines;
    EXPECT_FALSE(std::filesystem::exists(options_.movie));
    EXPECT_FALSE(std::filesystem::exists(run_ / "tiny.mp4.part"));
  }
}

TEST_F(Drawing, ADeadDisplayIsReplaced) {
  const Environment dead("DISPLAY", ":54321");
  {
    const VirtualDisplay display;
    EXPECT_STRNE(std::getenv("DISPLAY"), ":54321");
  }
  EXPECT_STREQ(std::getenv("DISPLAY"), ":54321");
}

TEST_F(Drawing, TheCommandLineSetsTheOptions) {
  CLI::App app;
  int exit_code = -1;
  add_render_command(app, exit_code);
  testing::internal::CaptureStdout();
  app.parse("render " + run_.path().string() + " --size 100x80 --frame 0 --view left");
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(exit_code, 0);
  EXPECT_EQ(read_png(run_ / "render/tiny_000000.png")->GetDimensions()[1], 80);
  for (const std::string wrong : {"--size 100", "--size 1x2x3", "--frame 0 --all", "--frame x"})
    EXPECT_THROW(app.parse("render " + run_.path().string() + " " + wrong), CLI::ParseError)
        << wrong;
}

TEST(Render, WithoutDisplayAndXvfbTheErrorSaysWhatToInstall) {
  const Environment no_display("DISPLAY", std::nullopt), no_programs("PATH", "/nonexistent");
  try {
    const VirtualDisplay display;
    ADD_FAILURE();
  } catch (const sim::SystemError& error) {
    EXPECT_NE(std::string(error.what()).find("apt install xvfb"), std::string::npos);
  }
}

TEST(Render, WhatIsNotThereIsNamedWithWhatIs) {
  const TemporaryFolder run;
  const std::string name = run.path().string();
  const auto error = [&](auto change) {
    RenderOptions options;
    options.run = run.path();
    change(options);
    return error_of(options);
  };
  EXPECT_EQ(error([](auto& o) { o.run = "/nonexistent"; }),
            "/nonexistent: no such folder; expected the folder of a run");
  EXPECT_EQ(error([](auto&) {}), name + ": no .pvd in this folder; expected the folder of a run");
  write_run(run.path());
  EXPECT_EQ(error([](auto& o) { o.field = "von_mies"; }),
            name +
                ": unknown field `von_mies`, did you mean `von_mises`? There are: "
                "contact_pressure, displacement, von_mises");
  EXPECT_EQ(error([](auto& o) { o.frame = 7; }),
            name + ": there is no frame 7; there are 3 frames, 0 to 2");
  EXPECT_EQ(
      error([](auto& o) { o.focus = "disk"; }),
      name + ": unknown part `disk`, did you mean `disc`? There are: disc, jaw, lines, skull");
  EXPECT_EQ(error([](auto& o) {
              o.only = {"disc", "jar"};
            }),
            (run / "tiny.pvd").string() +
                ": --only: unknown part `jar`, did you mean `jaw`? There are: disc, disc:contact, "
                "jaw, lines, skull");
  EXPECT_EQ(error([](auto& o) { o.view = "behind"; }).rfind("--view: unknown view `behind`", 0),
            0U);
  EXPECT_EQ(error([](auto& o) { o.up = "x"; }), "--up: unknown axis `x`; expected y or z");
  EXPECT_EQ(error([](auto& o) { o.width = 1; }),
            "--size 1x1000: expected 64 to 8192 pixels each way");
  EXPECT_EQ(error([](auto& o) { o.movie = "m.avi"; }),
            "m.avi: unknown movie format `.avi`; known: .ogv, and .mp4 where ffmpeg is installed");
  {
    const Environment no_programs("PATH", "/nonexistent");
    const auto movie = run / "m.mp4";
    EXPECT_EQ(
        error([&](auto& o) { o.movie = movie; }).rfind(movie.string() + ": a movie .mp4 needs", 0),
        0U);
    EXPECT_FALSE(std::filesystem::exists(run / "m.mp4.part"));
  }
  std::filesystem::remove(run / "frames/jaw_000001.vtp");
  EXPECT_EQ(error([](auto&) {}), (run / "frames/jaw_000001.vtp").string() +
                                     ": this frame is listed in the .pvd but not there");
}

// Each point p must satisfy the four inequalities of ViewFit, and at least two opposite ones with
// equality: no border may be crossed, and the eye can't be nearer.
TEST(ViewFit, EveryPointIsInsideTheBordersAndTheEyeIsAsNearAsCanBe) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  const auto point = [&] { return Vec3(value(random), 0.3 * value(random), value(random)); };
  int horizontal = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vec3 to_eye = point().normalized();
    const Vec3 right = to_eye.unitOrthogonal();
    const ViewAxes axes{right, to_eye.cross(right), to_eye};
    const ViewFit::Borders borders{0.2, 0.15, 0.2, 0.12};
    ViewFit fit(axes, borders);
    std::vector<Vec3> points(20);
    for (Vec3& p : points) fit.add(p = point());
    const Vec3 eye = fit.eye();
    std::array<double, 4> room = {1e300, 1e300, 1e300, 1e300};  // smallest distance to each border
    for (const Vec3& p : points) {
      const double ahead = (eye - p).dot(axes.to_eye);
      const double x = (p - eye).dot(axes.right), y = (p - eye).dot(axes.up);
      room[0] = std::min(room[0], x + borders.left * ahead);
      room[1] = std::min(room[1], borders.right * ahead - x);
      room[2] = std::min(room[2], y + borders.bottom * ahead);
      room[3] = std::min(room[3], borders.top * ahead - y);
      EXPECT_LE(ahead, fit.depth() + 1e-12);
    }
    constexpr double kRoundOff = 1e-12;  // of coordinates and distances of about 1 and 10
    for (const double r : room) EXPECT_GT(r, -kRoundOff);
    const bool sides = std::max(room[0], room[1]) < kRoundOff;
    EXPECT_TRUE(sides || std::max(room[2], room[3]) < kRoundOff);
    horizontal += sides ? 1 : 0;
  }
  EXPECT_GT(horizontal, kTrials / 20);  // both cases occur
  EXPECT_LT(horizontal, kTrials * 19 / 20);
}

TEST(NodalValues, ACellFieldIsTheMeanOverTheCellsAtAPointAndAVectorItsLength) {
  const TemporaryFolder run;
  sim::FrameWriter writer(run.path(), "two", {1, "m"});
  const Positions x = Positions::Random(3, 5);
  Tetrahedra tets(4, 2);
  tets << 0, 1, 1, 2, 2, 3, 3, 4;
  const Eigen::MatrixXd vectors = Eigen::Vector3d(3, 4, 12).replicate(1, 5);
  writer.write_tissue(
      {"t", x, tets, {{"v", "N", vectors}}, {{"s", "Pa", Eigen::RowVector2d(2, 6)}}}, 0, 0);
  writer.finish_frame(0, 0);
  const Series series = open_series(run.path());
  const Frame frame = read_frame(series, series.frames.front());
  vtkPointSet& set = *frame.parts.front().set;
  EXPECT_EQ(nodal_values(set, "s"), (std::vector<double>{2, 4, 4, 4, 6}));
  EXPECT_EQ(nodal_values(set, "v"), std::vector<double>(5, 13));
  EXPECT_EQ(nodal_values(set, "w"), std::vector<double>());
  EXPECT_EQ(unit_of(set, "s"), "Pa");
}

TEST(Survey, WhatIsBlankDoesNotStretchTheScale) {
  const TemporaryFolder run;
  sim::FrameWriter writer(run.path(), "blank", {1, "m"});
  const double blank = std::numeric_limits<double>::quiet_NaN();
  const Tetrahedra tets = Eigen::Vector4i(0, 1, 2, 3);
  const auto write = [&](const std::string& name, const Eigen::RowVector4d& pressure) {
    const sim::Field field{
        .name = "contact_pressure", .unit = "Pa", .values = pressure, .may_be_blank = true};
    writer.write_tissue({name, Positions::Random(3, 4), tets, {field}, {}}, 0, 0);
  };
  write("first", Eigen::RowVector4d::Constant(blank));
  write("second", {0, blank, 2, 1});
  writer.finish_frame(0, 0);
  ViewFit fit({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {1, 1, 1, 1});
  const Survey seen = survey(open_series(run.path()), "contact_pressure", "", fit);
  EXPECT_EQ(seen.coloured.size(), 2U);
  EXPECT_EQ(seen.lowest, 0);
  EXPECT_EQ(seen.highest, 2);
  EXPECT_GT(seen.high_percentile, 0);
  EXPECT_LE(seen.high_percentile, 2);
}

TEST(Legend, ScalesEndAtRoundNumbersAndLabelsStayInside) {
  EXPECT_EQ(round_up(0), 1);
  EXPECT_EQ(round_up(1), 1);
  EXPECT_DOUBLE_EQ(round_up(0.0123), 0.015);
  EXPECT_EQ(round_up(81), 100);
  EXPECT_EQ(round_labels(0, 100), (std::vector<double>{0, 20, 40, 60, 80, 100}));
  for (int k = 0; k < 61; ++k) {
    const double high = 1e-7 * std::pow(1.7, k);  // to 1e7
    for (const double low : {0.0, -high, 1 - high}) {
      const double top = low == 1 - high ? 1 + high : high;
      const std::vector<double> labels = round_labels(low, top);
      EXPECT_GE(labels.size(), 3U) << low << " " << top;
      EXPECT_LE(labels.size(), 7U) << low << " " << top;
      const double slack = 1e-5 * (top - low);
      EXPECT_GE(labels.front(), low - slack);
      EXPECT_LE(labels.back(), top + slack);
    }
  }
}

// As of a ratio that is 1 but for round-off. Multiples of the step are beyond 2⁵³ there.
TEST(Legend, LabelsEndWhereTheScaleIsAsShortAsRoundOff) {
  const double below = std::nextafter(1.0, 0.0), above = std::nextafter(1.0, 2.0);
  EXPECT_LE(round_labels(1, above).size(), 12U);
  EXPECT_LE(round_labels(below, above).size(), 12U);
}

}  // namespace articular::tools::render_test
