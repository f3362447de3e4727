#pragma once

#include "collision/blocks/block_tree.hpp"

namespace articular::collision {

/// Whether what was found with the margin of the tree's last update is enough at positions x [m]:
/// true while no node of an element is farther than margin/2 from where it was then.
///
/// While it is true of both bodies, no pair meets (elements_meet() without a margin) that was not
/// among the pairs found with the margin, by either narrow test: each body has used up at most its
/// half. So a solver that evaluates many positions in one step may search once and test the pairs
/// it has (narrow_test(), narrow_list.hpp). What the rule calls touching, 1e-13 of the body's size,
/// is taken off, so that a margin less than that covers no motion at all.
/// @throws std::invalid_argument for a wrong number of nodes
bool still_covers(const BlockTree& tree, const Eigen::Matrix3Xd& x);

}  // namespace articular::collision
