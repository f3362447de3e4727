#include "sim/contact_stiffness.hpp"

#include <Eigen/Geometry>

namespace articular::sim {

ContactStiffness::ContactStiffness(const Model& model) : model_(model) {
  gradient_.setZero(3, model.num_blocks);
  has_gradient_.assign(static_cast<std::size_t>(model.num_blocks), 0);
}

void ContactStiffness::add(const ContactDirection& direction, const Configuration& configuration,
                           fem::Tangent tangent, const SystemScale& scale, fem::BlockMatrix& A) {
  add_node_stiffness(direction, configuration, tangent, scale, A);
  const double k = scale.stiffness * direction.point_stiffness;
  if (tangent != fem::Tangent::Consistent && k == 0) return;
  const ContactSides side = sides_of(model_, direction);
  const auto& triangles = side.triangles.surface.faces;
  for (const ContactDirection::Patch& entry : direction.patches()) {
    if (!carries(direction, entry.triangle, triangles)) continue;
    PatchStiffness stiffness = patch_stiffness(entry.patch, k);
    // Of an average, k = 0, without the turning of w: A_a turns with it too, which the force leaves
    // out. With this part alone the knee in time takes four times as many iterations.
    if (tangent == fem::Tangent::Consistent)
      add_curvature(entry.patch, scale.stiffness * nodal_pressures(direction, entry, triangles),
                    patch_energy(entry.patch, k), stiffness);
    add_product(model_, configuration,
                nodes_of(side.triangles, side.faces, entry.triangle, entry.face), stiffness.left,
                stiffness.right, A);
  }
}

/// The patches around node i: patch_of_node_[patch_begin_[i] .. patch_begin_[i + 1]).
void ContactStiffness::find_patches_of_nodes(const ContactDirection& direction) {
  const ContactSides side = sides_of(model_, direction);
  const auto& triangles = side.triangles.surface.faces;
  patch_begin_.assign(static_cast<std::size_t>(side.triangles.X.cols()) + 2, 0);
  for (const ContactDirection::Patch& entry : direction.patches())
    for (const int node : triangles.col(entry.triangle))
      ++patch_begin_[static_cast<std::size_t>(node) + 2];
  for (std::size_t i = 1; i < patch_begin_.size(); ++i) patch_begin_[i] += patch_begin_[i - 1];
  patch_of_node_.resize(3 * direction.num_patches);
  for (std::size_t e = 0; e < direction.num_patches; ++e)
    for (const int node : triangles.col(direction.stored[e].triangle))
      patch_of_node_[static_cast<std::size_t>(patch_begin_[static_cast<std::size_t>(node) + 1]++)] =
          static_cast<int>(e);
}

/// A += factor g gᵀ, where g sums gradient(patch, place of the node in its triangle) over the
/// patches around a node.
template <class Gradient>
void ContactStiffness::add_rank_one(const ContactDirection& direction, int a,
                                    const Configuration& configuration, double factor,
                                    Gradient&& gradient, fem::BlockMatrix& A) {
  const ContactSides side = sides_of(model_, direction);
  const auto& triangles = side.triangles.surface.faces;
  const auto add = [&](const NodeRef& node, const Vec3& g) {
    if (node.bone >= model_.layout.num_rigid) return;
    const auto put = [&](int block, const Vec3& part) {
      if (has_gradient_[static_cast<std::size_t>(block)] == 0) {
        has_gradient_[static_cast<std::size_t>(block)] = 1;
        blocks_.push_back(block);
      }
      gradient_.col(block) += part;
    };
    put(node.block, g);
    if (node.bone >= 0) put(node.block + 1, configuration.lever(node).cross(g));
  };
  for (int k = patch_begin_[static_cast<std::size_t>(a)];
       k < patch_begin_[static_cast<std::size_t>(a) + 1]; ++k) {
    const ContactDirection::Patch& entry =
        direction.stored[static_cast<std::size_t>(patch_of_node_[static_cast<std::size_t>(k)])];
    int local = 0;
    while (triangles(local, entry.triangle) != a) ++local;
    const Vec18 g = gradient(entry.patch, local);
    const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
    for (std::size_t i = 0; i < 6; ++i)
      add(*nodes[i], g.segment<3>(3 * static_cast<Eigen::Index>(i)));
  }
  for (const int i : blocks_)
    for (const int j : blocks_)
      A.block(A.slot(i, j)) += factor * gradient_.col(i) * gradient_.col(j).transpose();
  for (const int block : blocks_) {
    gradient_.col(block).setZero();
    has_gradient_[static_cast<std::size_t>(block)] = 0;
  }
  blocks_.clear();
}

/// Σ k_a/A_a ∇G_a ∇G_aᵀ, the same with the damping, and −∂t_a/∂V_a.
void ContactStiffness::add_node_stiffness(const ContactDirection& direction,
                                          const Configuration& configuration, fem::Tangent tangent,
                                          const SystemScale& scale, fem::BlockMatrix& A) {
  const bool averaged = !(direction.point_stiffness > 0);
  if (!averaged && direction.drag.empty()) return;
  find_patches_of_nodes(direction);
  const auto of_depth = [](const ContactPatch& patch, int local) {
    return patch_gradient(patch, Vec3::Unit(local));
  };
  for (const int a : direction.nodes) {
    if (!(direction.pressure[a] > 0)) continue;
    const double penalty = scale.stiffness * direction.stiffness(a) / direction.measure[a];
    if (direction.drag.empty()) {
      add_rank_one(direction, a, configuration, penalty, of_depth, A);
      continue;
    }
    const NodalDrag& drag = direction.drag[static_cast<std::size_t>(a)];
    add_rank_one(direction, a, configuration,
                 (averaged ? drag.stiffening * penalty : 0) +
                     scale.damping * drag.damping / direction.measure[a],
                 of_depth, A);
    // Friction grows with the slip ever more slowly: the secant is an upper bound of the tangent.
    const double along = tangent == fem::Tangent::Consistent ? drag.drag_along : drag.drag_across;
    for (const auto& [direction_of_slip, strength] :
         {std::pair(drag.along, along), std::pair(drag.across, drag.drag_across)}) {
      if (!(scale.damping * strength > 0)) continue;
      const Vec3& unit = direction_of_slip;
      add_rank_one(
          direction, a, configuration, scale.damping * strength / direction.area[a],
          [&unit](const ContactPatch& patch, int local) {
            return slip_gradient(patch, unit * Vec3::Unit(local).transpose());
          },
          A);
    }
  }
}

}  // namespace articular::sim
