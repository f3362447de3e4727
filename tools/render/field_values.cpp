#include "tools/render/field_values.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

namespace articular::tools {
namespace {

double magnitude(vtkDataArray& array, vtkIdType i) {
  if (array.GetNumberOfComponents() == 1) return array.GetComponent(i, 0);
  double sum = 0;
  for (int k = 0; k < array.GetNumberOfComponents(); ++k)
    sum += array.GetComponent(i, k) * array.GetComponent(i, k);
  return std::sqrt(sum);
}

std::vector<double> magnitudes(vtkDataArray& array) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(array.GetNumberOfTuples()));
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) values.push_back(magnitude(array, i));
  return values;
}

std::vector<double> nodal_means(vtkPointSet& set, vtkDataArray& cells) {
  std::vector<double> values(static_cast<std::size_t>(set.GetNumberOfPoints()), 0.0);
  std::vector<int> count(values.size(), 0);
  vtkNew<vtkIdList> nodes;
  for (vtkIdType e = 0; e < set.GetNumberOfCells(); ++e) {
    set.GetCellPoints(e, nodes);
    const double value = magnitude(cells, e);
    for (vtkIdType a = 0; a < nodes->GetNumberOfIds(); ++a) {
      const auto node = static_cast<std::size_t>(nodes->GetId(a));
      values[node] += value;
      ++count[node];
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= std::max(count[i], 1);
  return values;
}

void add_names(vtkDataSetAttributes& data, std::set<std::string>& names) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* const array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    if (array->GetNumberOfComponents() == 1 || array->GetNumberOfComponents() == 3)
      names.insert(array->GetName());
  }
}

}  // namespace

FieldValues smooth_values(vtkPointSet& set, const std::string& field) {
  if (vtkDataArray* const points = set.GetPointData()->GetArray(field.c_str()))
    return {false, magnitudes(*points)};
  if (vtkDataArray* const cells = set.GetCellData()->GetArray(field.c_str()))
    return {false, nodal_means(set, *cells)};
  return {};
}

FieldValues cell_values(vtkPointSet& set, const std::string& field) {
  vtkDataArray* const cells = set.GetCellData()->GetArray(field.c_str());
  return cells != nullptr ? FieldValues{true, magnitudes(*cells)} : FieldValues{};
}

std::set<std::string> fields_of(vtkPointSet& set) {
  std::set<std::string> names;
  add_names(*set.GetPointData(), names);
  add_names(*set.GetCellData(), names);
  return names;
}

double rest_value(const std::string& field) {
  return field.ends_with("_ratio") || field.ends_with("stretch") ? 1 : 0;
}

}  // namespace articular::tools
