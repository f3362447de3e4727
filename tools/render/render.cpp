#include "tools/render/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "sim/base/error.hpp"
#include "sim/output/frame_writer.hpp"
#include "tools/process/status_line.hpp"
#include "tools/render/changed_run.hpp"
#include "tools/render/film_frames.hpp"
#include "tools/render/movie.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/picture_name.hpp"
#include "tools/render/render_scene.hpp"
#include "tools/render/setup_picture.hpp"
#include "tools/render/virtual_display.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

/// Runs that are drawn together, panel beside panel, at the times of the first one's frames.
struct Sequence {
  std::vector<DrawnRun> panels;
  std::vector<std::string> titles;  // of the panels, so that each can be told from the others
  fs::path folder;                  // of its pictures
  std::string name;                 // of its pictures, see picture_name()
};

void check(const RenderOptions& options) {
  if (options.runs.empty()) throw sim::InputError("expected the folder of a run, or a scenario");
  if (options.all && options.frame) throw sim::InputError("--frame and --all exclude each other");
  if (options.side_by_side && options.difference)
    throw sim::InputError("--side-by-side and --difference exclude each other");
  const std::size_t count = options.runs.size();
  if (options.difference && count != 2)
    throw sim::InputError(fmt::format("--difference: expected two runs, not {}", count));
  if (options.side_by_side && (count < 2 || count > 4))
    throw sim::InputError(fmt::format("--side-by-side: expected two to four runs, not {}", count));
  if (!options.movie.empty() && count > 1 && !options.side_by_side && !options.difference)
    throw sim::InputError("--movie: expected one run, or --side-by-side, or --difference");
  if (options.speed && !(*options.speed > 0))
    throw sim::InputError(fmt::format("--speed {:g}: expected more than 0", *options.speed));
  if (options.speed && options.movie.empty())
    throw sim::InputError("--speed is that of a film; expected --movie FILE as well");
}

std::string folder_name(const Series& series) {
  return fs::weakly_canonical(series.directory).filename().string();
}

/// Names of pictures that several runs would share get the name of the run's folder.
void make_names_unique(std::vector<Sequence>& sequences) {
  std::map<fs::path, int> count;
  for (const Sequence& s : sequences) ++count[s.folder / s.name];
  std::set<fs::path> names;
  for (Sequence& s : sequences) {
    if (count[s.folder / s.name] > 1) s.name = folder_name(s.panels.front().series) + "-" + s.name;
    if (!names.insert(s.folder / s.name).second)
      throw sim::InputError({s.panels.front().series.directory.string()},
                            "two runs would have the same pictures; expected folders of other "
                            "names, or no --out");
  }
}

std::string title_above(const Series& series) {
  return series.summary.title.empty() ? series.name : series.summary.title;
}

std::vector<DrawnRun> opened_runs(const RenderOptions& options) {
  std::vector<DrawnRun> runs;
  for (const fs::path& run : options.runs) {
    if (run.extension() == ".toml")
      throw sim::InputError({run.string()}, "a scenario is drawn alone, before any run");
    runs.push_back(as_written(open_series(run, {options.only, options.hidden})));
    if (options.deformation != 1) runs.back() = exaggerated(runs.back(), options.deformation);
  }
  return runs;
}

/// One after the other.
std::vector<Sequence> single_runs(std::vector<DrawnRun> runs, const fs::path& out) {
  std::vector<Sequence> sequences;
  for (DrawnRun& run : runs) {
    const Series& series = run.series;
    Sequence sequence{{}, {title_above(series)}, out, series.name};
    if (out.empty()) sequence.folder = series.directory / "render";
    sequence.panels.push_back(std::move(run));
    sequences.push_back(std::move(sequence));
  }
  make_names_unique(sequences);
  return sequences;
}

Sequence runs_side_by_side(std::vector<DrawnRun> runs, const fs::path& folder) {
  Sequence sequence{{}, {}, folder, ""};
  for (const DrawnRun& run : runs) {
    const std::string label = folder_name(run.series);
    sequence.titles.push_back(title_above(run.series) + " (" + label + ")");
    sequence.name += (sequence.name.empty() ? "" : "-beside-") + label;
  }
  sequence.panels = std::move(runs);
  return sequence;
}

