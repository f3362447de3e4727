#pragma once

#include "sim/model/model.hpp"

namespace articular::sim {

/// Positions and velocities of everything at one moment, read from the state vector.
struct Configuration {
  double t = 0;
  Positions x, v;                         // free nodes, by block
  std::vector<Pose> poses;                // rigid bodies
  std::vector<RigidVelocity> velocities;  // rigid bodies
  Eigen::VectorXd activation;

  /// From the rigid body's reference point to the node [m].
  Vec3 lever(const NodeRef& node) const {
    return poses[static_cast<std::size_t>(node.rigid)].R * node.local;
  }
  Vec3 position(const NodeRef& node) const {
    if (node.rigid < 0) return x.col(node.block);
    return poses[static_cast<std::size_t>(node.rigid)].p + lever(node);
  }
  Vec3 velocity(const NodeRef& node) const {
    if (node.rigid < 0) return v.col(node.block);
    const RigidVelocity& rigid = velocities[static_cast<std::size_t>(node.rigid)];
    return rigid.linear + rigid.angular.cross(lever(node));
  }
  Vec3 position(const WeightedPoint& point) const;
  Vec3 velocity(const WeightedPoint& point) const;
};

/// @param y  in the order of Layout; quaternions need not be of unit length
void read_state(const Model& model, const double* y, double t, Configuration& configuration);

/// What a motion adds to a held rigid body at a time: a shift, and the turn that the rigid body
/// makes before that of its free freedoms, whose axes stand in space.
Pose drive_of(const RigidBody& rigid, double t);
inline Pose with_drive(const Pose& free, const Pose& drive) {
  return {free.p + drive.p, free.R * drive.R};
}

/// Everything moved on with its velocity of now for a time h [s].
Configuration predicted(const Model& model, const Configuration& now, double h);

/// Positions of a list of nodes, one a column.
void positions_of(const Configuration& configuration, const std::vector<NodeRef>& nodes,
                  Positions& x);

/// About the centre of mass, in the world frame [kg m²].
Mat3 world_inertia(const Model& model, const Configuration& configuration, int rigid);

void velocities_of(const Configuration& configuration, const std::vector<NodeRef>& nodes,
                   Positions& v);

/// Adds a force at a node to block forces: 3 entries a block, a rigid body's moment about its
/// reference point.
inline void add_force(const Configuration& configuration, const NodeRef& node, const Vec3& force,
                      Eigen::VectorXd& f) {
  f.segment<3>(3 * node.block) += force;
  if (node.rigid >= 0) f.segment<3>(3 * node.block + 3) += configuration.lever(node).cross(force);
}
void add_force(const Configuration& configuration, const WeightedPoint& point, const Vec3& force,
               Eigen::VectorXd& f);

}  // namespace articular::sim
