// Fits that are shipped begin: each of their runs is read with the parameters' start.
#include <gtest/gtest.h>

#include <filesystem>

#include "sim/scenario/scenario.hpp"
#include "tools/fit/fit_file.hpp"
#include "tools/fit/parameter_text.hpp"

namespace articular::tools::shipped_fits_test {

TEST(ShippedFits, RunsAreReadWithTheParametersStart) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(ARTICULAR_SOURCE_DIR "/scenarios")) {
    if (!entry.path().filename().string().ends_with("-fit.toml")) continue;
    SCOPED_TRACE(entry.path());
    const Fit fit = read_fit(entry.path());
    Eigen::VectorXd start(static_cast<Eigen::Index>(fit.parameters.size()));
    for (Eigen::Index i = 0; i < start.size(); ++i)
      start[i] = fit.parameters[static_cast<std::size_t>(i)].start;
    for (const FitRun& run : fit.runs)
      EXPECT_NO_THROW(sim::read_scenario(fit.scenario, overrides_of(fit, run, start))) << run.name;
    ++count;
  }
  EXPECT_GE(count, 2);
}

}  // namespace articular::tools::shipped_fits_test
