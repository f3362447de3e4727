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

}  // namespace articular::sim
