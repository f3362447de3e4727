#pragma once

#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <string>

namespace articular::tools {

/// The part of space that is drawn: one side of a plane across an axis.
struct Clip {
  int axis = 0;       // 0 to 2
  double at = 0;      // [m]
  bool below = true;  // what is kept
};

/// @param text  "y<12mm", "x > -3 mm" @throws InputError for another one
Clip parse_clip(const std::string& text);

/// Of a unit that `output.length_unit` may have [m].
double metres_of(const std::string& unit);

/// @param everything  the box around what is to be drawn, in `unit`
/// @throws sim::InputError where all of it lies on the other side
void require_kept(const Clip& clip, const Eigen::AlignedBox3d& everything, const std::string& unit);

/// With all values. Tetrahedra are cut, so that the cut has faces with the values there; of
/// surfaces what is hollow stays so. @param unit  of the set's coordinates [m]
vtkSmartPointer<vtkPointSet> clipped(vtkPointSet& set, const Clip& clip, double unit);
/// Without values, as if it were full: a closed surface gets faces on the cut.
vtkSmartPointer<vtkPolyData> clipped_solid(vtkPolyData& surface, const Clip& clip, double unit);

}  // namespace articular::tools
