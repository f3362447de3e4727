#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "tools/report/packed_numbers.hpp"

namespace articular::tools {

/// Numbers of frames, evenly apart, the first and the last among them: all, or as many as fit.
/// @param count  of frames there are, > 0 @param fitting  how many there is room for
std::vector<std::size_t> spread_frames(std::size_t count, double fitting);

/// The 3D view of a run: as PageScene::json(), with "moments" (texts, one a frame), "length_unit"
/// and "remarks".
/// @param pvd  the time series of the run
/// @param room  [bytes] that the frames may take; what does not fit is left out, evenly
/// @throws InputError  for frames that are listed and not there, or damaged
Json run_scene(const std::filesystem::path& pvd, double room);

}  // namespace articular::tools
