#pragma once

#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <vector>

#include "fem/base/types.hpp"

namespace articular::tools {

/// The surface of a part of a frame, as triangles.
struct PageSkin {
  std::vector<vtkIdType> nodes;        // of the part that are on it, ascending
  std::vector<std::uint32_t> corners;  // three a triangle, indices into `nodes`
};

PageSkin page_skin(vtkPointSet& set);

/// A surface with at most about so many triangles, near the given one. It has points of its own.
vtkSmartPointer<vtkPointSet> simplified_surface(vtkPointSet& surface, vtkIdType most_triangles);

/// Coordinates of some points, as the file has them.
Positions positions_at(vtkPointSet& set, const std::vector<vtkIdType>& nodes);

}  // namespace articular::tools
