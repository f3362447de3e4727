#pragma once

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/frame_series.hpp"
#include "tools/render/run_summary.hpp"

/// The frames of a run as `articular render` reads them.
namespace articular::tools {

/// All parts of one frame, as listed in the .pvd.
struct FrameEntry {
  int index = 0;
  double time = 0;  // [s]
  std::vector<sim::SeriesEntry> parts;
};

struct Series {
  std::string name;  // of the .pvd, without ending
  std::filesystem::path directory;
  std::vector<FrameEntry> frames;  // in the order of time
  RunSummary summary;
};

/// When a frame is: "t = 20.0 ms", or of a static analysis "load 20 %".
std::string moment_of(const Series& series, double time);

/// Which parts of a run are drawn.
struct Selection {
  std::vector<std::string> only;  // contact surfaces among them; empty: all but contact surfaces
  std::vector<std::string> hidden;
};

/// @param run  the folder of a run with one .pvd in it, or the .pvd itself
/// @throws InputError when there is none, or no frame in it, or no part of a name in the selection
Series open_series(const std::filesystem::path& run, const Selection& selection = {});

enum class PartKind { Tissue, Bone, Lines };

struct Part {
  std::string name;
  PartKind kind;
  vtkSmartPointer<vtkPointSet> set;
};

struct Frame {
  int index;
  double time;  // [s]
  std::vector<Part> parts;
};

Frame read_frame(const Series& series, const FrameEntry& entry);

/// A text of the field data of a file, such as "von_mises.unit"; "" if there is none.
std::string text_of(vtkPointSet& set, const std::string& name);

}  // namespace articular::tools
