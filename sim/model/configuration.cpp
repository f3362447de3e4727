#include "sim/model/configuration.hpp"

#include "sim/model/driven_supports.hpp"

namespace articular::sim {

Vec3 Configuration::position(const WeightedPoint& point) const {
  Vec3 result = Vec3::Zero();
  for (std::size_t k = 0; k < point.nodes.size(); ++k)
    result += point.weights[k] * position(point.nodes[k]);
  return result;
}

Vec3 Configuration::velocity(const WeightedPoint& point) const {
  Vec3 result = Vec3::Zero();
  for (std::size_t k = 0; k < point.nodes.size(); ++k)
    result += point.weights[k] * velocity(point.nodes[k]);
  return result;
}

namespace {

/// In statics nothing has a velocity.
RigidVelocity velocity_of_motion(const Model& model, const RigidBody& rigid, const Pose& rest,
                                 double t) {
  if (model.is_static) return {};
  return driven_velocity(*rigid.motion, rest, t);
}

/// From where its free freedoms took a held rigid body.
void add_drive(const Model& model, const RigidBody& rigid, double t, Pose& pose,
               RigidVelocity& velocity) {
  const RigidVelocity drive = velocity_of_motion(model, rigid, Pose{}, t);
  velocity.linear += drive.linear;
  velocity.angular += pose.R * drive.angular;
  pose = with_drive(pose, drive_of(rigid, t));
}

/// Its free freedoms go on as now, the driven ones by their motion.
Pose held_later(const Model& model, const RigidBody& rigid, const Pose& now,
                const RigidVelocity& velocity, double t, double h) {
  const Pose drive = drive_of(rigid, t);
  const RigidVelocity given = velocity_of_motion(model, rigid, Pose{}, t);
  Pose free{now.p - drive.p, now.R * drive.R.transpose()};
  free.p += h * (velocity.linear - given.linear);
  free.R = rotation_matrix(h * (velocity.angular - free.R * given.angular)) * free.R;
  return with_drive(free, drive_of(rigid, t + h));
}

/// What driven supports do to nodes from t to t + h besides going on as at t.
void add_way_of_supports(const Model& model, double t, double h, Positions& x) {
  std::vector<Vec3> way = support_shifts(model, t + h);
  const std::vector<Vec3> before = support_shifts(model, t),
                          velocity = support_velocities(model, t);
  for (std::size_t s = 0; s < way.size(); ++s) way[s] -= before[s] + h * velocity[s];
  add_to_nodes(model, way, x);
}

}  // namespace

Pose drive_of(const RigidBody& rigid, double t) { return driven_pose(*rigid.motion, Pose{}, t); }

void read_state(const Model& model, const double* y, double t, Configuration& configuration) {
  const Layout& layout = model.layout;
  const auto at = [&](int index) { return Eigen::Map<const Vec3>(y + index); };
  configuration.t = t;
  configuration.x = Eigen::Map<const Positions>(y, 3, layout.num_free_nodes);
  configuration.v = Eigen::Map<const Positions>(y + layout.velocities(), 3, layout.num_free_nodes);
  if (has_driven_supports(model)) {
    add_to_nodes(model, support_shifts(model, t), configuration.x);
    add_to_nodes(model, support_velocities(model, t), configuration.v);
  }
  configuration.poses.resize(model.rigid_bodies.size());
  configuration.velocities.resize(model.rigid_bodies.size());
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const RigidBody& rigid = model.rigid_bodies[b];
    if (rigid.unknown) {
      const auto r = static_cast<int>(b);
      const double* q = y + layout.rigid_q(r);
      configuration.poses[b].p = at(layout.rigid_p(r));
      configuration.poses[b].R =
          Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
      configuration.velocities[b] = {at(layout.velocities() + 3 * rigid.block),
                                     at(layout.velocities() + 3 * rigid.block + 3)};
      if (rigid.motion)
        add_drive(model, rigid, t, configuration.poses[b], configuration.velocities[b]);
    } else if (rigid.motion) {
      configuration.poses[b] = driven_pose(*rigid.motion, rigid.rest, t);
      configuration.velocities[b] = velocity_of_motion(model, rigid, rigid.rest, t);
    } else {
      configuration.poses[b] = rigid.rest;
      configuration.velocities[b] = {};
    }
  }
  configuration.activation =
      Eigen::Map<const Eigen::VectorXd>(y + layout.activations(), layout.num_muscles);
}

Configuration predicted(const Model& model, const Configuration& now, double h) {
  Configuration later = now;
  later.t = now.t + h;
  later.x += h * now.v;
  if (has_driven_supports(model)) add_way_of_supports(model, now.t, h, later.x);
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const RigidBody& rigid = model.rigid_bodies[b];
    if (rigid.motion) {
      later.poses[b] = rigid.unknown
                           ? held_later(model, rigid, now.poses[b], now.velocities[b], now.t, h)
                           : driven_pose(*rigid.motion, rigid.rest, later.t);
    } else if (rigid.unknown) {
      later.poses[b].p += h * now.velocities[b].linear;
      later.poses[b].R = rotation_matrix(h * now.velocities[b].angular) * now.poses[b].R;
    }
  }
  return later;
}

void positions_of(const Configuration& configuration, const std::vector<NodeRef>& nodes,
                  Positions& x) {
  x.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = configuration.position(nodes[i]);
}

Mat3 world_inertia(const Model& model, const Configuration& configuration, int rigid) {
  const Mat3& R = configuration.poses[static_cast<std::size_t>(rigid)].R;
  return R * model.rigid_bodies[static_cast<std::size_t>(rigid)].mass.inertia * R.transpose();
}

void velocities_of(const Configuration& configuration, const std::vector<NodeRef>& nodes,
                   Positions& v) {
  v.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    v.col(static_cast<Eigen::Index>(i)) = configuration.velocity(nodes[i]);
}

void add_force(const Configuration& configuration, const WeightedPoint& point, const Vec3& force,
               Eigen::VectorXd& f) {
  for (std::size_t k = 0; k < point.nodes.size(); ++k)
    add_force(configuration, point.nodes[k], point.weights[k] * force, f);
}

}  // namespace articular::sim
