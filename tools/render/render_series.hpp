#pragma once

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fem/base/types.hpp"
#include "sim/mesh/frame_series.hpp"

/// The frames of a run as `articular render` sees them, and what has to be known of all of them
/// before the first is drawn.
namespace articular::tools {

/// All parts of one frame, as listed in the .pvd.
struct FrameEntry {
  int index = 0;
  double time = 0;  // [s]
  std::vector<sim::SeriesEntry> parts;
};

struct Series {
  std::string name;  // of the scenario
  std::filesystem::path directory;
  std::vector<FrameEntry> frames;  // in the order of time
  /// [s]; of a static analysis: its time only says how much of the load acts.
  std::optional<double> whole_load;
};

/// When a frame is: "t = 20.0 ms", or of a static analysis "load 20 %".
std::string moment_of(const Series& series, double time);

/// @param run  the folder of a run with one .pvd in it, or the .pvd itself
/// @param only  parts to keep, contact surfaces among them; empty: all but contact surfaces
/// @throws InputError when there is none, or no frame in it, or no part of a name in `only`
Series open_series(const std::filesystem::path& run, const std::vector<std::string>& only = {});

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

/// What is written of a field in its file.
std::string unit_of(vtkPointSet& set, const std::string& field);

/// One number a point: a scalar field, or the length of a vector; a cell field as the mean over the
/// cells at the point. Empty if the set has no such field.
std::vector<double> nodal_values(vtkPointSet& set, const std::string& field);

/// The directions of a picture in world coordinates: right and up in it, and from the scene to the
/// eye.
struct ViewAxes {
  Vec3 right, up, to_eye;
};

/// The place of the eye from which every point seen so far lies in the given part of the picture,
/// no further away than that takes. With slopes t of the picture's borders (tangent of the angle
/// from the axis of view), a point p is right of the left border if (c − p)·right ≤ t_left (c −
/// p)·to_eye, and so on for the other three; each border needs the largest of its left-hand sides
/// only.
class ViewFit {
 public:
  struct Borders {
    double left, right, bottom, top;  // slopes, > 0
  };
  ViewFit(const ViewAxes& axes, const Borders& borders) : axes_(axes), borders_(borders) {}
  void add(const Vec3& p);
  Vec3 eye() const;
  /// Largest distance of a point from the plane through the eye.
  double depth() const;
  /// Diagonal of the box around all points.
  double diagonal() const { return (high_ - low_).norm(); }
  Vec3 middle() const { return 0.5 * (low_ + high_); }

 private:
  ViewAxes axes_;
  Borders borders_;
  double left_ = -1e300, right_ = -1e300, bottom_ = -1e300, top_ = -1e300, back_ = 1e300;
  Vec3 low_ = Vec3::Constant(1e300), high_ = Vec3::Constant(-1e300);
};

void add_points(vtkPointSet& set, ViewFit& fit);

/// Gathered over all frames.
struct Survey {
  std::set<std::string> fields;       // scalar and vector fields of tissue, or else of bones
  std::set<std::string> fixed_bones;  // those that never move
  std::set<std::string> coloured;     // parts that carry the field
  std::string field;                  // what is drawn; "" if there is nothing to draw
  std::string unit;                   // of it, in the files
  double lowest = 0, highest = 0;     // at any node in any frame
  double high_percentile = 0;         // largest 99.5th percentile of |value - rest| of a frame
};

/// Reads every frame once.
/// @param field  "" for von_mises, or else contact_pressure, or else the first there is
/// @param focus  the part that shall fill the picture; "" for all of them
/// @throws InputError when no part has the field, or none is called `focus`
Survey survey(const Series& series, const std::string& field, const std::string& focus,
              ViewFit& fit);

/// The value that means nothing has happened: 1 for ratios and stretches, else 0.
double rest_value(const std::string& field);

}  // namespace articular::tools
