#include "sim/statics/load_prediction.hpp"

#include <algorithm>
#include <cmath>

#include "sim/assembly/rigid_body_modes.hpp"
#include "sim/model/driven_supports.hpp"

namespace articular::sim {
namespace {

/// The part of the way over which ∂f/∂s is a difference moves nothing farther than this part of an
/// element: small against what bends forces, large against round-off of positions.
constexpr double kSmallMotion = 1e-4;

/// Where something is loose: a damping of this part of the largest stiffness by mass K_ii/m_i keeps
/// it in its place; what is held does not feel it.
constexpr double kLeastSpeed = 1e-8;

/// What is driven on its way: rigid bodies, wholly or in part, and supports.
class DrivenWay {
 public:
  /// @param y  at t_before: what the free freedoms of held rigid bodies keep on the way
  DrivenWay(const Model& model, double t_before, double t, const Eigen::VectorXd& y)
      : model_(model) {
    Configuration from, to;
    read_state(model, y.data(), t_before, from);
    read_state(model, y.data(), t, to);
    from_ = from.poses;
    to_ = to.poses;
    shift_from_ = support_shifts(model, t_before);
    shift_ = support_shifts(model, t);
    for (std::size_t s = 0; s < shift_.size(); ++s) shift_[s] -= shift_from_[s];
  }

  /// @param part  of the way, in [0, 1]
  DrivenPlaces places(double part) const {
    DrivenPlaces result{from_, shift_from_};
    for (std::size_t b = 0; b < from_.size(); ++b) {
      Pose& pose = result.poses[b];
      const Eigen::AngleAxisd turn(to_[b].R * from_[b].R.transpose());
      pose.p += part * (to_[b].p - from_[b].p);
      pose.R = Eigen::AngleAxisd(part * turn.angle(), turn.axis()) * from_[b].R;
    }
    for (std::size_t s = 0; s < shift_.size(); ++s) result.shifts[s] += part * shift_[s];
    return result;
  }

  /// The farthest that a node goes which is driven [m].
  double motion() const {
    double motion = 0;
    const auto look_at = [&](const std::vector<NodeRef>& nodes) {
      for (const NodeRef& node : nodes) {
        if (node.rigid < 0) continue;
        const auto b = static_cast<std::size_t>(node.rigid);
        const Vec3 way = to_[b].p - from_[b].p + (to_[b].R - from_[b].R) * node.local;
        motion = std::max(motion, way.norm());
      }
    };
    for (const Tissue& tissue : model_.tissues) look_at(tissue.nodes);
    for (const BodyModel& body : model_.bodies)
      if (body.collider) look_at(body.collider->nodes);
    const Positions ways = on_held_blocks(model_, shift_);
    for (Eigen::Index k = 0; k < ways.cols(); ++k) motion = std::max(motion, ways.col(k).norm());
    return motion;
  }

  /// Moves tissue that is tied to one driven rigid body alone, and not supported, with it.
  void carry(double part, Eigen::VectorXd& y) const {
    const std::vector<Pose> poses = places(part).poses;
    for (const Tissue& tissue : model_.tissues) {
      const int rigid = is_supported(tissue) ? -1 : only_rigid_body(tissue);
      if (rigid < 0 || !model_.rigid_bodies[static_cast<std::size_t>(rigid)].motion) continue;
      const Pose &a = from_[static_cast<std::size_t>(rigid)],
                 &b = poses[static_cast<std::size_t>(rigid)];
      for (const NodeRef& node : tissue.nodes) {
        if (node.rigid >= 0) continue;
        auto x = y.segment<3>(model_.layout.node_x(node.block));
        x = b.p + b.R * a.R.transpose() * (x - a.p);
      }
    }
  }

 private:
  /// The rigid body that all tied nodes of a tissue are tied to; -1: none or several.
  static int only_rigid_body(const Tissue& tissue) {
    int rigid = -1;
    for (const NodeRef& node : tissue.nodes) {
      if (node.rigid < 0 || node.rigid == rigid) continue;
      if (rigid >= 0) return -1;
      rigid = node.rigid;
    }
    return rigid;
  }

  bool is_supported(const Tissue& tissue) const {
    return std::any_of(
        model_.supports.begin(), model_.supports.end(), [&](const SupportModel& support) {
          return &model_.tissues[static_cast<std::size_t>(support.tissue)] == &tissue;
        });
  }

  const Model& model_;
  std::vector<Pose> from_, to_;
  std::vector<Vec3> shift_from_, shift_;  // the way [m]
};

/// ∂f/∂s at y, s from 0 to 1 on the way, by a difference. Leaves `dynamics` at its far end: what
/// touches without pressure at s = 0 resists there.
Eigen::VectorXd force_rate(const DrivenWay& way, double part, double t, const Eigen::VectorXd& y,
                           Dynamics& dynamics) {
  DrivenPlaces places = way.places(0);
  // Stiff contact holds to a plane what follows a round surface, which then stands off it.
  const Conditions conditions{.contact = {.soft = true}, .driven = &places};
  dynamics.evaluate(y.data(), t, conditions);
  const Eigen::VectorXd before = dynamics.now().forces;
  Eigen::VectorXd carried = y;
  way.carry(part, carried);
  places = way.places(part);
  dynamics.evaluate(carried.data(), t, conditions);
  return (dynamics.now().forces - before) / part;
}

}  // namespace

double fastest_rate(const Model& model, Dynamics& dynamics) {
  const fem::BlockMatrix& K = dynamics.assemble({0, 0, 1}, fem::Tangent::Consistent).A;
  double fastest = 0;
  for (int block = 0; block < model.layout.num_free_nodes; ++block)
    fastest = std::max(
        fastest, K.block(K.slot(block, block)).diagonal().maxCoeff() / model.node_mass[block]);
  return fastest;
}

std::optional<Eigen::VectorXd> predict_load_step(const Model& model, Dynamics& dynamics,
                                                 Equilibrium& equilibrium, double t_before,
                                                 double t, Eigen::VectorXd& y) {
  const DrivenWay way(model, t_before, t, y);
  const double motion = way.motion();
  if (!(motion > 0)) return std::nullopt;
  const double trusted = model.trusted_motion;
  const double part = std::isfinite(trusted) ? std::min(1.0, kSmallMotion * trusted / motion) : 1;
  const Eigen::VectorXd rate = force_rate(way, part, t, y, dynamics);
  const double damping =
      find_rigid_body_mode(model, dynamics) ? kLeastSpeed * fastest_rate(model, dynamics) : 0;
  std::optional<Eigen::VectorXd> predicted = y;
  if (!equilibrium.yield(rate, damping, *predicted)) predicted.reset();
  way.carry(1, y);
  if (predicted) way.carry(1, *predicted);
  return predicted;
}

}  // namespace articular::sim
