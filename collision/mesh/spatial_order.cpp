#include "collision/mesh/spatial_order.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace articular::collision {
namespace {

void cut(const Eigen::Matrix3Xd& points, std::span<int> part, std::size_t block_size) {
  if (part.size() <= block_size) return;
  Eigen::Array3d low = points.col(part[0]), high = low;
  for (const int i : part) {
    low = low.min(points.col(i).array());
    high = high.max(points.col(i).array());
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  // The left part is full, so that runs of 2^k blocks stay aligned.
  std::size_t left = block_size;
  while (2 * left < part.size()) left *= 2;
  const auto before = [&](int i, int j) {
    return std::pair(points(axis, i), i) < std::pair(points(axis, j), j);
  };
  std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(left), part.end(),
                   before);
  cut(points, part.first(left), block_size);
  cut(points, part.subspan(left), block_size);
}

}  // namespace

std::vector<int> spatial_order(const Eigen::Matrix3Xd& points, int block_size) {
  std::vector<int> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  cut(points, order, static_cast<std::size_t>(block_size));
  return order;
}

}  // namespace articular::collision
