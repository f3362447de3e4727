#pragma once

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// Samples of a motion, as a file has them.
struct MotionTable {
  std::vector<double> time;                 // [s], strictly increasing
  std::vector<Vec3> translation, rotation;  // [m]; rotation vectors [rad]; empty: no column of it
  std::vector<Location> rows;               // of each sample
};

/// Reads a recorded motion: comma separated values. The first line names the columns with their
/// units, in any order: `time [s]`, and of `translation.x [mm]` to `rotation.z [deg]` those that
/// are not 0 all the time.
/// @throws InputError with file:line; at `reference` if the file cannot be read
MotionTable read_motion_table(const std::filesystem::path& file, const Location& reference);

}  // namespace articular::sim
