#include "collision/blocks/still_covers.hpp"

#include "collision/mesh/bad_input.hpp"

namespace articular::collision {
namespace {

// Shapes within this part of their size of each other may count as touching (separating_axes.hpp
// and narrow_rule.hpp; the trees' own round-off is on the safe side).
constexpr double kRoundOff = 1e-13;

}  // namespace

bool still_covers(const BlockTree& tree, const Eigen::Matrix3Xd& x) {
  if (x.cols() != tree.num_user_nodes())
    bad_input("position: ", x.cols(), " nodes, expected ", tree.num_user_nodes());
  if (tree.num_tets() == 0) return true;
  if (tree.num_updates() == 0) return false;
  const double room = 0.5 * tree.margin() - kRoundOff * tree.bounds().longest_edge();
  // In units of the room, so that squares stay in the range of numbers. A NaN is not within it.
  const double inverse = 1 / room;
  const double* then = tree.positions();
  bool within = true;
  for (const int node : tree.node_order()) {
    const Eigen::Vector3d way = (x.col(node) - Eigen::Vector3d::Map(then)) * inverse;
    within &= way.squaredNorm() <= 1;
    then += 4;
  }
  return room > 0 && within;
}

}  // namespace articular::collision
