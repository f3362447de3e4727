#include "sim/contact/contact_stiffness.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace articular::sim {
namespace {

/// 1 at the corner of the triangle that belongs to the group, 0 at the others.
Vec3 corner_of_group(const Eigen::Matrix3Xi& groups, int triangle, int group) {
  Eigen::Index corner = 0;
  while (groups(corner, triangle) != group) ++corner;
  return Vec3::Unit(corner);
}

}  // namespace

ContactStiffness::ContactStiffness(const Model& model) : model_(model) {
  gradient_.setZero(3, model.num_blocks);
  has_gradient_.assign(static_cast<std::size_t>(model.num_blocks), 0);
}

void ContactStiffness::add(const ContactPairState& pair_state, const Configuration& configuration,
                           fem::Tangent tangent, const SystemScale& scale, fem::BlockMatrix& A,
                           FrictionCoupling& coupling) {
  add_node_stiffness(pair_state, configuration, tangent, scale, A, coupling);
  const double k = scale.stiffness * pair_state.point_stiffness;
  if (tangent != fem::Tangent::Consistent && k == 0) return;
  const ContactSides side = sides_of(model_, pair_state);
  const auto& groups = side.triangles.groups;
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    if (!carries(pair_state, entry.triangle, groups)) continue;
    PatchStiffness stiffness = patch_stiffness(entry.patch, k);
    const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
    if (tangent != fem::Tangent::Consistent) {
      add_product(model_, configuration, nodes, stiffness.left, stiffness.right, A);
      continue;
    }
    const PatchSum sum = scaled(pressure_sum(pair_state, entry, groups), scale.stiffness);
    add_curvature(entry.patch, sum, stiffness);
    add_product(model_, configuration, nodes, stiffness.left, stiffness.right, A);
    Mat18 H;
    if (!end_stiffness(entry.patch, sum, H)) continue;
    for (const int half : {0, 9}) {
      stiffness = {};
      stiffness.left.leftCols<9>() = 0.5 * H.middleCols<9>(half);
      stiffness.right.leftCols<9>().middleRows<9>(half).setIdentity();
      add_product(model_, configuration, nodes, stiffness.left, stiffness.right, A);
    }
  }
}

/// The patches of group i become patch_of_group_[patch_begin_[i] .. patch_begin_[i + 1]).
void ContactStiffness::find_patches_of_groups(const ContactPairState& pair_state) {
  const ContactSides side = sides_of(model_, pair_state);
  const auto& groups = side.triangles.groups;
  patch_begin_.assign(side.triangles.group_node.size() + 2, 0);
  for (const ContactPairState::Patch& entry : pair_state.patches())
    for (const int group : groups.col(entry.triangle))
      ++patch_begin_[static_cast<std::size_t>(group) + 2];
  for (std::size_t i = 1; i < patch_begin_.size(); ++i) patch_begin_[i] += patch_begin_[i - 1];
  patch_of_group_.resize(3 * pair_state.num_patches);
  for (std::size_t e = 0; e < pair_state.num_patches; ++e)
    for (const int group : groups.col(pair_state.stored[e].triangle))
      patch_of_group_[static_cast<std::size_t>(
          patch_begin_[static_cast<std::size_t>(group) + 1]++)] = static_cast<int>(e);
}

/// gradient_ becomes the sum of gradient(entry) over the patches of these numbers, by blocks_.
template <class Gradient>
void ContactStiffness::gather(const ContactPairState& pair_state, std::span<const int> patches,
                              const Configuration& configuration, Gradient&& gradient) {
  const ContactSides side = sides_of(model_, pair_state);
  const auto add = [&](const NodeRef& node, const Vec3& g) {
    if (node.rigid >= model_.layout.num_rigid) return;
    const auto put = [&](int block, const Vec3& part) {
      if (has_gradient_[static_cast<std::size_t>(block)] == 0) {
        has_gradient_[static_cast<std::size_t>(block)] = 1;
        blocks_.push_back(block);
      }
      gradient_.col(block) += part;
    };
    put(node.block, g);
    if (node.rigid >= 0) put(node.block + 1, configuration.lever(node).cross(g));
  };
  for (const int patch : patches) {
    const ContactPairState::Patch& entry = pair_state.stored[static_cast<std::size_t>(patch)];
    const Vec18 g = gradient(entry);
    const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
    for (std::size_t i = 0; i < 6; ++i)
      add(*nodes[i], g.segment<3>(3 * static_cast<Eigen::Index>(i)));
  }
}

void ContactStiffness::drop_gathered() {
  for (const int block : blocks_) {
    gradient_.col(block).setZero();
    has_gradient_[static_cast<std::size_t>(block)] = 0;
  }
  blocks_.clear();
}

/// A += factor g gᵀ, where g sums gradient(entry) over the patches of these numbers.
template <class Gradient>
void ContactStiffness::add_rank_one(const ContactPairState& pair_state,
                                    std::span<const int> patches,
                                    const Configuration& configuration, double factor,
                                    Gradient&& gradient, fem::BlockMatrix& A) {
  gather(pair_state, patches, configuration, gradient);
  for (const int i : blocks_)
    for (const int j : blocks_)
      A.block(A.slot(i, j)) += factor * gradient_.col(i) * gradient_.col(j).transpose();
  drop_gathered();
}

