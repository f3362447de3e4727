#include "sim/assembly/energies.hpp"

#include <numeric>
#include <vector>

#include "sim/assembly/side_by_side.hpp"
#include "sim/loads/gravity.hpp"
#include "sim/model/carried_tissue.hpp"

namespace articular::sim {

double kinetic_energy(const Moment& now) {
  const Model& model = now.model;
  double energy = 0;
  for (int block = 0; block < model.layout.num_free_nodes; ++block) {
    energy += 0.5 * model.node_mass[block] * now.configuration.v.col(block).squaredNorm();
  }
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const auto b = static_cast<std::size_t>(r);
    const RigidVelocity& velocity = now.configuration.velocities[b];
    const RigidBody& rigid = model.rigid_bodies[b];
    if (rigid.hold) {
      Vec6 both;
      both << velocity.linear, velocity.angular;
      energy += 0.5 * both.dot(rigid_mass(rigid, now.configuration.poses[b]) * both);
      continue;
    }
    energy += 0.5 * rigid.mass.mass * velocity.linear.squaredNorm();
    energy +=
        0.5 * velocity.angular.dot(world_inertia(model, now.configuration, r) * velocity.angular);
  }
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b)
    if (drives_tissue(model, model.rigid_bodies[b]))
      energy += carried_kinetic_energy(model.rigid_bodies[b], now.configuration.poses[b],
                                       now.configuration.velocities[b]);
  return energy;
}

double elastic_energy(const Moment& now) {
  const Model& model = now.model;
  const auto activation = [&](std::size_t t) {
    return activation_of(model.tissues[t], now.configuration);
  };
  std::vector<double> of_elements(now.tissues.size());
  for_each_tissue(model, [&](std::size_t t) {
    of_elements[t] = model.tissues[t].elements.energy(now.tissues[t].x, activation(t));
  });
  double energy = std::accumulate(of_elements.begin(), of_elements.end(), 0.0);
  for (std::size_t t = 0; t < now.tissues.size(); ++t)
    for (const SheetModel& sheet : model.tissues[t].sheets)
      energy += sheet.fibres.energy(now.tissues[t].x);
  if (model.is_static)
    for (std::size_t t = 0; t < now.tissues.size(); ++t)
      if (const auto& relaxation = model.tissues[t].relaxation)
        energy += relaxation->settled_energy(now.tissues[t].x, activation(t));
  return energy;
}

double gravity_energy(const Moment& now) {
  return weight_energy(now.model, now.configuration, steady_gravity(now.model));
}

double weight_energy(const Model& model, const Configuration& now, const Vec3& gravity) {
  double energy = 0;
  for (const Tissue& tissue : model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (carries_own_weight(model, tissue.nodes[i]))
        energy -= tissue.lumped_mass[static_cast<Eigen::Index>(i)] *
                  gravity.dot(now.position(tissue.nodes[i]));
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    const Pose& pose = now.poses[static_cast<std::size_t>(r)];
    const Vec3 center = pose.p + pose.R * (rigid.mass.center - rigid.rest.p);
    energy -= rigid.mass.mass * gravity.dot(center);
  }
  return energy;
}

double energy_per_activation(const Moment& now, std::size_t tissue) {
  const TissueElements& elements = now.model.tissues[tissue].elements;
  return elements.energy(now.tissues[tissue].x, 1) - elements.energy(now.tissues[tissue].x, 0);
}

}  // namespace articular::sim
