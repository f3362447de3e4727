#pragma once

#include <vtkPointSet.h>

#include <set>
#include <string>
#include <vector>

namespace articular::tools {

/// One number a point, or one a cell: a scalar field, or the length of a vector.
struct FieldValues {
  bool per_cell = false;
  std::vector<double> numbers;  // empty if the set has no such field
};

/// Fields of elements become means at the nodes, so that colours run smoothly.
FieldValues smooth_values(vtkPointSet& set, const std::string& field);

/// Fields of cells as they are: each face or element has the colour of its own value.
FieldValues cell_values(vtkPointSet& set, const std::string& field);

/// Fields that have a meaning as one number a point or cell.
std::set<std::string> fields_of(vtkPointSet& set);

/// The value that means nothing has happened: 1 for ratios and stretches, else 0.
double rest_value(const std::string& field);

}  // namespace articular::tools
