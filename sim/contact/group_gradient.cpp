#include "sim/contact/group_gradient.hpp"

namespace articular::sim {

Vec3 corner_of_group(const Eigen::Matrix3Xi& groups, int triangle, int group) {
  Eigen::Index corner = 0;
  while (groups(corner, triangle) != group) ++corner;
  return Vec3::Unit(corner);
}

void PatchesOfGroups::find(const Model& model, const ContactPairState& pair_state) {
  const ContactSides side = sides_of(model, pair_state);
  const auto& groups = side.triangles.groups;
  begin_.assign(side.triangles.group_node.size() + 2, 0);
  for (const ContactPairState::Patch& entry : pair_state.patches())
    for (const int group : groups.col(entry.triangle))
      ++begin_[static_cast<std::size_t>(group) + 2];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  patch_.resize(3 * pair_state.num_patches);
  for (std::size_t e = 0; e < pair_state.num_patches; ++e)
    for (const int group : groups.col(pair_state.stored[e].triangle))
      patch_[static_cast<std::size_t>(begin_[static_cast<std::size_t>(group) + 1]++)] =
          static_cast<int>(e);
}

GroupGradient::GroupGradient(const Model& model) : model_(model) {
  gradient_.setZero(3, model.num_blocks);
  has_gradient_.assign(static_cast<std::size_t>(model.num_blocks), 0);
}

void GroupGradient::put(int block, const Vec3& part) {
  if (has_gradient_[static_cast<std::size_t>(block)] == 0) {
    has_gradient_[static_cast<std::size_t>(block)] = 1;
    blocks_.push_back(block);
  }
  gradient_.col(block) += part;
}

void GroupGradient::clear() {
  for (const int block : blocks_) {
    gradient_.col(block).setZero();
    has_gradient_[static_cast<std::size_t>(block)] = 0;
  }
  blocks_.clear();
}

}  // namespace articular::sim
