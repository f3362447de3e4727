#include "tools/render/render.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "sim/base/error.hpp"
#include "sim/output/frame_writer.hpp"
#include "tools/render/movie.hpp"
#include "tools/render/nearest.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/render_scene.hpp"
#include "tools/render/render_series.hpp"
#include "tools/render/setup_picture.hpp"
#include "tools/render/virtual_display.hpp"
#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kSmallest = 64, kLargest = 8192;  // [pixel]

/// The frames to draw as pictures, a part of series.frames.
std::vector<FrameEntry> chosen_frames(const Series& series, const RenderOptions& options) {
  if (options.all) return series.frames;
  if (!options.frame) {
    if (!options.movie.empty()) return {};  // the movie is what was asked for
    return {series.frames.back()};
  }
  for (const FrameEntry& frame : series.frames)
    if (frame.index == *options.frame) return {frame};
  throw sim::InputError(
      {series.directory.string()},
      fmt::format("there is no frame {}; there are {} frames, {} to {}", *options.frame,
                  series.frames.size(), series.frames.front().index, series.frames.back().index));
}

void check(const RenderOptions& options) {
  if (options.all && options.frame) throw sim::InputError("--frame and --all exclude each other");
  for (const int size : {options.width, options.height})
    if (size < kSmallest || size > kLargest)
      throw sim::InputError(fmt::format("--size {}x{}: expected {} to {} pixels each way",
                                        options.width, options.height, kSmallest, kLargest));
}

/// "1600x1000" into width and height; what is wrong with it, or "".
std::string parse_size(const std::string& text, RenderOptions& options) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &rest) == 2) return "";
  return "expected WIDTHxHEIGHT in pixels, e.g. 1600x1000, not `" + text + "`";
}

}  // namespace

int render(const RenderOptions& options) {
  // 1. What is there, and is it what was asked for?
  check(options);
  if (options.run.extension() == ".toml") return render_setup(options);
  const ViewAxes axes = view_axes(options.view, options.up);
  const Series series = open_series(options.run, options.only);
  const std::vector<FrameEntry> pictures = chosen_frames(series, options);
  std::optional<Movie> movie;
  if (!options.movie.empty()) movie.emplace(options.movie, options.width, options.height);

  // 2. One eye and one range of colours for all frames, so that frames compare and a movie is calm.
  ViewFit fit(axes, scene_borders(options.width, options.height));
  const Survey seen = survey(series, options.field, options.focus, fit);

  // 3. Somewhere to draw, and to write.
  const fs::path folder = options.out.empty() ? series.directory / "render" : options.out;
  if (!pictures.empty()) make_folder(folder);
  const VirtualDisplay display;
  RenderScene scene(series, seen, axes, fit, options.width, options.height);

  // 4. Draw.
  const std::string what = seen.field.empty() ? "" : ", " + seen.field + " " + scene.range_text();
  std::size_t next = 0;
  for (const FrameEntry& entry : movie ? series.frames : pictures) {
    const auto image = scene.draw(read_frame(series, entry), moment_of(series, entry.time));
    if (movie) movie->add(*image);
    if (next == pictures.size() || pictures[next].index != entry.index) continue;
    ++next;
    const fs::path file = folder / sim::frame_file_name(series.name, entry.index, ".png");
    write_png(file, *image);
    fmt::print("wrote {} (frame {}, {}{})\n", file.string(), entry.index,
               moment_of(series, entry.time), what);
  }
  if (movie) {
    movie->finish();
    fmt::print("wrote {} ({} frames{})\n", options.movie.string(), series.frames.size(), what);
  }
  return 0;
}

void add_render_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& command =
      *app.add_subcommand("render", "Draw frames of a run, or the set-up of a scenario");
  command
      .add_option("run", options->run,
                  "Folder of a run (or its .pvd): pictures or a movie of its frames. A scenario "
                  "(.toml, or the name of a shipped one): bodies, attached nodes, ends of muscles "
                  "and ligaments before any run")
      ->required()
      ->type_name("DIR|SCENARIO");
  command.add_option("--field", options->field, "What colours the tissue [von_mises]");
  CLI::Option* const frame =
      command.add_option("--frame", options->frame, "Number of the frame to draw [the last]");
  command.add_flag("--all", options->all, "Draw every frame")->excludes(frame);
  command.add_option("--movie", options->movie, "Write a movie: .ogv, or .mp4 with ffmpeg")
      ->type_name("FILE");
  command
      .add_option("--out", options->out,
                  "Folder for the pictures [DIR/render; of a scenario the working folder]")
      ->type_name("DIR");
  command.add_option("--focus", options->focus, "Body that shall fill the picture [all of them]")
      ->type_name("BODY");
  command
      .add_option("--only", options->only,
                  "Draw these parts alone, e.g. disc_left,disc_right, or the surface that a body "
                  "touches with, skull:contact")
      ->delimiter(',')
      ->type_name("PART,...");
  command.add_option("--view", options->view,
                     "front, back, left, right, top, bottom [three-quarter]");
  command.add_option("--up", options->up,
                     "Upward axis: y (knee: z anterior) [z (jaw: x left, y posterior)]");
  command
      .add_option_function<std::string>(
          "--size",
          [options](const std::string& text) {
            const std::string wrong = parse_size(text, *options);
            if (!wrong.empty()) throw CLI::ValidationError("--size", wrong);
          },
          "Size of the pictures in pixels [1600x1000]")
      ->type_name("WxH");
  command.callback([options, &exit_code] {
    std::error_code error;
    if (!fs::exists(options->run, error))
      options->run = shipped_file(options->run).value_or(options->run);
    exit_code = render(*options);
  });
}

}  // namespace articular::tools
