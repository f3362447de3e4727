#include "tools/render/changed_run.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "sim/output/frame_writer.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::render_test {

/// Two frames of a tetrahedron that moves by (1, 0, 0) mm, with a stress of 10 i `scale` in frame
/// i.
void write_moving(const std::filesystem::path& folder, double scale, double interval,
                  Eigen::Index num_tets = 1, const sim::LengthUnit& unit = {1e-3, "mm"}) {
  sim::FrameWriter writer(folder, "moving", unit);
  const Tetrahedra tets = Eigen::Vector4i(0, 1, 2, 3).replicate(1, num_tets);
  Positions rest(3, 4);
  rest << 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2;
  rest *= 1e-3;
  for (int i = 0; i < 2; ++i) {
    Positions x = rest;
    x.row(0).array() += 1e-3 * i;
    const Eigen::MatrixXd stress = Eigen::MatrixXd::Constant(1, num_tets, 10 * i * scale);
    writer.write_tissue({"block", x, tets, {}, {{"von_mises", "Pa", stress}}}, i, i * interval);
    writer.finish_frame(i, i * interval);
  }
}

DrawnRun run_in(const TemporaryFolder& folder) { return as_written(open_series(folder.path())); }

double largest_x(const Frame& frame) {
  double bounds[6];
  frame.parts.front().set->GetBounds(bounds);
  return bounds[1];
}

TEST(Exaggerated, MotionsSinceTheFirstFrameAreSoManyTimesAsLarge) {
  const TemporaryFolder folder;
  write_moving(folder.path(), 1, 0.1);
  const DrawnRun run = exaggerated(run_in(folder), 10);
  EXPECT_DOUBLE_EQ(largest_x(run.read(run.series.frames[0])), 2);
  EXPECT_DOUBLE_EQ(largest_x(run.read(run.series.frames[1])), 12);
}

TEST(Difference, IsTheSecondRunMinusTheFirst) {
  const TemporaryFolder one, two;
  write_moving(one.path(), 1, 0.1);
  write_moving(two.path(), 0.7, 0.1);
  const DrawnRun run = difference(run_in(one), run_in(two));
  const Frame frame = run.read(run.series.frames[1]);
  EXPECT_NEAR(smooth_values(*frame.parts.front().set, "von_mises").numbers.front(), -3, 1e-12);
  EXPECT_EQ(text_of(*frame.parts.front().set, "von_mises.unit"), "Pa");
}

TEST(Difference, NeedsTheSameMeshesAndTimes) {
  const TemporaryFolder one, other_mesh, other_times, other_unit;
  write_moving(one.path(), 1, 0.1);
  write_moving(other_mesh.path(), 1, 0.1, 2);
  write_moving(other_times.path(), 1, 0.2);
  write_moving(other_unit.path(), 1, 0.1, 1, {1, "m"});
  const auto error = [&](const TemporaryFolder& other) -> std::string {
    const DrawnRun run = difference(run_in(one), run_in(other));
    try {
      run.read(run.series.frames[1]);
    } catch (const sim::InputError& found) {
      return found.what();
    }
    return "no error";
  };
  EXPECT_NE(error(other_unit).find("its lengths are in m, and those beside it in mm"),
            std::string::npos)
      << error(other_unit);
  try {
    survey({run_in(one), run_in(other_unit)}, {}, "", {});
    ADD_FAILURE() << "runs in mm and m were drawn side by side";
  } catch (const sim::InputError& found) {
    EXPECT_NE(std::string(found.what()).find("its lengths are in m"), std::string::npos);
  }
  EXPECT_NE(error(other_mesh).find("`block` has 4 points and 1 cells in frame 1, there 4 and 2"),
            std::string::npos)
      << error(other_mesh);
  EXPECT_NE(error(other_times).find("there is no frame at t = 100.0 ms"), std::string::npos)
      << error(other_times);
}

}  // namespace articular::tools::render_test
