#include "tools/collide/collide_series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glob.h>

#include <algorithm>
#include <memory>
#include <set>

#include "sim/base/error.hpp"
#include "sim/mesh/frame_series.hpp"
#include "sim/mesh/mesh_io.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

bool exists(const std::string& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

std::vector<fs::path> matching_files(const std::string& pattern) {
  glob_t matches{};
  const std::unique_ptr<glob_t, void (*)(glob_t*)> owner(&matches, ::globfree);
  const int status = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &matches);
  if (status == GLOB_NOSPACE) throw std::bad_alloc();
  if (status != 0) throw sim::InputError({pattern}, "no file matches this pattern");
  std::vector<fs::path> files(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
  std::sort(files.begin(), files.end());
  return files;
}

/// Bones and lines are surfaces (.vtp): only the rest can have tetrahedra.
std::set<std::string> parts_with_cells(const std::vector<sim::SeriesEntry>& entries) {
  std::set<std::string> parts;
  for (const sim::SeriesEntry& entry : entries)
    if (fs::path(entry.file).extension() != ".vtp") parts.insert(entry.part);
  return parts;
}

/// The only part there is, or the one asked for.
std::string choose_part(const std::string& pvd, const std::string& asked,
                        const std::vector<sim::SeriesEntry>& entries) {
  const std::set<std::string> parts = parts_with_cells(entries);
  if (parts.empty()) throw sim::InputError({pvd}, "lists no meshes with tetrahedra");
  if (asked.empty() && parts.size() == 1) return *parts.begin();
  if (parts.contains(asked) && !asked.empty()) return asked;
  const std::string problem = asked.empty() ? "holds several bodies; choose one, e.g. "
                                            : "has no body `" + asked + "` with tetrahedra; try ";
  throw sim::InputError(
      {pvd}, fmt::format("{}{}:{} (of {})", problem, pvd, *parts.rbegin(), fmt::join(parts, ", ")));
}

std::vector<fs::path> listed_files(const std::string& pvd, const std::string& asked) {
  std::vector<sim::SeriesEntry> entries = sim::read_series(pvd);
  const std::string part = choose_part(pvd, asked, entries);
  std::erase_if(entries, [&](const sim::SeriesEntry& entry) { return entry.part != part; });
  const auto earlier = [](const auto& a, const auto& b) { return a.time < b.time; };
  std::stable_sort(entries.begin(), entries.end(), earlier);
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && entries[i].time == entries[i - 1].time)
      throw sim::InputError({pvd},
                            fmt::format("lists {} and {} for the same time {}", entries[i - 1].file,
                                        entries[i].file, entries[i].time));
    files.push_back(fs::path(pvd).parent_path() / entries[i].file);
  }
  return files;
}

sim::MeshData read_tetrahedra(const fs::path& file) {
  sim::MeshData mesh = sim::read_mesh(file, 1);
  if (mesh.tets.cols() == 0)
    throw sim::InputError({file.string()}, "holds no tetrahedra, only a surface");
  return mesh;
}

void check_same_mesh(const fs::path& file, const sim::MeshData& mesh, const MeshSeries& series) {
  const auto fail = [&](const std::string& difference) {
    throw sim::InputError({file.string()},
                          difference + " " + series.files[0].string() +
                              "; all frames of a series have the same tetrahedra and nodes");
  };
  if (mesh.X.cols() != series.frames[0].cols())
    fail(fmt::format("has {} nodes, not the {} of", mesh.X.cols(), series.frames[0].cols()));
  if (mesh.tets.cols() != series.tets.cols())
    fail(fmt::format("has {} tetrahedra, not the {} of", mesh.tets.cols(), series.tets.cols()));
  for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e)
    if (mesh.tets.col(e) != series.tets.col(e))
      fail(fmt::format("tetrahedron {} has other nodes than in", e));
}

collision::Surface surface_of(const fs::path& file, const sim::MeshData& mesh) {
  try {
    return collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols()));
  } catch (const std::invalid_argument& error) {
    throw sim::InputError({file.string()}, error.what());
  }
}

}  // namespace

std::vector<fs::path> series_files(const std::string& argument) {
  constexpr std::string_view kPvd = ".pvd";
  if (!exists(argument)) {
    if (const std::size_t end = argument.find(".pvd:"); end != std::string::npos)
      return listed_files(argument.substr(0, end + kPvd.size()),
                          argument.substr(end + kPvd.size() + 1));
    if (argument.find_first_of("*?[") != std::string::npos) return matching_files(argument);
  }
  if (argument.ends_with(kPvd)) return listed_files(argument, "");
  return {argument};
}

MeshSeries read_mesh_series(const std::string& argument,
                            const std::function<void(std::size_t, std::size_t)>& after_frame) {
  MeshSeries series;
  series.name = argument;
  series.files = series_files(argument);
  for (const fs::path& file : series.files) {
    sim::MeshData mesh = read_tetrahedra(file);
    if (series.frames.empty()) {
      series.surface = surface_of(file, mesh);
      series.tets = std::move(mesh.tets);
    } else {
      check_same_mesh(file, mesh, series);
    }
    series.frames.push_back(std::move(mesh.X));
    after_frame(series.frames.size(), series.files.size());
  }
  return series;
}

}  // namespace articular::tools
