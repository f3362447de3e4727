#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "sim/contact/contact_pair_state.hpp"

/// What patches sum to around one smoothing group, by blocks of unknowns.
namespace articular::sim {

/// 1 at the corner of the triangle that belongs to the group, 0 at the others.
Vec3 corner_of_group(const Eigen::Matrix3Xi& groups, int triangle, int group);

/// The patches around each smoothing group of a pair state.
class PatchesOfGroups {
 public:
  void find(const Model& model, const ContactPairState& pair_state);
  /// Indices into the pair state's patches.
  std::span<const int> of(int group) const {
    const auto begin = static_cast<std::size_t>(begin_[static_cast<std::size_t>(group)]);
    const auto end = static_cast<std::size_t>(begin_[static_cast<std::size_t>(group) + 1]);
    return {patch_.data() + begin, end - begin};
  }

 private:
  std::vector<int> begin_, patch_;
};

/// One sum of patches at a time; its memory serves the next.
class GroupGradient {
 public:
  explicit GroupGradient(const Model& model);

  /// Sums gradient(entry), a Vec18 by the patch's six nodes, over the patches of these numbers.
  /// Rigid bodies have it as a force at the node, with the moment of that about their origin; what
  /// can't move has none.
  template <class OfPatch>
  void gather(const ContactPairState& pair_state, std::span<const int> patches,
              const Configuration& configuration, OfPatch&& gradient);
  /// Where it is not nothing, in no order.
  std::span<const int> blocks() const { return blocks_; }
  auto at(int block) const { return gradient_.col(block); }
  void clear();

 private:
  void put(int block, const Vec3& part);

  const Model& model_;
  Positions gradient_;
  std::vector<int> blocks_;
  std::vector<char> has_gradient_;
};

template <class OfPatch>
void GroupGradient::gather(const ContactPairState& pair_state, std::span<const int> patches,
                           const Configuration& configuration, OfPatch&& gradient) {
  const ContactSides side = sides_of(model_, pair_state);
  for (const int patch : patches) {
    const ContactPairState::Patch& entry = pair_state.stored[static_cast<std::size_t>(patch)];
    const Vec18 g = gradient(entry);
    const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
    for (std::size_t i = 0; i < 6; ++i) {
      const NodeRef& node = *nodes[i];
      if (node.rigid >= model_.layout.num_rigid) continue;
      const Vec3 part = g.segment<3>(3 * static_cast<Eigen::Index>(i));
      put(node.block, part);
      if (node.rigid >= 0) put(node.block + 1, configuration.lever(node).cross(part));
    }
  }
}

}  // namespace articular::sim
