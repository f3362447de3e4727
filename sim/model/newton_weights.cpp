#include "sim/model/newton_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

constexpr double kActivationTolerance = 1e-4;
/// Of the radius of a rigid body, an element's part in a scene without tissue. Nothing there damps
/// what an iteration leaves in each step: a rod that spins would roll by degrees. An iteration more
/// costs next to nothing.
constexpr double kElementOfRigidBody = 0.01;
/// Of relaxing stress by the shear modulus.
constexpr double kStrainTolerance = 1e-4;

/// Sticking and sliding differ by velocities of this size [m/s]; infinity: no friction.
double least_slip_velocity(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const ContactId kind : model.contacts.kinds())
    if (const SurfaceLaw law = model.contacts[kind].law; law.friction > 0)
      least = std::min(least, law.slip_velocity);
  return least;
}

}  // namespace

double turning_radius(const RigidBody& rigid) {
  return std::sqrt(rigid.mass.inertia.trace() / (2 * rigid.mass.mass));
}

double position_tolerance(const Integrator& integrator, const Model& model) {
  if (integrator.position_tolerance) return *integrator.position_tolerance;
  double size = std::numeric_limits<double>::infinity();
  for (const Tissue& tissue : model.tissues) size = std::min(size, element_size(tissue));
  if (model.tissues.empty())
    for (int r = 0; r < model.layout.num_rigid; ++r)
      size = std::min(size, kElementOfRigidBody *
                                turning_radius(model.rigid_bodies[static_cast<std::size_t>(r)]));
  return integrator.element_tolerance * (std::isfinite(size) ? size : 1);
}

void set_weights(const Model& model, double h, Eigen::Ref<Eigen::VectorXd> weight) {
  const Layout& layout = model.layout;
  const double position = 1 / model.position_tolerance;
  weight.head(3 * layout.num_free_nodes).setConstant(position);
  const double velocity = std::max(position * h, 1 / least_slip_velocity(model));
  weight.segment(layout.velocities(), 3 * layout.num_unknown_blocks()).setConstant(velocity);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    const double size = turning_radius(rigid);
    weight.segment<3>(layout.rigid_p(r)).setConstant(position);
    weight.segment<4>(layout.rigid_q(r)).setConstant(position * size);
    weight.segment<3>(layout.velocities() + 3 * rigid.block + 3).setConstant(velocity * size);
  }
  weight.segment(layout.activations(), layout.num_muscles).setConstant(1 / kActivationTolerance);
  if (layout.num_internal_variables == 0) return;
  // The norm is a mean over all entries: internal variables must not hide what moves.
  weight.head(layout.internal_variables()) *=
      std::sqrt(static_cast<double>(layout.size()) / layout.internal_variables());
  for (const Tissue& tissue : model.tissues) {
    if (!tissue.relaxation) continue;
    weight
        .segment(layout.internal_variables() + tissue.first_internal_variable,
                 tissue.relaxation->num_internal_variables())
        .setConstant(1 / (kStrainTolerance * tissue.shear_modulus));
  }
}

}  // namespace articular::sim
