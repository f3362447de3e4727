#include "sim/assembly/contact_imbalance.hpp"

#include <algorithm>

#include "sim/model/newton_weights.hpp"

namespace articular::sim {
namespace {

/// What may remain: of the forces between the bodies, and of what would move a free one by the
/// tolerance in a step.
constexpr double kPartOfContact = 1e-3, kPartOfTolerance = 1e-3;

}  // namespace

double contact_imbalance(const Model& model, const Dynamics& dynamics,
                         const Eigen::VectorXd& residual, double gamma) {
  if (!dynamics.now().contact.has_patches()) return 0;
  const std::vector<double>& contact = dynamics.now().contact.force_on_bodies();
  const auto ratio = [&](double left, int body, double mass) {
    const double touching = contact[static_cast<std::size_t>(body)];
    if (touching == 0) return 0.0;
    const double drift = mass * model.position_tolerance / (gamma * gamma);
    return left / gamma / std::max(kPartOfContact * touching, kPartOfTolerance * drift);
  };
  double largest = 0;
  for (const Tissue& tissue : model.tissues) {
    Vec3 left = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      if (tissue.nodes[i].rigid >= 0) continue;
      left += residual.segment<3>(3 * tissue.nodes[i].block);
      mass += tissue.lumped_mass[static_cast<Eigen::Index>(i)];
    }
    largest = std::max(largest, ratio(left.norm(), tissue.body, mass));
  }
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    const double force = residual.segment<3>(3 * rigid.block).norm();
    const double moment = residual.segment<3>(3 * rigid.block + 3).norm();
    largest = std::max(largest, ratio(std::max(force, moment / turning_radius(rigid)), rigid.body,
                                      rigid.mass.mass));
  }
  return largest;
}

}  // namespace articular::sim
