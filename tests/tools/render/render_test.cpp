#include "tools/render/render.hpp"

#include <CLI/CLI.hpp>

#include "tests/tools/render/drawing.hpp"
#include "tools/render/picture_name.hpp"
#include "tools/render/render_command.hpp"
#include "tools/render/render_series.hpp"

namespace articular::tools::render_test {

TEST_F(Drawing, TheLastFrameIsDrawnAtTheSizeAskedFor) {
  const std::string said = print_of(options_);
  const auto file = run_ / "render/tiny_von_mises_three-quarter_000002.png";
  EXPECT_EQ(said, "wrote " + file.string() + " (frame 2, t = 20.0 ms, von_mises 0 to 3 kPa)\n");
  const auto image = read_png(file);
  EXPECT_EQ(image->GetDimensions()[0], 320);
  EXPECT_EQ(image->GetDimensions()[1], 200);
  double range[2];
  image->GetScalarRange(range);
  EXPECT_GT(range[1] - range[0], 100) << "the picture is all of one colour";
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
  const std::string first = content(run_ / "render/tiny_von_mises_three-quarter_000002.png");
  render(options_);
  EXPECT_EQ(content(run_ / "render/tiny_von_mises_three-quarter_000002.png"), first);
}

TEST_F(Drawing, AllFramesOrOneGoWhereAskedFor) {
  options_.out = run_ / "deep/er";
  options_.frame = 1;
  render(options_);
  EXPECT_TRUE(std::filesystem::exists(run_ / "deep/er/tiny_von_mises_three-quarter_000001.png"));
  EXPECT_FALSE(std::filesystem::exists(run_ / "deep/er/tiny_von_mises_three-quarter_000002.png"));
  options_.frame.reset();
  options_.all = true;
  render(options_);
  EXPECT_TRUE(std::filesystem::exists(run_ / "deep/er/tiny_von_mises_three-quarter_000000.png"));
  EXPECT_TRUE(std::filesystem::exists(run_ / "deep/er/tiny_von_mises_three-quarter_000002.png"));
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
  for (const FrameEntry& frame : open_series(run_.path(), {{"disc:contact"}, {}}).frames) {
    ASSERT_EQ(frame.parts.size(), 1U);
    EXPECT_EQ(frame.parts[0].part, "disc:contact");
  }
}

// Of a contact surface the face's pressure counts, which its own body does not show.
TEST_F(Drawing, OnePartAloneIsDrawnInItsColours) {
  options_.only = {"disc"};
  options_.field = "contact_pressure";
  options_.view = "bottom";
  const std::string said = print_of(options_);
  EXPECT_NE(said.find("contact_pressure 0 to 2 kPa"), std::string::npos) << said;
  options_.only = {"disc:contact", "jaw"};
  EXPECT_NE(print_of(options_).find("contact_pressure 0 to 4 kPa"), std::string::npos);
}

/// Two runs of one scenario, in folders of their own.
class TwoRuns : public Drawing {
 protected:
  void SetUp() override {
    Drawing::SetUp();
    write_run(other_.path());
    options_.runs = {run_.path(), other_.path()};
  }
  TemporaryFolder other_;
};

TEST_F(TwoRuns, HaveOneRangeOfColours) {
  sim::FrameWriter writer(other_.path(), "tiny", {1e-3, "mm"});
  const Positions x = 1e-3 * Positions::Random(3, 4);
  const Eigen::MatrixXd stress = Eigen::MatrixXd::Constant(1, 1, 9500);
  writer.write_tissue(
      {"disc", x, Tetrahedra(Eigen::Vector4i(0, 1, 2, 3)), {}, {{"von_mises", "Pa", stress}}}, 0,
      0);
  writer.finish_frame(0, 0);
  options_.only = {"disc"};
  const std::string said = print_of(options_);
  EXPECT_NE(said.find("(frame 2, t = 20.0 ms, von_mises 0 to 10 kPa)"), std::string::npos) << said;
  EXPECT_NE(said.find("(frame 0, t = 0.0 ms, von_mises 0 to 10 kPa)"), std::string::npos) << said;
}

TEST_F(TwoRuns, InOneFolderDoNotReplaceEachOther) {
  const TemporaryFolder out;
  options_.out = out.path();
  render(options_);
  const auto name = [](const TemporaryFolder& run) {
    return run.path().filename().string() + "-tiny_von_mises_three-quarter_000002.png";
  };
  EXPECT_TRUE(std::filesystem::exists(out / name(run_)));
  EXPECT_TRUE(std::filesystem::exists(out / name(other_)));
  options_.runs = {run_.path(), run_.path()};
  EXPECT_NE(error_of(options_).find("two runs would have the same pictures"), std::string::npos);
}

TEST_F(TwoRuns, StandSideBySide) {
  const TemporaryFolder out;
  options_.out = out.path();
  options_.side_by_side = true;
  EXPECT_NE(print_of(options_).find("-beside-"), std::string::npos);
  options_.movie = out / "both.ogv";
  EXPECT_NE(print_of(options_).find("both.ogv (3 frames"), std::string::npos);
}

// Both are the same, so that nothing is left: a range of 1 to both sides.
TEST_F(TwoRuns, AreSubtracted) {
  const TemporaryFolder out;
  options_.out = out.path();
  options_.difference = true;
  const std::string said = print_of(options_);
  EXPECT_NE(said.find("-minus-"), std::string::npos);
  EXPECT_NE(said.find("von_mises -1 to 1 Pa"), std::string::npos) << said;
}

TEST_F(TwoRuns, WhatDoesNotGoTogetherIsRefused) {
  const auto error = [&](auto change) {
    RenderOptions options = options_;
    change(options);
    return error_of(options);
  };
  EXPECT_EQ(error([](auto& o) { o.movie = "m.ogv"; }),
            "--movie: expected one run, or --side-by-side, or --difference");
  EXPECT_EQ(error([](auto& o) { o.side_by_side = o.difference = true; }),
            "--side-by-side and --difference exclude each other");
  EXPECT_EQ(error([](auto& o) {
              o.difference = true;
              o.runs.pop_back();
            }),
            "--difference: expected two runs, not 1");
  EXPECT_EQ(error([](auto& o) { o.runs.back() = "jaw.toml"; }),
            "jaw.toml: a scenario is drawn alone, before any run");
  EXPECT_EQ(error([](auto& o) { o.speed = 0.1; }),
            "--speed is that of a film; expected --movie FILE as well");
  EXPECT_EQ(error([](auto& o) {
              o.opacity = {{"jar", 0.5}};
            }),
            "--opacity: unknown body `jar`, did you mean `jaw`? There are: disc, jaw, skull");
  EXPECT_EQ(error([](auto& o) {
              o.opacity = {{"jaw", 0}};
            }),
            "--opacity jaw=0: expected more than 0 and at most 1; --hide jaw leaves it out");
  EXPECT_EQ(error([](auto& o) { o.background = "whit"; }).rfind("--background: unknown colour", 0),
            0U);
  EXPECT_EQ(error([](auto& o) {
              o.flat = true;
              o.field = "displacement";
            }),
            "--flat: displacement has values at nodes only; expected a field of elements or faces");
  EXPECT_EQ(error([](auto& o) {
              o.hidden = {"disc", "skull", "jaw", "lines"};
            }),
            (run_ / "tiny.pvd").string() + ": --only and --hide leave no part to draw");
}

// What shows something else has another name.
TEST(PictureName, HasWhatIsSeen) {
  RenderOptions options;
  EXPECT_EQ(picture_name("jaw", "von_mises", options), "jaw_von_mises_three-quarter");
  options.view = "top";
  options.only = {"disc", "skull:contact"};
  options.clip = "y<2 mm";
  options.deformation = 10;
  EXPECT_EQ(picture_name("jaw", "von_mises", options),
            "jaw_von_mises_top_disc+skull-contact_clip-y-2-mm_deformation-10");
  options.clip = "y>2 mm";
  options.focus = "disc";
  options.hidden = {"jaw"};
  options.flat = true;
  EXPECT_EQ(picture_name("jaw", "", options),
            "jaw_flat_top_disc+skull-contact_without-jaw_focus-disc_clip-y+2-mm_deformation-10");
  options.only.assign(50, "a_rather_long_name");
  EXPECT_LT(picture_name("jaw", "", options).size(), 200U);
}

// The resolution lies in the chunk pHYs, in pixels a metre.
TEST_F(Drawing, APictureForPrintSaysItsResolution) {
  options_.size = "60x60mm";
  options_.dpi = 254;
  render(options_);
  const std::string png = content(run_ / "render/tiny_von_mises_three-quarter_000002.png");
  const auto chunk = png.find("pHYs");
  ASSERT_NE(chunk, std::string::npos);
  const std::string expected("\0\0\x27\x10\0\0\x27\x10\1", 9);  // 10000 a metre
  EXPECT_EQ(png.substr(chunk + 4, 9), expected);
  const auto image = read_png(run_ / "render/tiny_von_mises_three-quarter_000002.png");
  EXPECT_EQ(image->GetDimensions()[0], 600);
}

TEST_F(Drawing, TheTitleOfTheScenarioStandsInThePicture) {
  render(options_);
  const std::string without = content(run_ / "render/tiny_von_mises_three-quarter_000002.png");
  run_.file("summary.json", R"({"settings": {"title": "A tiny run"}})");
  render(options_);
  EXPECT_NE(content(run_ / "render/tiny_von_mises_three-quarter_000002.png"), without);
  EXPECT_EQ(read_run_summary(run_.path()).title, "A tiny run");
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
  EXPECT_EQ(read_png(run_ / "render/tiny_von_mises_left_000000.png")->GetDimensions()[1], 80);
  const auto parse = [&](const std::string& arguments) {
    app.parse("render " + run_.path().string() + " " + arguments);
  };
  for (const std::string wrong : {"--frame 0 --all", "--frame x", "--range 1", "--opacity disc",
                                  "--opacity disc=", "--opacity =1", "--opacity disc=much"})
    EXPECT_THROW(parse(wrong), CLI::ParseError) << wrong;
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
    options.runs = {run.path()};
    change(options);
    return error_of(options);
  };
  EXPECT_EQ(error([](auto& o) { o.runs = {"/nonexistent"}; }),
            "/nonexistent: no such folder; expected the folder of a run");
  EXPECT_EQ(error([](auto&) {}), name + ": no .pvd in this folder; expected the folder of a run");
  write_run(run.path());
  EXPECT_EQ(error([](auto& o) { o.field = "von_mies"; }),
            name +
                ": unknown field `von_mies`, did you mean `von_mises`? There are: "
                "activation, contact_pressure, displacement, von_mises");
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
  EXPECT_EQ(error([](auto& o) { o.size = "1x1000"; }),
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

}  // namespace articular::tools::render_test
