#pragma once

#include <Eigen/Core>
#include <vector>

namespace articular::collision {

/// An order of points in which every aligned run of block_size 2^k points is compact: a tree of
/// median cuts along the longest side, its leaves from left to right. As good as a space-filling
/// curve where neighbours in the list have to be neighbours in space, and without that curve's
/// jumps.
/// @param points  one a column
std::vector<int> spatial_order(const Eigen::Matrix3Xd& points, int block_size);

}  // namespace articular::collision
