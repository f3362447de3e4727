#pragma once

#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace articular::tools {

enum class LineKind { Muscle, Ligament };

/// Muscles as spindles, ligaments as thin cords, each with one value of a field of lines along it
/// as kShown. Their thickness is for the eye only: the model has lines.
/// @param radius  of the belly of a muscle, in the unit of the set
/// @return no points where there are no such lines
vtkSmartPointer<vtkPolyData> tubes_of(vtkPointSet& lines, LineKind kind, double radius,
                                      const std::string& field, double factor);

}  // namespace articular::tools
