#include "tools/collide/collide.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "collision/mesh/bad_input.hpp"
#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/output/frame_writer.hpp"
#include "tools/collide/collide_progress.hpp"
#include "tools/collide/collide_report.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

/// Thrown out of the reading of a series.
struct Interrupted {};

double parse_margin(const std::string& text) {
  const std::optional<double> margin = sim::parse_number(sim::trimmed(text));
  if (!margin || *margin < 0 || *margin > collision::kMaxCoordinate)
    throw sim::InputError(
        "--margin: expected a length >= 0 as a number without a unit, in the unit of the mesh "
        "files, "
        "e.g. 0.1, not `" +
        sim::one_line(text) + "`");
  return *margin;
}

void check_choice(const char* option, const std::string& value,
                  const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), value) == names.end())
    throw sim::InputError(fmt::format("{}: unknown value `{}`{}", option, sim::one_line(value),
                                      sim::suggestion(value, names)));
}

void check_count(const char* option, int value, int most) {
  if (value < 1 || value > most)
    throw sim::InputError(fmt::format("{}: expected 1 to {}, not {}", option, most, value));
}

SearchSettings checked_settings(const CollideOptions& options) {
  constexpr int kMostRepeats = 1'000'000, kMostThreads = 1024;
  if (options.meshes.empty() || options.meshes.size() > 2)
    throw sim::InputError(fmt::format(
        "collide: expected one or two meshes, not {}; put a pattern for a series in quotes, "
        "'disc_*.vtu'",
        options.meshes.size()));
  for (const std::string& mesh : options.meshes)
    if (mesh.empty()) throw sim::InputError("collide: expected a mesh, not an empty name");
  check_choice("--method", options.method, {"blocks", "article"});
  if (options.narrow) check_choice("--narrow", *options.narrow, {"sat", "gjk"});
  check_count("--repeat", options.repeat, kMostRepeats);
  check_count("--threads", options.threads, kMostThreads);
  SearchSettings settings;
  settings.article = options.method == "article";
  settings.threads = options.threads;
  settings.margin = parse_margin(options.margin);
  if (options.narrow == "gjk") settings.narrow = collision::NarrowTest::Gjk;
  if (settings.article && options.narrow == "sat")
    throw sim::InputError("--narrow sat: --method article has GJK only; leave one of them out");
  if (settings.article && options.threads > 1)
    throw sim::InputError("--threads: --method article runs on one thread only");
  return settings;
}

/// Looked at first: hours of work should not end at a mistyped folder.
void check_folder(const std::filesystem::path& file) {
  if (file.empty()) throw sim::InputError("--pairs: expected a file name, not an empty one");
  const std::filesystem::path folder = file.parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    throw sim::SystemError(file.string() + ": can't be written: there is no folder " +
                           folder.string());
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw sim::SystemError("standard output can't be written");
}

std::vector<MeshSeries> read_bodies(const CollideOptions& options) {
  std::vector<MeshSeries> bodies;
  for (const std::string& mesh : options.meshes) {
    FrameProgress progress("read " + mesh);
    bodies.push_back(read_mesh_series(mesh, [&](std::size_t done, std::size_t all) {
      progress.update(done, all);
      if (options.interrupted && options.interrupted()) throw Interrupted{};
    }));
  }
  return bodies;
}

int collide_bodies(const CollideOptions& options, const SearchSettings& settings) {
  const std::vector<MeshSeries> bodies = read_bodies(options);
  const std::size_t all = count_frames(bodies) * static_cast<std::size_t>(options.repeat);
  PairTable table;
  PassSettings passes;
  passes.self = options.self;
  passes.repeat = options.repeat;
  if (options.pairs) passes.take_pairs = [&](std::span<const PairRow> rows) { table.add(rows); };
  CollideFigures figures;
  {
    FrameProgress progress("searched");
    passes.after_frame = [&](std::size_t done) {
      progress.update(done, all);
      return options.interrupted && options.interrupted();
    };
    figures = collide_frames(bodies, settings, passes);
  }
  if (figures.interrupted) throw Interrupted{};
  if (options.pairs) sim::write_text_file(*options.pairs, table.csv());
  print(options.json ? to_json(bodies, figures) : to_text(bodies, figures));
  if (!options.json && options.pairs) print("\nwrote " + options.pairs->string() + "\n");
  return 0;
}

}  // namespace

int collide(const CollideOptions& options) {
  const SearchSettings settings = checked_settings(options);
  if (options.pairs) check_folder(*options.pairs);
  try {
    return collide_bodies(options, settings);
  } catch (const Interrupted&) {
    fmt::print(stderr, "articular: interrupted; nothing was written\n");
    return kInterruptedExitCode;
  }
}

}  // namespace articular::tools
