#pragma once

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <string>

/// Small data sets with all that a file of VTK's can hold.
namespace articular::sim {

/// @param type  of their numbers: VTK_FLOAT or VTK_DOUBLE
inline vtkNew<vtkPoints> some_points(int type) {
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  const double x[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.25}, {-0.5, 3, 7}};
  for (const auto& p : x) points->InsertNextPoint(p);
  return points;
}

/// Arrays of every kind that a file can have beside its cells.
inline void add_arrays(vtkDataSet& set) {
  const auto add = [](vtkDataSetAttributes& to, vtkDataArray* array, const char* name,
                      int components, vtkIdType tuples) {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    for (vtkIdType i = 0; i < tuples; ++i)
      for (int c = 0; c < components; ++c) array->SetComponent(i, c, 0.5 * double(i) - c);
    to.AddArray(array);
  };
  vtkCellData& cells = *set.GetCellData();
  vtkPointData& points = *set.GetPointData();
  add(cells, vtkNew<vtkDoubleArray>(), "fibre", 3, set.GetNumberOfCells());
  add(cells, vtkNew<vtkFloatArray>(), "direction", 3, set.GetNumberOfCells());
  add(cells, vtkNew<vtkIntArray>(), "label", 1, set.GetNumberOfCells());
  add(points, vtkNew<vtkFloatArray>(), "pressure with spaces", 1, set.GetNumberOfPoints());
  add(points, vtkNew<vtkDoubleArray>(), "stress", 9, set.GetNumberOfPoints());
  add(points, vtkNew<vtkIntArray>(), "rounded", 1, set.GetNumberOfPoints());  // 0 to 2: no set
  vtkNew<vtkUnsignedCharArray> rim;  // a set of the last three points
  rim->SetName("rim");
  for (vtkIdType i = 0; i < set.GetNumberOfPoints(); ++i) rim->InsertNextValue(i >= 3 ? 1 : 0);
  points.AddArray(rim);
  points.SetActiveTensors("stress");
  cells.SetActiveVectors("direction");
  cells.SetActiveScalars("label");
  vtkNew<vtkStringArray> text;
  text->SetName("unit");
  text->InsertNextValue("mm and more");
  text->InsertNextValue(std::string(100, 'x'));  // its length takes two bytes
  set.GetFieldData()->AddArray(text);
}

inline vtkNew<vtkUnstructuredGrid> some_grid(int type) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(some_points(type));
  const vtkIdType line[] = {0, 5}, tets[2][4] = {{0, 1, 2, 3}, {1, 2, 3, 4}}, face[] = {0, 2, 1};
  grid->InsertNextCell(VTK_LINE, 2, line);
  grid->InsertNextCell(VTK_TETRA, 4, tets[0]);
  grid->InsertNextCell(VTK_TRIANGLE, 3, face);
  grid->InsertNextCell(VTK_TETRA, 4, tets[1]);
  add_arrays(*grid);
  return grid;
}

inline vtkNew<vtkPolyData> some_surface(int type) {
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(some_points(type));
  vtkNew<vtkCellArray> lines, polygons, strips;
  const vtkIdType line[] = {4, 5}, quad[] = {0, 1, 4, 2}, strip[] = {0, 1, 3, 4};
  lines->InsertNextCell(2, line);
  polygons->InsertNextCell(4, quad);
  strips->InsertNextCell(4, strip);
  surface->SetLines(lines);
  surface->SetPolys(polygons);
  surface->SetStrips(strips);
  add_arrays(*surface);
  return surface;
}

}  // namespace articular::sim
