#include "sim/model/held_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace articular::sim {

void keep_free_part(const Model& model, Eigen::VectorXd& blocks) {
  for (const HeldBlock& held : model.held_blocks) {
    auto own = blocks.segment<3>(3 * held.block);
    own = (held.free * own).eval();
  }
}

void keep_free_part(const Model& model, fem::BlockMatrix& A) {
  for (const auto& [row, P] : model.held_blocks) {
    Eigen::Map<Mat3> own = A.block(A.slot(row, row));
    const double whole = own.trace();
    for (int s = A.row_begin()[static_cast<std::size_t>(row)];
         s < A.row_begin()[static_cast<std::size_t>(row) + 1]; ++s) {
      const int transposed = A.slot(A.column()[static_cast<std::size_t>(s)], row);
      A.block(s) = (P * A.block(s)).eval();
      A.block(transposed) = (A.block(transposed) * P).eval();
    }
    // Of the size of the others, for the solver's sake: their solution is 0 in any case.
    const double size = own.trace() > 0 ? own.trace() : whole;
    own += (size > 0 ? size : 1) * (Mat3::Identity() - P);
  }
}

void keep_free_part(const Model& model, fem::PressureGradient& G) {
  for (const HeldBlock& held : model.held_blocks) {
    const auto row = static_cast<std::size_t>(held.block);
    for (int s = G.row_begin()[row]; s < G.row_begin()[row + 1]; ++s)
      G.block(s) = (held.free * G.block(s)).eval();
  }
}

int num_held_freedoms(const Model& model, const Tissue& tissue) {
  double held = 0;
  for (const NodeRef& node : tissue.nodes) {
    if (node.rigid >= 0) continue;
    const auto block = std::lower_bound(
        model.held_blocks.begin(), model.held_blocks.end(), node.block,
        [](const HeldBlock& candidate, int wanted) { return candidate.block < wanted; });
    if (block != model.held_blocks.end() && block->block == node.block)
      held += 3 - block->free.trace();
  }
  return static_cast<int>(std::lround(held));
}

}  // namespace articular::sim
