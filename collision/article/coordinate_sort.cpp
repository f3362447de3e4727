#include "collision/article/coordinate_sort.hpp"

#include <algorithm>
#include <cassert>

namespace articular::collision {

void CoordinateSort::sort(std::span<const Aabb> boxes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<End>& ends = axes_[axis];
    if (ends.empty()) {  // boxes in the order given; the sort below brings them into theirs
      ends.resize(2 * boxes.size());
      for (std::size_t i = 0; i < ends.size(); ++i)
        ends[i] = {0, static_cast<int>(i / 2), i % 2 == 1};
    }
    assert(ends.size() == 2 * boxes.size());
    for (End& end : ends) {
      const Aabb& box = boxes[static_cast<std::size_t>(end.box)];
      end.value = (end.is_upper ? box.max : box.min)[static_cast<Eigen::Index>(axis)];
    }
    sort_axis(ends);
  }
}

void CoordinateSort::sort_axis(std::vector<End>& ends) {
  std::int64_t moves_left = kMaxMovesPerEnd * static_cast<std::int64_t>(ends.size());
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const End end = ends[i];
    std::size_t j = i;
    for (; j > 0 && end.value < ends[j - 1].value && moves_left > 0; --j, --moves_left)
      ends[j] = ends[j - 1];
    ends[j] = end;
    num_moves_ += static_cast<std::int64_t>(i - j);
    if (moves_left == 0) {
      ++num_fallbacks_;
      std::sort(ends.begin(), ends.end(),
                [](const End& a, const End& b) { return a.value < b.value; });
      return;
    }
  }
}

Aabb CoordinateSort::bounds() const {
  Aabb box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axes_[axis].empty()) return box;
    box.min[static_cast<Eigen::Index>(axis)] = axes_[axis].front().value;
    box.max[static_cast<Eigen::Index>(axis)] = axes_[axis].back().value;
  }
  return box;
}

void CoordinateSort::update_bucket_indices(const IntervalLists& bounds,
                                           std::span<BucketInterval> intervals) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& X = bounds[axis];
    const std::size_t num_buckets = X.size() - 1;
    std::size_t i = 0;
    for (const End& end : axes_[axis]) {
      while (i + 1 < num_buckets && end.value >= X[i + 1]) ++i;
      BucketInterval& interval = intervals[static_cast<std::size_t>(end.box)];
      (end.is_upper ? interval.max : interval.min)[axis] = static_cast<std::uint8_t>(i);
    }
  }
}

}  // namespace articular::collision