Sequence difference_of_runs(const DrawnRun& first, const DrawnRun& second, const fs::path& folder) {
  const std::string a = folder_name(first.series), b = folder_name(second.series);
  return {{difference(first, second)},
          {title_above(first.series) + ": " + b + " minus " + a},
          folder,
          b + "-minus-" + a};
}

std::vector<Sequence> sequences_of(const RenderOptions& options) {
  std::vector<DrawnRun> runs = opened_runs(options);
  const fs::path folder = options.out.empty() ? fs::path(".") : options.out;
  if (options.difference) return {difference_of_runs(runs[0], runs[1], folder)};
  if (options.side_by_side) return {runs_side_by_side(std::move(runs), folder)};
  return single_runs(std::move(runs), options.out);
}

/// The numbers of the frames to draw as pictures.
std::set<int> chosen_frames(const Series& series, const RenderOptions& options) {
  std::set<int> numbers;
  if (options.all) {
    for (const FrameEntry& frame : series.frames) numbers.insert(frame.index);
  } else if (options.frame) {
    const auto has = [&](const FrameEntry& frame) { return frame.index == *options.frame; };
    if (std::none_of(series.frames.begin(), series.frames.end(), has))
      throw sim::InputError({series.directory.string()},
                            fmt::format("there is no frame {}; there are {} frames, {} to {}",
                                        *options.frame, series.frames.size(),
                                        series.frames.front().index, series.frames.back().index));
    numbers.insert(*options.frame);
  } else if (options.movie.empty()) {  // else the film is what was asked for
    numbers.insert(series.frames.back().index);
  }
  return numbers;
}

std::set<std::string> bodies_of(const std::vector<Sequence>& sequences) {
  std::set<std::string> names;
  for (const Sequence& sequence : sequences)
    for (const DrawnRun& run : sequence.panels)
      for (const sim::SeriesEntry& part : run.series.frames.front().parts)
        if (part.part != "lines") names.insert(part.part);
  return names;
}

Image draw_frame(RenderScene& scene, const Setting& setting, const Sequence& sequence,
                 const FrameEntry& entry, const RenderOptions& options) {
  std::vector<Frame> frames;
  std::vector<std::string> moments;
  for (const DrawnRun& run : sequence.panels) {
    const bool is_first = &run == &sequence.panels.front();
    const FrameEntry& there = is_first ? entry : frame_at(run.series, entry.time);
    frames.push_back(run.read(there));
    moments.push_back(moment_of(run.series, there.time));
    if (options.deformation != 1)
      moments.back() += fmt::format(", deformation × {:g}", options.deformation);
  }
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < frames.size(); ++i)
    panels.push_back({frames[i], sequence.titles[i], moments[i],
                      setting.survey.middle ? *setting.survey.middle
                                            : middle_of(frames[i], setting.axes, options.focus)});
  return scene.draw(panels);
}

/// On stderr: every frame on a terminal, else a line now and then.
class DrawingProgress {
 public:
  explicit DrawingProgress(std::size_t total) : total_(total) {}
  ~DrawingProgress() { status_.erase(); }
  DrawingProgress(const DrawingProgress&) = delete;
  DrawingProgress& operator=(const DrawingProgress&) = delete;
  void next() {
    ++done_;
    const auto now = std::chrono::steady_clock::now();
    constexpr std::chrono::seconds kBetweenLines{10};
    if (total_ == 1 || (!status_.is_terminal() && now - said_ < kBetweenLines)) return;
    said_ = now;
    status_.show(fmt::format("drawing frame {} of {}", done_, total_));
  }

 private:
  StatusLine status_;
  std::size_t total_, done_ = 0;
  std::chrono::steady_clock::time_point said_ = std::chrono::steady_clock::now();
};

