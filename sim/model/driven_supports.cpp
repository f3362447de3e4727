#include "sim/model/driven_supports.hpp"

#include <algorithm>

namespace articular::sim {
namespace {

Vec3 velocity_of(const SupportModel& support, double t) {
  return driven_velocity(*support.motion, Pose{}, t).linear;
}

/// One vector a support, 0 of those that stand.
template <class Of>
std::vector<Vec3> of_driven(const Model& model, const Of& of) {
  std::vector<Vec3> result(model.supports.size(), Vec3::Zero());
  for (std::size_t s = 0; s < result.size(); ++s)
    if (model.supports[s].motion) result[s] = of(model.supports[s]);
  return result;
}

}  // namespace

bool has_driven_supports(const Model& model) {
  return std::any_of(model.supports.begin(), model.supports.end(),
                     [](const SupportModel& support) { return support.motion.has_value(); });
}

std::vector<Vec3> support_shifts(const Model& model, double t) {
  return of_driven(model, [&](const SupportModel& support) -> Vec3 {
    return driven_pose(*support.motion, Pose{}, t).p;
  });
}

std::vector<Vec3> support_velocities(const Model& model, double t) {
  if (model.is_static) return std::vector<Vec3>(model.supports.size(), Vec3::Zero());
  return of_driven(model, [&](const SupportModel& support) { return velocity_of(support, t); });
}

std::vector<Vec3> support_accelerations(const Model& model, double step_start, Instant at) {
  return of_driven(model, [&](const SupportModel& support) -> Vec3 {
    if (support.motion->interpolation == Motion::Interpolation::Linear && step_start < at.t)
      return (velocity_of(support, at.t) - velocity_of(support, step_start)) / (at.t - step_start);
    return driven_acceleration(*support.motion, at).linear;
  });
}

Positions on_held_blocks(const Model& model, const std::vector<Vec3>& of_supports) {
  Positions result = Positions::Zero(3, static_cast<Eigen::Index>(model.held_blocks.size()));
  for (std::size_t s = 0; s < model.supports.size(); ++s)
    if (model.supports[s].motion)
      for (const SupportModel::Node& node : model.supports[s].nodes)
        result.col(node.held) += node.share.transpose() * of_supports[s];
  return result;
}

void add_to_nodes(const Model& model, const std::vector<Vec3>& of_supports, Positions& of_nodes) {
  const Positions held = on_held_blocks(model, of_supports);
  for (Eigen::Index k = 0; k < held.cols(); ++k) {
    const int block = model.held_blocks[static_cast<std::size_t>(k)].block;
    if (block < model.layout.num_free_nodes) of_nodes.col(block) += held.col(k);
  }
}

double driven_kinetic_energy(const Model& model, double t) {
  const Positions velocity = on_held_blocks(model, support_velocities(model, t));
  double energy = 0;
  for (Eigen::Index k = 0; k < velocity.cols(); ++k) {
    const int block = model.held_blocks[static_cast<std::size_t>(k)].block;
    if (block < model.layout.num_free_nodes)
      energy += 0.5 * model.node_mass[block] * velocity.col(k).squaredNorm();
  }
  return energy;
}

}  // namespace articular::sim
