#include "sim/contact/contact_pair_state.hpp"

#include <algorithm>

namespace articular::sim {

double group_energy(const ContactPairState& pair_state, int group) {
  if (!pair_state.on_layers.empty())
    return pair_state.energy_density(group) * pair_state.measure[group];
  if (!(pair_state.pressure[group] > 0)) return 0;
  const double damping =
      pair_state.drag.empty() ? 0 : pair_state.drag[static_cast<std::size_t>(group)].pressure;
  return 0.5 * (pair_state.pressure[group] - damping) * std::max(0.0, pair_state.depth[group]) *
         pair_state.measure[group];
}

ContactSides sides_of(const Model& model, const ContactModel& pair) {
  const Collider& a = *model.bodies[static_cast<std::size_t>(pair.a)].collider;
  const Collider& b = *model.bodies[static_cast<std::size_t>(pair.b)].collider;
  return pair.reversed ? ContactSides{b, a, pair.b, pair.a} : ContactSides{a, b, pair.a, pair.b};
}

ContactSides sides_of(const Model& model, const ContactPairState& pair_state) {
  return sides_of(model, pair_state.pair);
}

std::array<const NodeRef*, 6> nodes_of(const Collider& triangles, const Collider& faces,
                                       int triangle, int face) {
  std::array<const NodeRef*, 6> nodes{};
  for (int i = 0; i < 3; ++i) {
    nodes[static_cast<std::size_t>(i)] =
        &triangles.nodes[static_cast<std::size_t>(triangles.surface.faces(i, triangle))];
    nodes[3 + static_cast<std::size_t>(i)] =
        &faces.nodes[static_cast<std::size_t>(faces.surface.faces(i, face))];
  }
  return nodes;
}

bool carries(const ContactPairState& pair_state, int triangle, const Eigen::Matrix3Xi& groups) {
  return pair_state.pressure[groups(0, triangle)] > 0 ||
         pair_state.pressure[groups(1, triangle)] > 0 ||
         pair_state.pressure[groups(2, triangle)] > 0;
}

Mat3 corners_of(const Configuration& configuration, const Collider& collider, int face) {
  Mat3 x;
  for (int i = 0; i < 3; ++i)
    x.col(i) = configuration.position(
        collider.nodes[static_cast<std::size_t>(collider.surface.faces(i, face))]);
  return x;
}

PatchSum mean_depths(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                     const Eigen::Matrix3Xi& groups, const Vec3& p) {
  PatchSum sum{p};
  for (int i = 0; i < 3; ++i)
    sum.m[i] = p[i] * pair_state.depth[groups(i, entry.triangle)] *
               pair_state.measure_slope(groups(i, entry.triangle));
  return sum;
}

PatchSum energy_sum(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                    const Eigen::Matrix3Xi& groups) {
  if (pair_state.point_stiffness > 0) return point_energy(entry.patch, pair_state.point_stiffness);
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = pair_state.penalty(groups(i, entry.triangle));
  PatchSum sum = mean_depths(pair_state, entry, groups, p);
  for (int i = 0; i < 3; ++i) {
    const int group = groups(i, entry.triangle);
    sum.m[i] -= pair_state.energy_density(group) * pair_state.measure_slope(group);
  }
  return sum;
}

double stored_energy(const ContactPairState& pair_state, const Eigen::Matrix3Xi& groups) {
  double energy = 0;
  if (!(pair_state.point_stiffness > 0)) {
    for (const int group : pair_state.groups) energy += group_energy(pair_state, group);
    return energy;
  }
  for (const ContactPairState::Patch& entry : pair_state.patches())
    if (carries(pair_state, entry.triangle, groups))
      energy += value(entry.patch, point_energy(entry.patch, pair_state.point_stiffness));
  return energy;
}

namespace {

PatchSum damping_sum(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                     const Eigen::Matrix3Xi& groups) {
  Vec3 p;
  for (int i = 0; i < 3; ++i)
    p[i] = pair_state.drag[static_cast<std::size_t>(groups(i, entry.triangle))].pressure;
  return mean_depths(pair_state, entry, groups, p);
}

}  // namespace

PatchSum pressure_sum(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                      const Eigen::Matrix3Xi& groups) {
  PatchSum sum = energy_sum(pair_state, entry, groups);
  if (pair_state.drag.empty()) return sum;
  const PatchSum damping = damping_sum(pair_state, entry, groups);
  sum.p += damping.p;
  sum.m += damping.m;
  return sum;
}

namespace {

Vec18 forces_on_nodes(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                      const Eigen::Matrix3Xi& groups) {
  Vec18 forces = -patch_gradient(entry.patch, energy_sum(pair_state, entry, groups));
  if (pair_state.drag.empty()) return forces;
  Mat3 t;
  for (int i = 0; i < 3; ++i)
    t.col(i) = pair_state.drag[static_cast<std::size_t>(groups(i, entry.triangle))].traction;
  return forces - patch_gradient(entry.patch, damping_sum(pair_state, entry, groups)) +
         slip_gradient(entry.patch, t);
}

}  // namespace

void find_forces(const Eigen::Matrix3Xi& groups, ContactPairState& pair_state) {
  for (std::size_t k = 0; k < pair_state.num_patches; ++k) {
    ContactPairState::Patch& entry = pair_state.stored[k];
    if (carries(pair_state, entry.triangle, groups))
      entry.forces = forces_on_nodes(pair_state, entry, groups);
  }
}

}  // namespace articular::sim
