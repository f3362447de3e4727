#include "sim/assembly/turning_stiffness.hpp"

#include <vector>

#include "sim/contact/contact_pair_state.hpp"
#include "sim/lines/line_force.hpp"
#include "sim/loads/gravity.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {
namespace {

/// The sum so far, force by force.
struct Turning {
  const Configuration& now;
  std::vector<Mat3> K;  // of each rigid body that moves

  void add(const WeightedPoint& point, const Vec3& force) {
    for (std::size_t k = 0; k < point.nodes.size(); ++k)
      add(point.nodes[k], point.weights[k] * force);
  }
  void add(const NodeRef& node, const Vec3& force) {
    if (node.rigid >= 0) add(node.rigid, now.lever(node), force);
  }
  void add(int rigid, const Vec3& lever, const Vec3& force) {
    const auto r = static_cast<std::size_t>(rigid);
    if (r >= K.size()) return;  // it is driven or fixed
    const Mat3 product = force * lever.transpose();
    K[r] += product.trace() * Mat3::Identity() - 0.5 * (product + product.transpose());
  }
};

/// Bodies without a hold turn about their centers of mass.
void add_weights_of_held_bodies(const Model& model, const Configuration& now, Turning& turning) {
  const Vec3 acceleration = gravity_at(model, now.t);
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    if (!rigid.hold) continue;
    const Vec3 lever =
        now.poses[static_cast<std::size_t>(r)].R * (rigid.mass.center - rigid.rest.p);
    turning.add(r, lever, rigid.mass.mass * acceleration);
  }
}

void add_contact(const Moment& now, Turning& turning) {
  for (const ContactPairState* pair_state : now.contact.pair_states())
    for_each_patch_that_carries(
        now.model, *pair_state, [&](const auto& nodes, const Vec18& forces) {
          for (std::size_t i = 0; i < nodes.size(); ++i)
            turning.add(*nodes[i], forces.segment<3>(3 * static_cast<Eigen::Index>(i)));
        });
}

}  // namespace

void add_turning_stiffness(const Moment& now, double scale, fem::BlockMatrix& A) {
  const Model& model = now.model;
  const Configuration& configuration = now.configuration;
  const auto num_rigid = static_cast<std::size_t>(model.layout.num_rigid);
  if (num_rigid == 0 || scale == 0) return;
  Turning turning{configuration, std::vector<Mat3>(num_rigid, Mat3::Zero())};
  for (std::size_t l = 0; l < model.lines.size(); ++l)
    for_each_pull(
        path_of(now, l), configuration, now.lines[l].tension,
        [&](const WeightedPoint& point, const Vec3& force) { turning.add(point, force); });
  for (const ForceModel& force : model.forces)
    turning.add(force.point, value_at(force.profile, configuration.t) * force.force);
  add_weights_of_held_bodies(model, configuration, turning);
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    const Tissue& tissue = model.tissues[t];
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      turning.add(tissue.nodes[i], -now.tissues[t].force.col(static_cast<Eigen::Index>(i)));
  }
  add_contact(now, turning);
  for (std::size_t r = 0; r < num_rigid; ++r) {
    const int block = model.rigid_bodies[r].block + 1;
    A.block(A.slot(block, block)) += scale * turning.K[r];
  }
}

}  // namespace articular::sim
