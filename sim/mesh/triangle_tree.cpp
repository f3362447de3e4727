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

Vec3 middle(const std::array<Vec3, 3>& triangle) { return triangle[0] + triangle[1] + triangle[2]; }

}  // namespace

TriangleTree::TriangleTree(const Positions& X, const Triangles& triangles) {
  for (const auto& triangle : triangles.colwise())
    corners_.push_back({X.col(triangle[0]), X.col(triangle[1]), X.col(triangle[2])});
  if (!corners_.empty()) build(0, static_cast<int>(corners_.size()));
}

int TriangleTree::build(int begin, int end) {
  const auto index = static_cast<int>(boxes_.size());
  Box box;
  for (int k = begin; k < end; ++k)
    for (const Vec3& corner : corners_[static_cast<std::size_t>(k)]) box.bounds.extend(corner);
  boxes_.push_back(box);
  if (end - begin <= kLeafSize) {
    boxes_.back().begin = begin;
    boxes_.back().end = end;
    return index;
  }
  Eigen::Index axis = 0;
  box.bounds.sizes().maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  std::nth_element(corners_.begin() + begin, corners_.begin() + half, corners_.begin() + end,
                   [axis](const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q) {
                     return middle(p)[axis] < middle(q)[axis];
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
      const std::array<Vec3, 3>& p = corners_[static_cast<std::size_t>(k)];
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

}  // namespace articular::sim
