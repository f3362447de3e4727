#include "collision/mesh/sweep.hpp"

#include <algorithm>

namespace articular::collision {
namespace {

bool is_empty(const Aabb& box) { return !(box.min.array() <= box.max.array()).all(); }

/// The axis along which the centres vary most.
int axis_of_largest_spread(std::span<const Aabb> boxes, const std::vector<int>& order) {
  Aabb centres;
  for (const int body : order) {
    const Aabb& box = boxes[static_cast<std::size_t>(body)];
    centres.include(Eigen::Vector3d(0.5 * box.min + 0.5 * box.max));
  }
  int axis = 0;
  if (!order.empty()) (centres.max - centres.min).maxCoeff(&axis);
  return axis;
}

/// Drops bodies that are no more or empty, and appends those that are new.
void follow(std::span<const Aabb> boxes, std::vector<int>& order) {
  const int num = static_cast<int>(boxes.size());
  std::vector<bool> there(boxes.size(), false);
  std::erase_if(order, [&](int body) {
    if (body >= num || is_empty(boxes[static_cast<std::size_t>(body)])) return true;
    there[static_cast<std::size_t>(body)] = true;
    return false;
  });
  for (int body = 0; body < num; ++body)
    if (!there[static_cast<std::size_t>(body)] && !is_empty(boxes[static_cast<std::size_t>(body)]))
      order.push_back(body);
}

/// Insertion sort, linear while the order hardly changes; given up after a few moves a body, as
/// then (bodies have jumped, or the axis is another one) a general sort is faster.
template <class Before>
void put_in_order(std::vector<int>& order, Before&& before) {
  std::size_t moves_left = 8 * order.size();
  for (std::size_t i = 1; i < order.size(); ++i) {
    const int body = order[i];
    std::size_t place = i;
    for (; place > 0 && before(body, order[place - 1]); --place) {
      order[place] = order[place - 1];
      if (moves_left-- > 1) continue;
      order[place - 1] = body;
      std::sort(order.begin(), order.end(), before);
      return;
    }
    order[place] = body;
  }
}

}  // namespace

const std::vector<BodyPair>& BodySweep::overlapping_bodies(std::span<const Aabb> boxes) {
  follow(boxes, order_);
  const int axis = axis_of_largest_spread(boxes, order_);
  const auto box = [&](int body) -> const Aabb& { return boxes[static_cast<std::size_t>(body)]; };
  put_in_order(order_, [&](int a, int b) {
    return std::pair(box(a).min[axis], a) < std::pair(box(b).min[axis], b);
  });
  pairs_.clear();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const int body = order_[i];
    const double end = box(body).max[axis];
    for (std::size_t k = i + 1; k < order_.size() && box(order_[k]).min[axis] <= end; ++k)
      if (overlap(box(body), box(order_[k])))
        pairs_.push_back({std::min(body, order_[k]), std::max(body, order_[k])});
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace articular::collision
