#include "sim/mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/mesh/triangle_distance.hpp"

namespace articular::sim {
namespace {

constexpr int kLeafSize = 4;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// A box's distance is round-off off that of a triangle in it.
constexpr double kBelow = 1 - 1e-9;

Vec3 middle(const std::array<Vec3, 3>& corners) { return corners[0] + corners[1] + corners[2]; }

/// The slabs of a box, widened by a margin, cut from the segment a + s d, s in [0, 1].
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

TriangleTree::TriangleTree(const Positions& X, const Triangles& triangles) {
  for (int t = 0; t < static_cast<int>(triangles.cols()); ++t)
    triangles_.push_back(
        {{X.col(triangles(0, t)), X.col(triangles(1, t)), X.col(triangles(2, t))}, t});
  if (!triangles_.empty()) build(0, static_cast<int>(triangles_.size()));
}

int TriangleTree::build(int begin, int end) {
  const auto index = static_cast<int>(boxes_.size());
  Box box;
  for (int k = begin; k < end; ++k)
    for (const Vec3& corner : triangles_[static_cast<std::size_t>(k)].corners)
      box.bounds.extend(corner);
  boxes_.push_back(box);
  if (end - begin <= kLeafSize) {
    boxes_.back().begin = begin;
    boxes_.back().end = end;
    return index;
  }
  Eigen::Index axis = 0;
  box.bounds.sizes().maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
                   [axis](const Triangle& p, const Triangle& q) {
                     return middle(p.corners)[axis] < middle(q.corners)[axis];
                   });
  build(begin, half);
  const int right = build(half, end);
  boxes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

double TriangleTree::nearest(const Vec3& x, double limit, double least) const {
  double found = kInfinite;
  std::vector<std::pair<int, double>> open;  // boxes, and how near they come [m²]
  if (!boxes_.empty()) open.emplace_back(0, boxes_[0].bounds.squaredExteriorDistance(x));
  while (!open.empty()) {
    const auto [index, from_box] = open.back();
    open.pop_back();
    if (kBelow * from_box > std::min(limit, found)) continue;
    const Box& box = boxes_[static_cast<std::size_t>(index)];
    for (int k = box.begin; k < box.end; ++k) {
      const std::array<Vec3, 3>& p = triangles_[static_cast<std::size_t>(k)].corners;
      const double distance = squared_distance(x, p[0], p[1], p[2]);
      if (distance <= limit) found = std::min(found, distance);
    }
    if (found <= least) return found;
    if (box.right == 0) continue;
    std::pair<int, double> near(index + 1, 0), far(box.right, 0);
    for (auto* child : {&near, &far})
      child->second =
          boxes_[static_cast<std::size_t>(child->first)].bounds.squaredExteriorDistance(x);
    if (near.second > far.second) std::swap(near, far);
    open.push_back(far);  // what is pushed last is looked at first
    open.push_back(near);
  }
  return found;
}

bool TriangleTree::is_within(const Vec3& x, double distance) const {
  const double squared = distance * distance;
  return nearest(x, squared, squared) <= squared;
}

double TriangleTree::distance(const Vec3& x) const { return std::sqrt(nearest(x, kInfinite, 0)); }

void TriangleTree::find(const Vec3& a, const Vec3& b, double margin,
                        std::vector<int>& found) const {
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
    for (int k = box.begin; k < box.end; ++k)
      found.push_back(triangles_[static_cast<std::size_t>(k)].index);
    if (box.right == 0) continue;
    open[count++] = box.right;
    open[count++] = index + 1;
  }
}

}  // namespace articular::sim
