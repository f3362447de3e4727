#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace articular::tools {

/// Cell array of three components that has the direction of fibres.
inline constexpr const char* kFibreDirection = "fibre_direction";

/// A short line on the middle of each triangle, along its element's fibres and within its plane. A
/// triangle that fibres pass across has a shorter one. Empty where the surface has no fibres.
vtkSmartPointer<vtkPolyData> fibre_strokes(vtkPolyData& surface);

}  // namespace articular::tools
