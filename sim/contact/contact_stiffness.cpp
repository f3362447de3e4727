#include "sim/contact/contact_stiffness.hpp"

#include <algorithm>

namespace articular::sim {

ContactStiffness::ContactStiffness(const Model& model) : model_(model), gradient_(model) {}

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

/// A += factor g gᵀ, where g sums gradient(entry) over the patches of these numbers.
template <class Gradient>
void ContactStiffness::add_rank_one(const ContactPairState& pair_state,
                                    std::span<const int> patches,
                                    const Configuration& configuration, double factor,
                                    Gradient&& gradient, fem::BlockMatrix& A) {
  gradient_.gather(pair_state, patches, configuration, gradient);
  for (const int i : gradient_.blocks())
    for (const int j : gradient_.blocks())
      A.block(A.slot(i, j)) += factor * gradient_.at(i) * gradient_.at(j).transpose();
  gradient_.clear();
}

/// One group's columns: `drag` of S, factor times `depth` of G, summed over the patches.
template <class Drag, class Depth>
void ContactStiffness::add_coupling(const ContactPairState& pair_state,
                                    std::span<const int> patches,
                                    const Configuration& configuration, double factor, Drag&& drag,
                                    Depth&& depth, FrictionCoupling& coupling) {
  coupled_.clear();
  gradient_.gather(pair_state, patches, configuration, drag);
  for (const int block : gradient_.blocks())
    coupled_.push_back({block, gradient_.at(block), Vec3::Zero()});
  gradient_.clear();
  gradient_.gather(pair_state, patches, configuration, depth);  // of the same blocks
  for (FrictionCoupling::Entry& entry : coupled_)
    entry.pressure = factor * gradient_.at(entry.block);
  gradient_.clear();
  coupling.add_group(coupled_);
}

/// (e_a − p_a g_a) ∂²A_a/∂W² ∇W ∇Wᵀ; with A = √(W T) and ∂A/∂W the `measure_slope`, ∂²A/∂W²
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
  const double energy = pair_state.energy_density(group) - p * pair_state.depth[group];
  add_rank_one(
      pair_state, patches, configuration,
      -scale * energy * pair_state.measure_slope(group) / (2 * pair_state.area[group]),
      [&](const ContactPairState::Patch& entry) {
        return patch_gradient(entry.patch,
                              {Vec3::Zero(), -corner_of_group(groups, entry.triangle, group)});
      },
      A);
}

/// Σ k_a/A_a (A_a ∇g_a) (A_a ∇g_a)ᵀ with k_a = dp_a/dg_a, the same with the damping, and what
/// friction resists with; how it grows with the pressure, −∂t_a/∂p_a ∇p_aᵀ, is coupling.
void ContactStiffness::add_node_stiffness(const ContactPairState& pair_state,
                                          const Configuration& configuration, fem::Tangent tangent,
                                          const SystemScale& scale, fem::BlockMatrix& A,
                                          FrictionCoupling& coupling) {
  const bool averaged = !(pair_state.point_stiffness > 0);
  if (!averaged && pair_state.drag.empty()) return;
  patches_.find(model_, pair_state);
  const auto& groups = sides_of(model_, pair_state).triangles.groups;
  for (const int a : pair_state.groups) {
    if (!pair_state.presses_in_matrix(a)) continue;
    const std::span<const int> around = patches_.of(a);
    const auto of_depth = [&](const ContactPairState::Patch& entry) {
      return patch_gradient(entry.patch, mean_depths(pair_state, entry, groups,
                                                     corner_of_group(groups, entry.triangle, a)));
    };
    if (averaged && tangent == fem::Tangent::Consistent)
      add_measure_stiffness(pair_state, around, a, configuration, scale.stiffness, A);
    const double penalty = scale.stiffness * pair_state.slope(a) / pair_state.measure[a];
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
