#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/scenarios/coarse_knee.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::knee_test {

/// Without it there is no recorded knee.
inline bool has_recorded_anatomy() { return std::getenv("ARTICULAR_DATA") != nullptr; }

/// Runs a scenario of the recorded knee, scenarios/knee/FILE, with tetrahedra of 4 mm in place of
/// those of its size.
inline ScenarioResults run_recorded_knee(sim::Scenario scenario) {
  const TemporaryFolder folder;
  const ProgramResult made =
      run_shell(folder, "out=$PWD; SIZE='4 mm' ARTICULAR=\"$articular\" '" ARTICULAR_SOURCE_DIR
                        "/tools/figures/subject-knee' \"$out/meshes\"");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  std::vector<std::filesystem::path*> files = mesh_files(scenario);
  for (std::filesystem::path& file : scenario.files) files.push_back(&file);
  for (std::filesystem::path* file : files) {
    const std::filesystem::path coarse = folder.path() / "meshes" / file->filename();
    if (std::filesystem::exists(coarse)) *file = coarse;
  }
  return run_scenario(scenario);
}

}  // namespace articular::knee_test
