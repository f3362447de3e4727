#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <optional>

#include "tools/render/clip.hpp"
#include "tools/render/field_values.hpp"
#include "tools/render/render_series.hpp"

class vtkCamera;

/// The surfaces of parts, ready to be drawn.
namespace articular::tools {

/// Name of the array that colours.
inline constexpr const char* kShown = "shown";

struct Skin {
  vtkSmartPointer<vtkPolyData> faces;  // with the values, if there are any, as kShown
  vtkSmartPointer<vtkPolyData> blank;  // faces with a corner that has no value; may be empty
  bool has_values = false, per_cell = false;
};

/// @param factor  of the values @param unit  of coordinates [m]
Skin skin_of(const Part& part, const FieldValues& values, double factor,
             const std::optional<Clip>& clip, double unit);

/// The lines where a surface turns away from the eye, and with bends also those where its faces
/// meet at a sharp angle: its shape, without a shade on its colours.
enum class Outline { Contour, ContourAndBends };
vtkSmartPointer<vtkPolyData> outline_of(vtkPolyData& surface, vtkCamera& camera, Outline outline);

}  // namespace articular::tools
