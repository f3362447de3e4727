#pragma once

#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

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

/// @param unit  of the set's coordinates [m]. Tetrahedra are cut, so that the cut has faces with
/// the values there.
vtkSmartPointer<vtkPointSet> clipped(vtkPointSet& set, const Clip& clip, double unit);
/// Faces are cut, and what is hollow stays so.
vtkSmartPointer<vtkPolyData> clipped_surface(vtkPolyData& surface, const Clip& clip, double unit);

}  // namespace articular::tools
