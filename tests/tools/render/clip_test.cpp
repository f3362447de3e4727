#include "tools/render/clip.hpp"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "sim/base/error.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::tools::render_test {

TEST(Clip, KeepsWhatIsAskedFor) {
  const Clip below = parse_clip("y<12mm"), above = parse_clip(" x > -0.5 cm ");
  EXPECT_EQ(below.axis, 1);
  EXPECT_TRUE(below.below);
  EXPECT_DOUBLE_EQ(below.at, 0.012);
  EXPECT_EQ(above.axis, 0);
  EXPECT_FALSE(above.below);
  EXPECT_DOUBLE_EQ(above.at, -0.005);
  for (const char* const wrong :
       {"", "y", "w<1mm", "y=1mm", "y<", "y<1", "y<1s", "y<mm", "y<1e-mm"})
    EXPECT_THROW(parse_clip(wrong), sim::InputError) << wrong;
}

// A box from 2 to 5 mm along y: what is asked for must have some of it, on either side.
TEST(Clip, ThatLeavesNothingIsAnError) {
  const Eigen::AlignedBox3d box(Vec3(-10, 2, -10), Vec3(10, 5, 10));
  for (const char* const some : {"y<2.1mm", "y>4.9mm", "y<1m", "y>-1m"})
    EXPECT_NO_THROW(require_kept(parse_clip(some), box, "mm")) << some;
  for (const char* const none : {"y<1.9mm", "y>5.1mm", "y>1m"})
    EXPECT_THROW(require_kept(parse_clip(none), box, "mm"), sim::InputError) << none;
  EXPECT_NO_THROW(require_kept(parse_clip("y>4.9cm"), box, "cm"));
  EXPECT_THROW(require_kept(parse_clip("y>5.1cm"), box, "cm"), sim::InputError);
}

// Of a tetrahedron with its corners at 0 and 2 on the axes, x > 1 keeps the tip. The cut is a face
// with values in between: of a field 10 x it is 10 everywhere on it.
TEST(Clip, CutsTetrahedraWithTheirValues) {
  Positions x(3, 4);
  x << 0, 2e-3, 0, 0, 0, 0, 2e-3, 0, 0, 0, 0, 2e-3;
  const auto set = sim::make_grid(x, 1e-3, Tetrahedra(Eigen::Vector4i(0, 1, 2, 3)), {});
  vtkNew<vtkDoubleArray> field;
  field->SetName("field");
  for (const double value : {0.0, 20.0, 0.0, 0.0}) field->InsertNextValue(value);
  set->GetPointData()->AddArray(field);
  const auto tip = clipped(*set, parse_clip("x>1mm"), 1e-3);
  double bounds[6];
  tip->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], 1, 1e-9);
  EXPECT_NEAR(bounds[1], 2, 1e-9);
  EXPECT_NEAR(tip->GetPointData()->GetArray("field")->GetRange()[0], 10, 1e-9);
}

// Four faces of a tetrahedron are closed, three are not.
TEST(Clip, FillsTheCutOfAClosedSurfaceOnly) {
  Positions x(3, 4);
  x << 0, 2e-3, 0, 0, 0, 0, 2e-3, 0, 0, 0, 0, 2e-3;
  Triangles closed(3, 4);
  closed << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  const auto faces_on_cut = [&](const Triangles& faces) {
    const auto set = sim::make_surface(x, 1e-3, faces);
    const auto tip = clipped_solid(*vtkPolyData::SafeDownCast(set), parse_clip("x>1mm"), 1e-3);
    int count = 0;
    for (vtkIdType face = 0; face < tip->GetNumberOfCells(); ++face) {
      double bounds[6];
      tip->GetCellBounds(face, bounds);
      count += bounds[1] < 1 + 1e-6 ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(faces_on_cut(closed), 0);
  EXPECT_EQ(faces_on_cut(closed.leftCols(3)), 0);
}

}  // namespace articular::tools::render_test
