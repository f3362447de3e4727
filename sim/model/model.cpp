#include "sim/model/model.hpp"

#include <Eigen/Geometry>

#include "sim/scenario/curve.hpp"

namespace articular::sim {
namespace {

/// The only rigid body that a tissue's nodes are tied to; none without, or with several.
const RigidBody* sole_carrier(const Model& model, const Tissue& tissue) {
  int carrier = -1;
  for (const NodeRef& node : tissue.nodes) {
    if (node.rigid < 0 || node.rigid == carrier) continue;
    if (carrier >= 0) return nullptr;
    carrier = node.rigid;
  }
  return carrier < 0 ? nullptr : &model.rigid_bodies[static_cast<std::size_t>(carrier)];
}

/// What is told no velocity and hangs on one body begins to move with it.
Vec3 start_velocity(const Tissue& tissue, const RigidBody* carrier, const Vec3& x) {
  if (!carrier || !tissue.start_velocity.isZero(0)) return tissue.start_velocity;
  return carrier->start.linear + carrier->start.angular.cross(x - carrier->rest.p);
}

}  // namespace

double steady_activation(const MuscleModel& muscle, double t) {
  return muscle.given.excitation.time.empty() ? 0 : value_at(muscle.given.excitation, t);
}

Eigen::VectorXd initial_state(const Model& model) {
  const Layout& layout = model.layout;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(layout.size());
  for (const Tissue& tissue : model.tissues) {
    const RigidBody* const carrier = sole_carrier(model, tissue);
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const NodeRef& node = tissue.nodes[i];
      if (node.rigid >= 0) continue;
      const Vec3 x = tissue.X.col(static_cast<Eigen::Index>(i));
      y.segment<3>(layout.node_x(node.block)) = x;
      y.segment<3>(layout.velocities() + 3 * node.block) = start_velocity(tissue, carrier, x);
    }
  }
  for (const HeldBlock& held : model.held_blocks)
    if (held.block < layout.num_free_nodes) {
      auto v = y.segment<3>(layout.velocities() + 3 * held.block);
      v = (held.free * v).eval();
    }
  for (int r = 0; r < layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    y.segment<3>(layout.rigid_p(r)) = rigid.rest.p;
    y[layout.rigid_q(r)] = 1;
    y.segment<3>(layout.velocities() + 3 * rigid.block) = rigid.start.linear;
    y.segment<3>(layout.velocities() + 3 * rigid.block + 3) = rigid.start.angular;
  }
  for (int m = 0; m < layout.num_muscles; ++m) {
    const Curve& excitation = model.muscles[static_cast<std::size_t>(m)].given.excitation;
    y[layout.activations() + m] = excitation.time.empty() ? 0 : value_at(excitation, 0);
  }
  return y;
}

Positions start_positions(const Model& model, const BodyModel& body) {
  if (body.tissue >= 0) return model.tissues[static_cast<std::size_t>(body.tissue)].X;
  return body.X.colwise() + model.rigid_bodies[static_cast<std::size_t>(body.rigid)].rest.p;
}

bool has_friction(const Model& model) {
  return model.contacts.any([](const ContactModel& contact) { return contact.law.friction > 0; });
}

}  // namespace articular::sim
