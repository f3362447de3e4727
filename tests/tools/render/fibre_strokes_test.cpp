#include "tools/render/fibre_strokes.hpp"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <array>
#include <cmath>

#include "fem/base/types.hpp"

namespace articular::tools::fibre_strokes_test {

/// A triangle of area 2 in the plane z = 0.
vtkSmartPointer<vtkPolyData> triangle() {
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(2, 1, 0);
  points->InsertNextPoint(1, 2.5, 0);
  vtkNew<vtkCellArray> faces;
  faces->InsertNextCell({0, 1, 2});
  auto set = vtkSmartPointer<vtkPolyData>::New();
  set->SetPoints(points);
  set->SetPolys(faces);
  return set;
}

void add_direction(const Vec3& direction, vtkPolyData& set) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(kFibreDirection);
  array->SetNumberOfComponents(3);
  array->InsertNextTuple(direction.data());
  set.GetCellData()->AddArray(array);
}

std::array<Vec3, 2> ends(vtkPolyData& strokes) {
  std::array<Vec3, 2> p;
  for (int i = 0; i < 2; ++i) strokes.GetPoint(i, p[static_cast<std::size_t>(i)].data());
  return p;
}

TEST(FibreStrokes, LieAlongTheFibreOnTheMiddleOfTheTriangle) {
  const auto set = triangle();
  add_direction(Vec3(0.6, 0.8, 0), *set);
  const auto strokes = fibre_strokes(*set);
  ASSERT_EQ(strokes->GetNumberOfLines(), 1);
  const auto [from, to] = ends(*strokes);
  EXPECT_LT(((from + to) / 2 - Vec3(1, 3.5 / 3, 0)).norm(), 1e-6);
  EXPECT_LT(((to - from).normalized() - Vec3(0.6, 0.8, 0)).norm(), 1e-6);
  EXPECT_NEAR((to - from).norm(), 1.1 * std::sqrt(2.0), 1e-6);
}

TEST(FibreStrokes, AreShorterWhereFibresPassThroughTheSurface) {
  const auto set = triangle();
  add_direction(Vec3(0.6, 0, 0.8), *set);
  const auto [from, to] = ends(*fibre_strokes(*set));
  EXPECT_LT((to - from - 1.1 * std::sqrt(2.0) * Vec3(0.6, 0, 0)).norm(), 1e-6);
}

TEST(FibreStrokes, OfASurfaceWithoutFibresThereAreNone) {
  EXPECT_EQ(fibre_strokes(*triangle())->GetNumberOfLines(), 0);
}

}  // namespace articular::tools::fibre_strokes_test
