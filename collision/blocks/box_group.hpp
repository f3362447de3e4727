#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "collision/blocks/block_kernels.hpp"

/// Boxes in groups of sixteen.
namespace articular::collision {

inline constexpr std::size_t kLanes = kBlockSize;

inline std::size_t num_groups(std::size_t num) { return (num + kLanes - 1) / kLanes; }

/// The box of nothing: it overlaps no box, and its union with a box is that box.
inline FloatBox empty_box() {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

inline FloatBox box_in(const BoxGroup& group, std::size_t lane) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = group.low[axis][lane];
    box.high[axis] = group.high[axis][lane];
  }
  return box;
}

inline void put(const FloatBox& box, BoxGroup& group, std::size_t lane) {
  for (int axis = 0; axis < 3; ++axis) {
    group.low[axis][lane] = box.low[axis];
    group.high[axis][lane] = box.high[axis];
  }
}

inline BoxGroup empty_group() {
  BoxGroup group;
  for (std::size_t lane = 0; lane < kLanes; ++lane) put(empty_box(), group, lane);
  return group;
}

inline FloatBox union_of(const BoxGroup& group) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = *std::min_element(group.low[axis], group.low[axis] + kLanes);
    box.high[axis] = *std::max_element(group.high[axis], group.high[axis] + kLanes);
  }
  return box;
}

inline bool overlap(const FloatBox& a, const FloatBox& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis])) return false;
  return true;
}

}  // namespace articular::collision
