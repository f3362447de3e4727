#include "tools/render/survey.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "sim/output/frame_writer.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::render_test {

TEST(NodalValues, ACellFieldIsTheMeanOverTheCellsAtAPointAndAVectorItsLength) {
  const TemporaryFolder run;
  sim::FrameWriter writer(run.path(), "two", {1, "m"});
  const Positions x = Positions::Random(3, 5);
  Tetrahedra tets(4, 2);
  tets << 0, 1, 1, 2, 2, 3, 3, 4;
  const Eigen::MatrixXd vectors = Eigen::Vector3d(3, 4, 12).replicate(1, 5);
  writer.write_tissue(
      {"t", x, tets, {{"v", "N", vectors}}, {{"s", "Pa", Eigen::RowVector2d(2, 6)}}}, 0, 0);
  writer.finish_frame(0, 0);
  const Series series = open_series(run.path());
  const Frame frame = read_frame(series, series.frames.front());
  vtkPointSet& set = *frame.parts.front().set;
  EXPECT_EQ(smooth_values(set, "s").numbers, (std::vector<double>{2, 4, 4, 4, 6}));
  EXPECT_EQ(smooth_values(set, "v").numbers, std::vector<double>(5, 13));
  EXPECT_EQ(smooth_values(set, "w").numbers, std::vector<double>());
  EXPECT_EQ(cell_values(set, "s").numbers, (std::vector<double>{2, 6}));
  EXPECT_TRUE(cell_values(set, "v").numbers.empty());
  EXPECT_EQ(text_of(set, "s.unit"), "Pa");
}

TEST(Survey, WhatIsBlankDoesNotStretchTheScale) {
  const TemporaryFolder run;
  sim::FrameWriter writer(run.path(), "blank", {1, "m"});
  const double blank = std::numeric_limits<double>::quiet_NaN();
  const Tetrahedra tets = Eigen::Vector4i(0, 1, 2, 3);
  const auto write = [&](const std::string& name, const Eigen::RowVector4d& pressure) {
    const sim::Field field{
        .name = "contact_pressure", .unit = "Pa", .values = pressure, .may_be_blank = true};
    writer.write_tissue({name, Positions::Random(3, 4), tets, {field}, {}}, 0, 0);
  };
  write("first", Eigen::RowVector4d::Constant(blank));
  write("second", {0, blank, 2, 1});
  writer.finish_frame(0, 0);
  const ViewAxes axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const Survey seen =
      survey({as_written(open_series(run.path()))}, {"contact_pressure", false, false}, "", axes);
  EXPECT_TRUE(seen.has_blank);
  EXPECT_EQ(seen.coloured.size(), 2U);
  EXPECT_EQ(seen.lowest, 0);
  EXPECT_EQ(seen.highest, 2);
  EXPECT_GT(seen.high_percentile, 0);
  EXPECT_LE(seen.high_percentile, 2);
}

}  // namespace articular::tools::render_test
