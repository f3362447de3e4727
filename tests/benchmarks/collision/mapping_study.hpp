#pragma once

#include <filesystem>
#include <span>

namespace articular::benchmarks {

/// Time of BucketTree::update with direct mapping and with coordinate sorting, against size and
/// against motion from frame to frame, on a V-shape whose legs oscillate. Table mapping.csv:
/// tetrahedra, motion in cell edges, milliseconds of an update by either, places that an end of a
/// box moved in an update, lists (of three an update) that were handed to a general sort.
void mapping_study(const std::filesystem::path& out, std::span<const int> sizes);

}  // namespace articular::benchmarks
