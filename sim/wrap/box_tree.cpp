#include "sim/wrap/box_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace articular::sim {
namespace {

constexpr int kLeafSize = 4;

/// The slabs of a box cut from the segment a + s (b − a), s in [0, 1].
bool meets(const Eigen::AlignedBox3d& box, const Vec3& a, const Vec3& d, double margin) {
  double low = 0, high = 1;
  for (int i = 0; i < 3; ++i) {
    const double min = box.min()[i] - margin - a[i], max = box.max()[i] + margin - a[i];
    if (d[i] == 0) {
      if (min > 0 || max < 0) return false;
      continue;
    }
    const double s0 = min / d[i], s1 = max / d[i];
    low = std::max(low, std::min(s0, s1));
    high = std::min(high, std::max(s0, s1));
  }
  return low <= high;
}

}  // namespace

BoxTree::BoxTree(const Positions& X, const Triangles& triangles)
    : order_(static_cast<std::size_t>(triangles.cols())) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(X, triangles, 0, static_cast<int>(order_.size()));
  refit(X, triangles);
}

int BoxTree::build(const Positions& X, const Triangles& triangles, int begin, int end) {
  const auto index = static_cast<int>(boxes_.size());
  boxes_.emplace_back();
  if (end - begin <= kLeafSize) {
    boxes_.back().begin = begin;
    boxes_.back().end = end;
    return index;
  }
  const auto middle = [&](int face) -> Vec3 {
    return X.col(triangles(0, face)) + X.col(triangles(1, face)) + X.col(triangles(2, face));
  };
  Eigen::AlignedBox3d middles;
  for (int k = begin; k < end; ++k) middles.extend(middle(order_[static_cast<std::size_t>(k)]));
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](int p, int q) {
                     const double x = middle(p)[axis], y = middle(q)[axis];
                     return x < y || (x == y && p < q);
                   });
  build(X, triangles, begin, half);
  const int right = build(X, triangles, half, end);
  boxes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

void BoxTree::refit(const Positions& X, const Triangles& triangles) {
  // Children stand behind their parents.
  for (std::size_t b = boxes_.size(); b-- > 0;) {
    Box& box = boxes_[b];
    box.bounds.setEmpty();
    for (int k = box.begin; k < box.end; ++k)
      for (const int node : triangles.col(order_[static_cast<std::size_t>(k)]))
        box.bounds.extend(X.col(node));
    if (box.right == 0) continue;
    box.bounds.extend(boxes_[b + 1].bounds);
    box.bounds.extend(boxes_[static_cast<std::size_t>(box.right)].bounds);
  }
}

void BoxTree::find(const Vec3& a, const Vec3& b, double margin, std::vector<int>& found) const {
  found.clear();
  if (boxes_.empty()) return;
  const Vec3 d = b - a;
  std::array<int, 64> open{};  // deeper than any tree that fits in memory
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const int index = open[--count];
    const Box& box = boxes_[static_cast<std::size_t>(index)];
    if (!meets(box.bounds, a, d, margin)) continue;
    for (int k = box.begin; k < box.end; ++k) found.push_back(order_[static_cast<std::size_t>(k)]);
    if (box.right == 0) continue;
    open[count++] = box.right;
    open[count++] = index + 1;
  }
}

}  // namespace articular::sim
