#pragma once

#include <array>
#include <limits>

#include "fem/sparse/block_matrix.hpp"
#include "sim/model/configuration.hpp"

namespace articular::sim {

/// What a system matrix is made of: mass M + damping D + stiffness K.
struct SystemScale {
  double mass = 0, damping = 0, stiffness = 0;
  /// Length [s] of the implicit step that relaxing stress takes; infinity: it rests.
  double step = std::numeric_limits<double>::infinity();
  bool operator==(const SystemScale&) const = default;
};

/// Blocks of unknowns that a set of nodes moves with; fixed and driven rigid bodies have none.
void append_blocks(const Model& model, const NodeRef& node, std::vector<int>& blocks);

/// Lists of blocks that are coupled, from which a pattern is built.
struct Stencils {
  std::vector<int> blocks, offsets{0};
  void close() { offsets.push_back(static_cast<int>(blocks.size())); }
};

/// Where a stiffness between two nodes goes: to their own block, and where a node moves with a
/// rigid body to the blocks of its rotation; -1: nowhere.
struct NodePairSlots {
  int own = -1, to_turn_j = -1, to_turn_i = -1, to_turn_both = -1;
};
NodePairSlots slots_of(const Model& model, const NodeRef& i, const NodeRef& j,
                       const fem::BlockMatrix& A);
/// See below.
void add_stiffness(const Configuration& configuration, const NodeRef& i, const NodeRef& j,
                   const NodePairSlots& slots, const Mat3& stiffness, fem::BlockMatrix& A);

/// A += stiffness between two nodes, carried over to rigid bodies by their levers. Adds block (i,
/// j) only: call it for (j, i) with the transpose too.
void add_stiffness(const Model& model, const Configuration& configuration, const NodeRef& i,
                   const NodeRef& j, const Mat3& stiffness, fem::BlockMatrix& A);

using SixNodeFactor = Eigen::Matrix<double, 18, 10>;

/// A += left·rightᵀ + right·leftᵀ, a stiffness of six nodes, carried over to rigid bodies.
void add_product(const Model& model, const Configuration& configuration,
                 const std::array<const NodeRef*, 6>& nodes, const SixNodeFactor& left,
                 const SixNodeFactor& right, fem::BlockMatrix& A);

}  // namespace articular::sim
