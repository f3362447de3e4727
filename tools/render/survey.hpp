#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/render/field_values.hpp"
#include "tools/render/render_series.hpp"
#include "tools/render/view.hpp"

/// What has to be known of all frames of all runs before the first is drawn: one range of colours
/// and one size for all, so that pictures compare and a film is calm.
namespace articular::tools {

/// A run whose frames come from somewhere: as they were written, or changed on the way.
struct DrawnRun {
  Series series;
  std::function<Frame(const FrameEntry&)> read;
};

/// The frames as they were written.
DrawnRun as_written(Series series);

/// What is drawn together has one unit of length. @throws sim::InputError
void require_same_unit(const Series& series, const std::string& expected, const std::string& found);

/// What colours what.
struct Colouring {
  std::string field;             // "": von_mises, else contact_pressure, else the first there is
  bool each_cell_alone = false;  // no means at nodes, see cell_values()
  bool is_difference = false;    // of two runs: at rest it is 0
};

struct Survey {
  std::string field;               // what is drawn; "" if there is nothing to draw
  std::string unit;                // of it, in the files
  std::string length_unit = "mm";  // of coordinates, in the files
  bool of_lines = false;           // the field is one of muscles and ligaments
  bool each_cell_alone = false, is_difference = false;
  std::set<std::string> coloured;  // parts that carry the field
  bool has_blank = false;          // NaN somewhere
  double rest = 0;                 // rest_value() of the field
  double lowest = 0, highest = 0;  // at any place in any frame
  double high_percentile = 0;      // largest 99.5th percentile of |value - rest| of a frame
  bool has_muscles = false;
  std::optional<double> highest_tension;  // [N] of ligaments, if there are any
  Vec3 size = Vec3::Zero();               // of the box around what has to be seen, along the view
  std::optional<Vec3> middle;             // of it; none: of the focus in each frame
  double diagonal = 0;                    // of the box around everything
  Eigen::AlignedBox3d everything;         // in all frames, by the axes of the files
};

/// Makes the survey's box around everything hold the part.
void add_bounds(const Part& part, Survey& survey);

/// The values of a part as they are drawn; none if it does not carry the field.
FieldValues drawn_values(const Part& part, const Survey& survey);

/// The middle of what has to be seen of a frame.
Vec3 middle_of(const Frame& frame, const ViewAxes& axes, const std::string& focus);

/// Reads every frame of every run once. @param focus  the part that shall fill the picture in every
/// frame; "" for all of them
/// @throws InputError when no part has the field, or none is called `focus`; when a field has no
///         values of cells and those were asked for
Survey survey(const std::vector<DrawnRun>& runs, const Colouring& colouring,
              const std::string& focus, const ViewAxes& axes);

}  // namespace articular::tools
