#include "sim/model/system_matrix.hpp"

#include <algorithm>

namespace articular::sim {
namespace {

bool is_unknown(const Model& model, const NodeRef& node) {
  return node.rigid < model.layout.num_rigid;  // free nodes: rigid body = -1
}

}  // namespace

void append_blocks(const Model& model, const NodeRef& node, std::vector<int>& blocks) {
  if (!is_unknown(model, node)) return;
  blocks.push_back(node.block);
  if (node.rigid >= 0) blocks.push_back(node.block + 1);
}

NodePairSlots slots_of(const Model& model, const NodeRef& i, const NodeRef& j,
                       const fem::BlockMatrix& A) {
  NodePairSlots slots;
  if (!is_unknown(model, i) || !is_unknown(model, j)) return slots;
  slots.own = A.slot(i.block, j.block);
  if (j.rigid >= 0) slots.to_turn_j = A.slot(i.block, j.block + 1);
  if (i.rigid >= 0) slots.to_turn_i = A.slot(i.block + 1, j.block);
  if (i.rigid >= 0 && j.rigid >= 0) slots.to_turn_both = A.slot(i.block + 1, j.block + 1);
  return slots;
}

void add_stiffness(const Configuration& configuration, const NodeRef& i, const NodeRef& j,
                   const NodePairSlots& slots, const Mat3& stiffness, fem::BlockMatrix& A) {
  if (slots.own < 0) return;
  // A rigid body's point moves by δp − [r]× δθ, and its force turns the rigid body by [r]× f.
  A.block(slots.own) += stiffness;
  Mat3 turned = Mat3::Zero();
  if (slots.to_turn_j >= 0) {
    turned = -stiffness * skew(configuration.lever(j));
    A.block(slots.to_turn_j) += turned;
  }
  if (slots.to_turn_i < 0) return;
  const Mat3 lever = skew(configuration.lever(i));
  A.block(slots.to_turn_i) += lever * stiffness;
  if (slots.to_turn_both >= 0) A.block(slots.to_turn_both) += lever * turned;
}

void add_stiffness(const Model& model, const Configuration& configuration, const NodeRef& i,
                   const NodeRef& j, const Mat3& stiffness, fem::BlockMatrix& A) {
  add_stiffness(configuration, i, j, slots_of(model, i, j, A), stiffness, A);
}

namespace {

/// The blocks that six nodes move with, each once; a rigid body's two stand together.
struct Gathered {
  static constexpr int kMost = 12;
  std::array<int, kMost> block{};
  int count = 0;
  std::array<int, 6> place{};  // of a node's first block; -1: it does not move with unknowns

  Gathered(const Model& model, const std::array<const NodeRef*, 6>& nodes) {
    for (std::size_t k = 0; k < 6; ++k) place[k] = add(model, *nodes[k]);
  }

 private:
  int add(const Model& model, const NodeRef& node) {
    if (!is_unknown(model, node)) return -1;
    for (int b = 0; b < count && node.rigid >= 0; ++b)
      if (block[static_cast<std::size_t>(b)] == node.block) return b;
    const int first = count;
    block[static_cast<std::size_t>(count++)] = node.block;
    if (node.rigid >= 0) block[static_cast<std::size_t>(count++)] = node.block + 1;
    return first;
  }
};

using GatheredFactor = Eigen::Matrix<double, 3 * Gathered::kMost, 10>;

/// A rigid body's node moves by δp − [r]× δθ, and so its force turns the rigid body by [r]× f.
GatheredFactor gathered_factor(const Configuration& configuration,
                               const std::array<const NodeRef*, 6>& nodes, const Gathered& gathered,
                               const SixNodeFactor& factor) {
  GatheredFactor sum;
  sum.topRows(3 * gathered.count).setZero();
  for (std::size_t k = 0; k < 6; ++k) {
    const int place = gathered.place[k];
    if (place < 0) continue;
    const auto rows = factor.middleRows<3>(3 * static_cast<Eigen::Index>(k));
    sum.middleRows<3>(3 * place) += rows;
    if (nodes[k]->rigid >= 0)
      sum.middleRows<3>(3 * place + 3) += skew(configuration.lever(*nodes[k])).lazyProduct(rows);
  }
  return sum;
}

/// A += left·rightᵀ + right·leftᵀ, in whose rows the blocks stand.
template <class Factor>
void add_gathered(const Gathered& gathered, const Factor& left, const Factor& right,
                  fem::BlockMatrix& A) {
  using Half =
      Eigen::Matrix<double, Factor::RowsAtCompileTime, Factor::RowsAtCompileTime, Eigen::ColMajor,
                    Factor::MaxRowsAtCompileTime, Factor::MaxRowsAtCompileTime>;
  const Half half = left.lazyProduct(right.transpose());
  for (int i = 0; i < gathered.count; ++i)
    for (int j = i; j < gathered.count; ++j) {
      const int row = gathered.block[static_cast<std::size_t>(i)],
                column = gathered.block[static_cast<std::size_t>(j)];
      const Mat3 K = half.template block<3, 3>(3 * i, 3 * j) +
                     half.template block<3, 3>(3 * j, 3 * i).transpose();
      A.block(A.slot(row, column)) += K;
      if (i != j) A.block(A.slot(column, row)) += K.transpose();
    }
}

}  // namespace

void add_product(const Model& model, const Configuration& configuration,
                 const std::array<const NodeRef*, 6>& nodes, const SixNodeFactor& left,
                 const SixNodeFactor& right, fem::BlockMatrix& A) {
  const Gathered gathered(model, nodes);
  if (gathered.count == 0) return;
  const bool free = std::all_of(nodes.begin(), nodes.end(), [&](const NodeRef* node) {
    return node->rigid < 0 || !is_unknown(model, *node);
  });
  // Three or six free nodes stand as they are.
  if (free && gathered.count == 6) return add_gathered(gathered, left, right, A);
  if (free && gathered.count == 3 && gathered.place[2] == 2)
    return add_gathered(gathered, left.topRows<9>(), right.topRows<9>(), A);
  if (free && gathered.count == 3 && gathered.place[3] == 0)
    return add_gathered(gathered, left.bottomRows<9>(), right.bottomRows<9>(), A);
  const GatheredFactor l = gathered_factor(configuration, nodes, gathered, left),
                       r = gathered_factor(configuration, nodes, gathered, right);
  if (gathered.count == 5)  // three free nodes and a rigid body
    return add_gathered(gathered, l.topRows<15>(), r.topRows<15>(), A);
  add_gathered(gathered, l.topRows(3 * gathered.count), r.topRows(3 * gathered.count), A);
}

}  // namespace articular::sim
