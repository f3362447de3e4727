#include "sim/newton_weights.hpp"

#include <cmath>

namespace articular::sim {
namespace {

constexpr double kActivationTolerance = 1e-4;

}  // namespace

double turning_radius(const Bone& bone) {
  return std::sqrt(bone.mass.inertia.trace() / (2 * bone.mass.mass));
}

void set_weights(const Model& model, double h, Eigen::Ref<Eigen::VectorXd> weight) {
  const Layout& layout = model.layout;
  const double position = 1 / model.scenario.integrator.position_tolerance;
  weight.head(3 * layout.num_free_nodes).setConstant(position);
  weight.segment(layout.velocities(), 3 * layout.num_unknown_blocks()).setConstant(position * h);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const Bone& bone = model.bones[static_cast<std::size_t>(r)];
    const double size = turning_radius(bone);
    weight.segment<3>(layout.bone_p(r)).setConstant(position);
    weight.segment<4>(layout.bone_q(r)).setConstant(position * size);
    weight.segment<3>(layout.velocities() + 3 * bone.block + 3).setConstant(position * size * h);
  }
  weight.tail(layout.num_muscles).setConstant(1 / kActivationTolerance);
}

}  // namespace articular::sim
