#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/error.hpp"

namespace articular::sim {

/// A row of a table of muscles, as the file has it.
struct MuscleRow {
  std::string id, muscle;  // the line's own name, and the muscle it is a part or side of
  std::string upper_body, lower_body;
  double upper_mm[3] = {}, lower_mm[3] = {};  // origin and insertion [mm]
  double max_force = 0;                       // [N]
  std::optional<double> optimal_length;       // [m], of the whole muscle
  double max_length_ratio = 0;                // length of maximal passive force / optimal length
  double tendon_ratio = 0;
  Location where;  // file and line
};

/// Reads a table of muscles: comma separated values (fields may be quoted), the first line names
/// the columns id, muscle, body_upper, ux_mm, uy_mm, uz_mm, body_lower, lx_mm, ly_mm, lz_mm,
/// max_force_N, max_over_opt_length and tendon_ratio in any order. There may be a column
/// optimal_length_mm, with empty fields where it is not known; other columns are ignored.
/// @throws InputError with file:line for what is not such a table; at `reference` if the file
/// cannot be read
std::vector<MuscleRow> read_muscle_table(const std::filesystem::path& file,
                                         const Location& reference);

}  // namespace articular::sim
