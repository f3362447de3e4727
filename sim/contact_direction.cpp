#include "sim/contact_direction.hpp"

namespace articular::sim {

ContactSides sides_of(const Model& model, int contact) {
  const ContactModel& pair = model.contacts[static_cast<std::size_t>(contact)];
  const Collider& a = *model.bodies[static_cast<std::size_t>(pair.a)].collider;
  const Collider& b = *model.bodies[static_cast<std::size_t>(pair.b)].collider;
  return pair.reversed ? ContactSides{b, a, pair.b, pair.a} : ContactSides{a, b, pair.a, pair.b};
}

ContactSides sides_of(const Model& model, const ContactDirection& direction) {
  return sides_of(model, direction.contact);
}

std::array<const NodeRef*, 6> nodes_of(const Collider& triangles, const Collider& faces,
                                       int triangle, int face) {
  std::array<const NodeRef*, 6> nodes{};
  for (int i = 0; i < 3; ++i) {
    nodes[static_cast<std::size_t>(i)] =
        &triangles.nodes[static_cast<std::size_t>(triangles.surface.faces(i, triangle))];
    nodes[static_cast<std::size_t>(3 + i)] =
        &faces.nodes[static_cast<std::size_t>(faces.surface.faces(i, face))];
  }
  return nodes;
}

bool carries(const ContactDirection& direction, int triangle, const Eigen::Matrix3Xi& sheets) {
  return direction.pressure[sheets(0, triangle)] > 0 ||
         direction.pressure[sheets(1, triangle)] > 0 || direction.pressure[sheets(2, triangle)] > 0;
}

Mat3 corners_of(const Configuration& configuration, const Collider& collider, int face) {
  Mat3 x;
  for (int i = 0; i < 3; ++i)
    x.col(i) = configuration.position(
        collider.nodes[static_cast<std::size_t>(collider.surface.faces(i, face))]);
  return x;
}

Vec3 nodal_pressures(const ContactDirection& direction, const ContactDirection::Patch& entry,
                     const Eigen::Matrix3Xi& sheets) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) {
    const int sheet = sheets(i, entry.triangle);
    p[i] = direction.pressure[sheet];
    if (!(direction.point_stiffness > 0)) continue;
    p[i] = direction.point_stiffness * entry.patch.depth[i];
    if (!direction.drag.empty()) p[i] += direction.drag[static_cast<std::size_t>(sheet)].pressure;
  }
  return p;
}

PatchSum mean_depths(const ContactDirection& direction, const ContactDirection::Patch& entry,
                     const Eigen::Matrix3Xi& sheets, const Vec3& p) {
  PatchSum sum{p};
  for (int i = 0; i < 3; ++i)
    sum.m[i] = p[i] * direction.depth[sheets(i, entry.triangle)] * entry.measure_slope[i];
  return sum;
}

PatchSum energy_sum(const ContactDirection& direction, const ContactDirection::Patch& entry,
                    const Eigen::Matrix3Xi& sheets) {
  if (direction.point_stiffness > 0) return point_energy(entry.patch, direction.point_stiffness);
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = direction.penalty(sheets(i, entry.triangle));
  PatchSum sum = mean_depths(direction, entry, sheets, p);
  for (int i = 0; i < 3; ++i)
    sum.m[i] -=
        p[i] * p[i] / (2 * direction.stiffness(sheets(i, entry.triangle))) * entry.measure_slope[i];
  return sum;
}

namespace {

PatchSum damping_sum(const ContactDirection& direction, const ContactDirection::Patch& entry,
                     const Eigen::Matrix3Xi& sheets) {
  Vec3 p;
  for (int i = 0; i < 3; ++i)
    p[i] = direction.drag[static_cast<std::size_t>(sheets(i, entry.triangle))].pressure;
  return mean_depths(direction, entry, sheets, p);
}

}  // namespace

PatchSum pressure_sum(const ContactDirection& direction, const ContactDirection::Patch& entry,
                      const Eigen::Matrix3Xi& sheets) {
  PatchSum sum = energy_sum(direction, entry, sheets);
  if (direction.drag.empty()) return sum;
  const PatchSum damping = damping_sum(direction, entry, sheets);
  sum.p += damping.p;
  sum.m += damping.m;
  return sum;
}

Vec18 forces_on_nodes(const ContactDirection& direction, const ContactDirection::Patch& entry,
                      const Eigen::Matrix3Xi& sheets) {
  const Vec18 forces = -patch_gradient(entry.patch, energy_sum(direction, entry, sheets));
  if (direction.drag.empty()) return forces;
  Mat3 t;
  for (int i = 0; i < 3; ++i)
    t.col(i) = direction.drag[static_cast<std::size_t>(sheets(i, entry.triangle))].traction;
  return forces - patch_gradient(entry.patch, damping_sum(direction, entry, sheets)) +
         slip_gradient(entry.patch, t);
}

}  // namespace articular::sim