/// Pictures and film of one sequence.
void draw_sequence(RenderScene& scene, const Setting& setting, const Sequence& sequence,
                   const RenderOptions& options) {
  const Series& series = sequence.panels.front().series;
  const Survey& seen = setting.survey;
  const std::string what =
      setting.field ? ", " + seen.field + " " + range_text(*setting.field) : "";
  const std::string name = picture_name(sequence.name, seen.field, options);
  const std::set<int> pictures = chosen_frames(series, options);
  if (!pictures.empty()) make_folder(sequence.folder);

  std::optional<Movie> movie;
  std::vector<int> shown(series.frames.size(), 0);
  if (!options.movie.empty()) {
    movie.emplace(movie_file(options.movie), setting.page.width, setting.page.height);
    std::vector<double> times;
    for (const FrameEntry& entry : series.frames) times.push_back(entry.time);
    shown = film_frames(times, options.speed, Movie::kFramesPerSecond);
  }
  const auto is_drawn = [&](std::size_t i) {
    return shown[i] > 0 || pictures.contains(series.frames[i].index);
  };
  std::size_t total = 0, in_film = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    total += is_drawn(i) ? 1 : 0;
    in_film += static_cast<std::size_t>(shown[i]);
  }
  DrawingProgress progress(total);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!is_drawn(i)) continue;
    progress.next();
    const FrameEntry& entry = series.frames[i];
    const Image image = draw_frame(scene, setting, sequence, entry, options);
    for (int k = 0; k < shown[i]; ++k) movie->add(*image);
    if (!pictures.contains(entry.index)) continue;
    const fs::path file = sequence.folder / sim::frame_file_name(name, entry.index, ".png");
    write_png(file, *image, setting.page.dpi);
    fmt::print("wrote {} (frame {}, {}{})\n", file.lexically_normal().string(), entry.index,
               moment_of(series, entry.time), what);
  }
  if (!movie) return;
  movie->finish();
  fmt::print("wrote {} ({} frames{})\n", movie_file(options.movie).string(), in_film, what);
}

}  // namespace

int render(const RenderOptions& options) {
  // 1. What is there, and is it what was asked for?
  check(options);
  if (options.runs.size() == 1 && options.runs.front().extension() == ".toml")
    return render_setup(options);
  Setting setting;
  setting.page = page_of(options.size, options.dpi);
  setting.look = {paper_of(options.background), options.mesh_edges, options.fibres, options.opacity,
                  std::nullopt};
  if (!options.clip.empty()) setting.look.clip = parse_clip(options.clip);
  if (setting.look.paper.transparent && !options.movie.empty())
    throw sim::InputError("--background transparent: a film has none; expected a colour");
  const std::vector<Sequence> sequences = sequences_of(options);
  check_opacity(options.opacity, bodies_of(sequences));
  for (const Sequence& sequence : sequences) chosen_frames(sequence.panels.front().series, options);
  setting.num_panels = static_cast<int>(sequences.front().panels.size());
  setting.directions = sequences.front().panels.front().series.summary.directions;
  setting.axes = view_axes(options.view, options.up, setting.directions);
  if (!options.movie.empty()) check_movie(movie_file(options.movie));

  // 2. One size and one range of colours for all, so that pictures compare and a film is calm.
  std::vector<DrawnRun> all;
  for (const Sequence& sequence : sequences)
    all.insert(all.end(), sequence.panels.begin(), sequence.panels.end());
  setting.survey =
      survey(all, {options.field, options.flat, options.difference}, options.focus, setting.axes);
  if (setting.look.clip)
    require_kept(*setting.look.clip, setting.survey.everything, setting.survey.length_unit);
  std::erase_if(setting.survey.coloured, [&](const std::string& part) {
    const auto asked = options.opacity.find(part);
    return asked != options.opacity.end() && asked->second < 1;
  });
  if (!setting.survey.coloured.empty())
    setting.field = field_scale(setting.survey, options.range, options.colour_map);
  else if (options.range || !options.colour_map.empty())
    throw sim::InputError("--range and --colour-map are of a field, and no part drawn has one");

  // 3. Draw.
  const VirtualDisplay display;
  RenderScene scene(setting);
  for (const Sequence& sequence : sequences) draw_sequence(scene, setting, sequence, options);
  return 0;
}

}  // namespace articular::tools
