#include "sim/assembly/body_imbalance.hpp"

#include <algorithm>

#include "sim/model/newton_weights.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// What may remain: of the forces between the bodies, and of what would move a free one by the
/// tolerance in a step.
constexpr double kPartOfContact = 1e-3, kPartOfTolerance = 1e-3;

}  // namespace

double body_imbalance(const Model& model, const Dynamics& dynamics, const Eigen::VectorXd& residual,
                      double gamma) {
  const std::vector<double>& contact = dynamics.now().contact.force_on_bodies();
  const auto touch = [&](int body) { return contact[static_cast<std::size_t>(body)]; };
  const auto ratio = [&](double left, int body, double mass) {
    const double touching = touch(body);
    const double drift = mass * model.position_tolerance / (gamma * gamma);
    return left / gamma / std::max(kPartOfContact * touching, kPartOfTolerance * drift);
  };
  double largest = 0;
  for (const Tissue& tissue : model.tissues) {
    if (touch(tissue.body) == 0 && is_tied(tissue)) continue;
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
    const double moment =
        touch(rigid.body) == 0 ? 0 : residual.segment<3>(3 * rigid.block + 3).norm();
    largest = std::max(largest, ratio(std::max(force, moment / turning_radius(rigid)), rigid.body,
                                      rigid.mass.mass));
  }
  return largest;
}

}  // namespace articular::sim
