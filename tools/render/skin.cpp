#include "tools/render/skin.hpp"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGeometryFilter.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataSilhouette.h>

#include <algorithm>
#include <cmath>

namespace articular::tools {
namespace {

void add_shown(vtkPointSet& set, const FieldValues& values, double factor) {
  vtkNew<vtkDoubleArray> shown;
  shown->SetName(kShown);
  for (const double value : values.numbers) shown->InsertNextValue(value * factor);
  if (values.per_cell)
    set.GetCellData()->AddArray(shown);
  else
    set.GetPointData()->AddArray(shown);
}

/// Between a value and none there is nothing to interpolate: such a face is blank as a whole.
void split_blank_faces(Skin& skin) {
  vtkDataArray& values = *skin.faces->GetPointData()->GetArray(kShown);
  vtkNew<vtkCellArray> with_values, blank;
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < skin.faces->GetNumberOfCells(); ++face) {
    skin.faces->GetCellPoints(face, corners);
    const bool is_blank = std::any_of(corners->begin(), corners->end(), [&](vtkIdType i) {
      return std::isnan(values.GetComponent(i, 0));
    });
    (is_blank ? blank : with_values)->InsertNextCell(corners);
  }
  if (blank->GetNumberOfCells() == 0) return;
  const auto of = [&](vtkCellArray* faces) {
    auto set = vtkSmartPointer<vtkPolyData>::New();
    set->SetPoints(skin.faces->GetPoints());
    set->GetPointData()->AddArray(&values);
    set->SetPolys(faces);
    return set;
  };
  skin.blank = of(blank);
  skin.faces = of(with_values);
}

}  // namespace

Skin skin_of(const Part& part, const FieldValues& values, double factor,
             const std::optional<Clip>& clip, double unit) {
  vtkSmartPointer<vtkPointSet> set = part.set;
  Skin skin;
  skin.has_values = !values.numbers.empty();
  skin.per_cell = values.per_cell;
  if (skin.has_values) add_shown(*set, values, factor);
  if (clip) {
    vtkPolyData* const surface = vtkPolyData::SafeDownCast(set);
    if (surface != nullptr && !skin.has_values)
      set = clipped_solid(*surface, *clip, unit);
    else
      set = clipped(*set, *clip, unit);
  }
  vtkNew<vtkGeometryFilter> boundary;
  boundary->SetInputData(set);
  boundary->Update();
  skin.faces = boundary->GetOutput();
  if (skin.has_values && !skin.per_cell && skin.faces->GetNumberOfCells() > 0)
    split_blank_faces(skin);
  return skin;
}

vtkSmartPointer<vtkPolyData> outline_of(vtkPolyData& surface, vtkCamera& camera, Outline outline) {
  constexpr double kSharp = 50;  // [degree]
  vtkNew<vtkPolyDataSilhouette> lines;
  lines->SetInputData(&surface);
  lines->SetCamera(&camera);
  lines->SetDirectionToCameraVector();
  lines->BorderEdgesOn();
  lines->SetEnableFeatureAngle(outline == Outline::ContourAndBends ? 1 : 0);
  lines->SetFeatureAngle(kSharp);
  lines->Update();
  return lines->GetOutput();
}

}  // namespace articular::tools