/// One group's columns: `drag` of S, factor times `depth` of G, summed over the patches.
template <class Drag, class Depth>
void ContactStiffness::add_coupling(const ContactPairState& pair_state,
                                    std::span<const int> patches,
                                    const Configuration& configuration, double factor, Drag&& drag,
                                    Depth&& depth, FrictionCoupling& coupling) {
  coupled_.clear();
  gather(pair_state, patches, configuration, drag);
  for (const int block : blocks_) coupled_.push_back({block, gradient_.col(block), Vec3::Zero()});
  drop_gathered();
  gather(pair_state, patches, configuration, depth);  // of the same blocks
  for (FrictionCoupling::Entry& entry : coupled_)
    entry.pressure = factor * gradient_.col(entry.block);
  drop_gathered();
  coupling.add_group(coupled_);
}

/// (p_a²/2k_a − p_a g_a) ∂²A_a/∂W² ∇W ∇Wᵀ; with A = √(W T) and ∂A/∂W the `measure_slope`, ∂²A/∂W²
/// is −slope/2W. ∇W is not zero where patches end, turn or fade.
void ContactStiffness::add_measure_stiffness(const ContactPairState& pair_state,
                                             std::span<const int> patches, int group,
                                             const Configuration& configuration, double scale,
                                             fem::BlockMatrix& A) {
  const double p = pair_state.penalty(group);
  if (!(p > 0) || std::none_of(patches.begin(), patches.end(), [&](int i) {
        const ContactPatch& patch = pair_state.stored[static_cast<std::size_t>(i)].patch;
        return patch.turning != 0 || patch.fade > 0 || has_end(patch);
      }))
    return;
  const auto& groups = sides_of(model_, pair_state).triangles.groups;
  const double energy = p * p / (2 * pair_state.stiffness(group)) - p * pair_state.depth[group];
  add_rank_one(
      pair_state, patches, configuration,
      -scale * energy * pair_state.measure_slope(group) / (2 * pair_state.area[group]),
      [&](const ContactPairState::Patch& entry) {
        return patch_gradient(entry.patch,
                              {Vec3::Zero(), -corner_of_group(groups, entry.triangle, group)});
      },
      A);
}

/// Σ k_a/A_a (A_a ∇g_a) (A_a ∇g_a)ᵀ, the same with the damping, and what friction resists with; how
/// it grows with the pressure, −∂t_a/∂p_a ∇p_aᵀ, is coupling.
void ContactStiffness::add_node_stiffness(const ContactPairState& pair_state,
                                          const Configuration& configuration, fem::Tangent tangent,
                                          const SystemScale& scale, fem::BlockMatrix& A,
                                          FrictionCoupling& coupling) {
  const bool averaged = !(pair_state.point_stiffness > 0);
  if (!averaged && pair_state.drag.empty()) return;
  find_patches_of_groups(pair_state);
  const auto& groups = sides_of(model_, pair_state).triangles.groups;
  for (const int a : pair_state.groups) {
    if (!(pair_state.pressure[a] > 0)) continue;
    const auto begin = static_cast<std::size_t>(patch_begin_[static_cast<std::size_t>(a)]);
    const auto end = static_cast<std::size_t>(patch_begin_[static_cast<std::size_t>(a) + 1]);
    const std::span<const int> around(patch_of_group_.data() + begin, end - begin);
    const auto of_depth = [&](const ContactPairState::Patch& entry) {
      return patch_gradient(entry.patch, mean_depths(pair_state, entry, groups,
                                                     corner_of_group(groups, entry.triangle, a)));
    };
    if (averaged && tangent == fem::Tangent::Consistent)
      add_measure_stiffness(pair_state, around, a, configuration, scale.stiffness, A);
    const double penalty = scale.stiffness * pair_state.stiffness(a) / pair_state.measure[a];
    if (pair_state.drag.empty()) {
      add_rank_one(pair_state, around, configuration, penalty, of_depth, A);
      continue;
    }
    const NodalDrag& drag = pair_state.drag[static_cast<std::size_t>(a)];
    const double stiffening = drag.stiffening * penalty;
    const double damping = scale.damping * drag.damping / pair_state.measure[a];
    add_rank_one(pair_state, around, configuration, (averaged ? stiffening : 0) + damping, of_depth,
                 A);
    const auto of_slip = [&](const Vec3& t) {
      return [&, t](const ContactPairState::Patch& entry) {
        return slip_gradient(entry.patch,
                             t * corner_of_group(groups, entry.triangle, a).transpose());
      };
    };
    for (const auto& [axis, strength] :
         {std::pair(drag.along, drag.drag_along), std::pair(drag.across, drag.drag_across)})
      if (scale.damping * strength > 0)
        add_rank_one(pair_state, around, configuration,
                     scale.damping * strength / pair_state.area[a], of_slip(axis), A);
    if (!drag.traction.isZero(0))
      add_coupling(pair_state, around, configuration, stiffening + damping,
                   of_slip(-drag.traction / pair_state.pressure[a]), of_depth, coupling);
  }
}

}  // namespace articular::sim
