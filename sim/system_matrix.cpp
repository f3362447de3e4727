#include "sim/system_matrix.hpp"

namespace articular::sim {
namespace {

bool is_unknown(const Model& model, const NodeRef& node) {
  return node.bone < model.layout.num_rigid;  // free nodes: bone = -1
}

}  // namespace

void append_blocks(const Model& model, const NodeRef& node, std::vector<int>& blocks) {
  if (!is_unknown(model, node)) return;
  blocks.push_back(node.block);
  if (node.bone >= 0) blocks.push_back(node.block + 1);
}

void add_stiffness(const Model& model, const Configuration& configuration, const NodeRef& i,
                   const NodeRef& j, const Mat3& stiffness, fem::BlockMatrix& A) {
  if (!is_unknown(model, i) || !is_unknown(model, j)) return;
  const auto add = [&A](int row, int column, const Mat3& K) { A.block(A.slot(row, column)) += K; };
  // A bone's point moves by δp − [r]× δθ, and its force turns the bone by [r]× f.
  add(i.block, j.block, stiffness);
  Mat3 turned = Mat3::Zero();
  if (j.bone >= 0) {
    turned = -stiffness * skew(configuration.lever(j));
    add(i.block, j.block + 1, turned);
  }
  if (i.bone >= 0) {
    const Mat3 lever = skew(configuration.lever(i));
    add(i.block + 1, j.block, lever * stiffness);
    if (j.bone >= 0) add(i.block + 1, j.block + 1, lever * turned);
  }
}

void add_stiffness(const Model& model, const Configuration& configuration,
                   const std::array<const NodeRef*, 6>& nodes,
                   const Eigen::Matrix<double, 18, 18>& stiffness, fem::BlockMatrix& A) {
  // Column blocks of the gathered matrix: one a free node, two a bone.
  std::array<int, 12> block{};
  std::array<int, 6> place{};  // of a node's first block; -1: it does not move with unknowns
  int count = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const NodeRef& node = *nodes[k];
    place[k] = -1;
    if (!is_unknown(model, node)) continue;
    for (int b = 0; b < count && node.bone >= 0; ++b)
      if (block[static_cast<std::size_t>(b)] == node.block) place[k] = b;
    if (place[k] >= 0) continue;
    place[k] = count;
    block[static_cast<std::size_t>(count++)] = node.block;
    if (node.bone >= 0) block[static_cast<std::size_t>(count++)] = node.block + 1;
  }
  // Right factor J: a bone's node moves by δp − [r]× δθ; then the left factor Jᵀ.
  std::array<Mat3, 6> lever;
  for (std::size_t k = 0; k < 6; ++k)
    if (nodes[k]->bone >= 0 && place[k] >= 0) lever[k] = skew(configuration.lever(*nodes[k]));
  Eigen::Matrix<double, 18, Eigen::Dynamic, Eigen::ColMajor, 18, 36> right(18, 3 * count);
  right.setZero();
  for (std::size_t k = 0; k < 6; ++k) {
    if (place[k] < 0) continue;
    const auto columns = stiffness.middleCols<3>(3 * static_cast<Eigen::Index>(k));
    right.middleCols<3>(3 * place[k]) += columns;
    if (nodes[k]->bone >= 0) right.middleCols<3>(3 * place[k] + 3) -= columns * lever[k];
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 36, 36> both(3 * count,
                                                                                     3 * count);
  both.setZero();
  for (std::size_t k = 0; k < 6; ++k) {
    if (place[k] < 0) continue;
    const auto rows = right.middleRows<3>(3 * static_cast<Eigen::Index>(k));
    both.middleRows<3>(3 * place[k]) += rows;
    if (nodes[k]->bone >= 0) both.middleRows<3>(3 * place[k] + 3) += lever[k] * rows;
  }
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      A.block(A.slot(block[static_cast<std::size_t>(i)], block[static_cast<std::size_t>(j)])) +=
          both.block<3, 3>(3 * i, 3 * j);
}

}  // namespace articular::sim
