#include "sim/assembly/reactions.hpp"

#include <utility>

#include "sim/contact/contact_summary.hpp"
#include "sim/model/carried_tissue.hpp"
#include "sim/model/driven_supports.hpp"

namespace articular::sim {
namespace {

Vec6 reaction_of(const Moment& now, int rigid, bool step_begins) {
  const auto b = static_cast<std::size_t>(rigid);
  const RigidBody& held = now.model.rigid_bodies[b];
  const Instant at{now.configuration.t, step_begins};
  if (!held.unknown) {
    Vec6 force = now.forces.segment<6>(3 * held.block);
    if (drives_tissue(now.model, held)) force += inertia_of_carried(held, now.step_start, at);
    return force;
  }
  const Vec6& all = now.rigid_forces[b];
  if (now.model.is_static) return all - free_part(held, all);
  return force_on_hold(held, now.configuration.poses[b], now.configuration.velocities[b], at, all);
}

/// Of each held block, with the inertia of nodes that are driven.
Positions forces_on_holds(const Moment& now) {
  Positions force = now.held_forces;
  const Model& model = now.model;
  if (model.is_static || !has_driven_supports(model)) return force;
  const Positions acceleration = on_held_blocks(
      model, support_accelerations(model, now.step_start, {now.configuration.t, now.begins_step}));
  for (Eigen::Index k = 0; k < force.cols(); ++k) {
    const int block = model.held_blocks[static_cast<std::size_t>(k)].block;
    if (block < model.layout.num_free_nodes)
      force.col(k) -= model.node_mass[block] * acceleration.col(k);
  }
  return force;
}

}  // namespace

Vec6 reaction_of(const Moment& now, int rigid) { return reaction_of(now, rigid, now.begins_step); }

Vec6 reaction_as_step_begins(const Moment& now, int rigid) { return reaction_of(now, rigid, true); }

Vec3 held_force_on_support(const Moment& now, const SupportModel& support) {
  Vec3 force = Vec3::Zero();
  for (const SupportModel::Node& node : support.nodes)
    force += node.share * now.held_forces.col(node.held);
  return force;
}

std::pair<Vec3, Vec3> force_on_support(const Moment& now, const SupportModel& support) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const Positions held = forces_on_holds(now);
  const Tissue& tissue = now.model.tissues[static_cast<std::size_t>(support.tissue)];
  for (const SupportModel::Node& node : support.nodes) {
    const Vec3 part = node.share * held.col(node.held);
    force += part;
    moment += (now.configuration.position(tissue.nodes[static_cast<std::size_t>(node.node)]) -
               support.center)
                  .cross(part);
  }
  return {force, moment};
}

std::pair<Vec3, Vec3> attachment_force(const Moment& now, int tissue, int rigid) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const Tissue& given = now.model.tissues[static_cast<std::size_t>(tissue)];
  // A collider of tissue has the nodes of its mesh, in their order.
  const Positions contact =
      std::move(nodal_contact_forces(now.model, now.contact)[static_cast<std::size_t>(given.body)]);
  for (std::size_t i = 0; i < given.nodes.size(); ++i) {
    const NodeRef& node = given.nodes[i];
    if (node.rigid != rigid) continue;
    const auto column = static_cast<Eigen::Index>(i);
    Vec3 pull = -now.tissues[static_cast<std::size_t>(tissue)].force.col(column);
    if (contact.cols() > 0) pull += contact.col(column);
    force += pull;
    moment += now.configuration.lever(node).cross(pull);
  }
  return {force, moment};
}

}  // namespace articular::sim
