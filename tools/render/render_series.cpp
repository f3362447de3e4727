#include "tools/render/render_series.hpp"

#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <map>
#include <set>

#include "sim/base/error.hpp"
#include "sim/mesh/vtk_files.hpp"
#include "tools/render/nearest.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

fs::path series_file(const fs::path& run) {
  if (run.extension() == ".pvd") return run;
  if (!fs::is_directory(run))
    throw sim::InputError({run.string()}, "no such folder; expected the folder of a run");
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().extension() == ".pvd") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  if (found.empty())
    throw sim::InputError({run.string()}, "no .pvd in this folder; expected the folder of a run");
  if (found.size() > 1)
    throw sim::InputError({run.string()}, "several .pvd in this folder; give one of them, e.g. " +
                                              found.front().string());
  return found.front();
}

PartKind kind_of(const sim::SeriesEntry& entry) {
  if (fs::path(entry.file).extension() == ".vtu") return PartKind::Tissue;
  return entry.part == "lines" ? PartKind::Lines : PartKind::Bone;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_selection(const fs::path& file, const Selection& selection,
                     const std::vector<sim::SeriesEntry>& entries) {
  std::set<std::string> known;
  for (const sim::SeriesEntry& entry : entries) known.insert(entry.part);
  const auto check = [&](const char* option, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (!known.contains(name))
        throw sim::InputError({file.string()}, option + unknown_name("part", name, known));
  };
  check("--only: ", selection.only);
  check("--hide: ", selection.hidden);
}

}  // namespace

std::string moment_of(const Series& series, double time) {
  const auto& whole_load = series.summary.whole_load;
  return whole_load ? fmt::format("load {:.4g} %", 100 * time / *whole_load)
                    : fmt::format("t = {:.1f} ms", 1e3 * time);
}

Series open_series(const fs::path& run, const Selection& selection) {
  const fs::path file = series_file(run);
  Series series{file.stem().string(), file.parent_path(), {}, read_run_summary(file.parent_path())};
  std::map<int, FrameEntry> frames;
  std::vector<sim::SeriesEntry> entries = sim::read_series(file);
  check_selection(file, selection, entries);
  const auto is_drawn = [&](const sim::SeriesEntry& entry) {
    if (is_among(selection.hidden, entry.part)) return false;
    if (selection.only.empty()) return !sim::is_contact_surface(entry);  // its body is drawn
    return is_among(selection.only, entry.part);
  };
  for (sim::SeriesEntry& entry : entries) {
    FrameEntry& frame = frames[entry.index];
    frame.index = entry.index;
    frame.time = entry.time;
    if (is_drawn(entry)) frame.parts.push_back(std::move(entry));
  }
  for (auto& [index, frame] : frames) series.frames.push_back(std::move(frame));
  if (series.frames.empty()) throw sim::InputError({file.string()}, "no frames in this series");
  if (series.frames.front().parts.empty())
    throw sim::InputError({file.string()}, "--only and --hide leave no part to draw");
  return series;
}

Frame read_frame(const Series& series, const FrameEntry& entry) {
  Frame frame{entry.index, entry.time, {}};
  for (const sim::SeriesEntry& part : entry.parts) {
    const fs::path file = series.directory / part.file;
    if (!fs::exists(file))
      throw sim::InputError({file.string()}, "this frame is listed in the .pvd but not there");
    frame.parts.push_back({part.part, kind_of(part), sim::read_vtk_file(file)});
  }
  return frame;
}

std::string text_of(vtkPointSet& set, const std::string& name) {
  auto* const text =
      vtkStringArray::SafeDownCast(set.GetFieldData()->GetAbstractArray(name.c_str()));
  return text != nullptr && text->GetNumberOfValues() > 0 ? text->GetValue(0) : "";
}

}  // namespace articular::tools
