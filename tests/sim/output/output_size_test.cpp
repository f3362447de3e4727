#include "sim/output/output_size.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "tests/sim/support/run_scene.hpp"

namespace articular::sim::output_size_test {

/// Of all files below a folder.
double bytes_in(const fs::path& folder) {
  double sum = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) sum += static_cast<double>(entry.file_size());
  return sum;
}

// An upper bound, and no idle one.
TEST_F(RunTest, ItsEstimateOfTheOutputIsAboutWhatIsWritten) {
  for (const char* const surfaces : {"false", "true"}) {
    const std::vector<std::string> overrides = {
        std::string("output.contact_surfaces=") + surfaces, "output.interval=1 ms",
        "body.block.geometry.box.cells=[9, 9, 9]", "duration=10 ms"};
    const Scenario given = scenario(overrides);
    const OutputSize size = estimated_output(given, build_model(given));
    run_all(surfaces, false, overrides);
    EXPECT_EQ(size.num_frames, 11);
    const double frames = bytes_in(out(surfaces) / "frames");
    EXPECT_NEAR(frames, 11 * size.frame_bytes, 0.03 * frames);
    const double history = static_cast<double>(fs::file_size(out(surfaces) / "history.csv"));
    EXPECT_LT(history, 1.2 * size.num_rows * size.row_bytes);  // its header is no row
    EXPECT_GT(history, size.num_rows * size.row_bytes / 3);
  }
}

TEST(OutputSize, IsRefusedWhereTheDiskHasNotSoMuchFree) {
  const TemporaryFolder folder;
  const double free = static_cast<double>(fs::space(folder.path()).available);
  refuse_more_than_fits({1, 0.4 * free, 1, 0.4 * free}, folder.path());
  EXPECT_THROW(refuse_more_than_fits({1, free, 1, 0.4 * free}, folder.path()), InputError);
  EXPECT_THROW(refuse_more_than_fits({1e9, 1e6, 0, 0}, folder.path()), InputError);
}

}  // namespace articular::sim::output_size_test
