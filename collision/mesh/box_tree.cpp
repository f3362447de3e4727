#include "collision/mesh/box_tree.hpp"

#include <algorithm>

namespace articular::collision {
namespace {

constexpr int kMostInLeaf = 4;

bool is_empty(const Aabb& box) { return !(box.min.array() <= box.max.array()).all(); }

/// Twice the middle.
Eigen::Vector3d middle(const Aabb& box) { return box.min + box.max; }

}  // namespace

int BoxTree::build(std::span<const Aabb> boxes, int begin, int end) {
  const auto index = static_cast<int>(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  Aabb middles;
  for (int i = begin; i < end; ++i) {
    const Aabb& box = boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    node.box.include(box);
    middles.include(middle(box));
  }
  nodes_.push_back(node);
  if (end - begin <= kMostInLeaf) return index;
  int axis = 0;
  (middles.max - middles.min).maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  const auto key = [&](int body) {
    return std::pair(middle(boxes[static_cast<std::size_t>(body)])[axis], body);
  };
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](int a, int b) { return key(a) < key(b); });
  const int left = build(boxes, begin, half), right = build(boxes, half, end);
  nodes_[static_cast<std::size_t>(index)].left = left;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

void BoxTree::compare_bodies(std::span<const Aabb> boxes, const Node& a, const Node& b) {
  const bool is_same = &a == &b;
  for (int i = a.begin; i < a.end; ++i)
    for (int k = is_same ? i + 1 : b.begin; k < b.end; ++k) {
      const int p = order_[static_cast<std::size_t>(i)], q = order_[static_cast<std::size_t>(k)];
      ++num_tests_;
      if (overlap(boxes[static_cast<std::size_t>(p)], boxes[static_cast<std::size_t>(q)]))
        pairs_.push_back({std::min(p, q), std::max(p, q)});
    }
}

void BoxTree::meet(std::span<const Aabb> boxes, const Node& a, const Node& b) {
  const bool a_is_leaf = a.left < 0, b_is_leaf = b.left < 0;
  const auto node = [&](int index) -> const Node& {
    return nodes_[static_cast<std::size_t>(index)];
  };
  if (&a == &b) {
    if (a_is_leaf) return compare_bodies(boxes, a, a);
    meet(boxes, node(a.left), node(a.left));
    meet(boxes, node(a.right), node(a.right));
    meet(boxes, node(a.left), node(a.right));
    return;
  }
  ++num_tests_;
  if (!overlap(a.box, b.box)) return;
  if (a_is_leaf && b_is_leaf) return compare_bodies(boxes, a, b);
  if (b_is_leaf || (!a_is_leaf && a.end - a.begin >= b.end - b.begin)) {
    meet(boxes, node(a.left), b);
    meet(boxes, node(a.right), b);
  } else {
    meet(boxes, a, node(b.left));
    meet(boxes, a, node(b.right));
  }
}

const std::vector<BodyPair>& BoxTree::overlapping_bodies(std::span<const Aabb> boxes) {
  order_.clear();
  nodes_.clear();
  pairs_.clear();
  num_tests_ = 0;
  for (std::size_t body = 0; body < boxes.size(); ++body)
    if (!is_empty(boxes[body])) order_.push_back(static_cast<int>(body));
  if (order_.empty()) return pairs_;
  const int root = build(boxes, 0, static_cast<int>(order_.size()));
  meet(boxes, nodes_[static_cast<std::size_t>(root)], nodes_[static_cast<std::size_t>(root)]);
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace articular::collision
