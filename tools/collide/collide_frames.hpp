#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tools/collide/collide_search.hpp"

/// `articular collide` from frame to frame.
namespace articular::tools {

/// One surface triangle that meets one tetrahedron. Tetrahedra are numbered from 0 among those of
/// the file; face f lies opposite node f of its tetrahedron.
struct PairRow {
  int frame;
  int triangle_body, triangle_tet, triangle_face;
  int tet_body, tet;
  friend auto operator<=>(const PairRow&, const PairRow&) = default;
};

/// Times are medians over the passes. A body that stands still is updated in frame 0 only.
struct FrameFigures {
  double update_seconds = 0, traverse_seconds = 0, narrow_seconds = 0, total_seconds = 0;
  std::int64_t candidates = 0, pairs = 0;
};

struct CollideFigures {
  std::vector<FrameFigures> frames;
  std::size_t memory = 0;  // bytes that trees and queries hold; 0 where malloc does not tell
  bool interrupted = false;
};

struct PassSettings {
  bool self = false;  // of two bodies, each with itself as well
  int repeat = 1;
  /// Called once a frame, in order, with its pairs in ascending order. May be empty.
  std::function<void(std::span<const PairRow>)> take_pairs;
  /// Called after each frame of each pass with the number done; true to stop. May be empty.
  std::function<bool(std::size_t)> after_frame;
};

/// The frames of one or two bodies, which are then searched one after the other, and all that
/// again `repeat` times.
/// @throws sim::InputError naming the file of a frame that a tree refuses
CollideFigures collide_frames(std::span<const MeshSeries> bodies, const SearchSettings& search,
                              const PassSettings& passes);

/// Of one body, or of two with the same number of frames or one that stands still.
/// @throws sim::InputError if they don't fit together
std::size_t count_frames(std::span<const MeshSeries> bodies);

}  // namespace articular::tools
