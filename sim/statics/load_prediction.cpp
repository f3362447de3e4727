#include "sim/statics/load_prediction.hpp"

#include <algorithm>
#include <cmath>

#include "sim/assembly/rigid_body_modes.hpp"

namespace articular::sim {
namespace {

/// The part of the way over which ∂f/∂s is a difference moves nothing farther than this part of an
/// element: small against what bends forces, large against round-off of positions.
constexpr double kSmallMotion = 1e-4;

/// Where something is loose: a damping of this part of the largest stiffness by mass K_ii/m_i keeps
/// it in its place; what is held does not feel it.
constexpr double kLeastSpeed = 1e-8;

/// Rigid bodies on their way: driven ones, wholly or in part, from one pose to another.
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
  }

  /// @param part  of the way, in [0, 1]
  std::vector<Pose> poses(double part) const {
    std::vector<Pose> result = from_;
    for (std::size_t b = 0; b < result.size(); ++b) {
      const Eigen::AngleAxisd turn(to_[b].R * from_[b].R.transpose());
      result[b].p += part * (to_[b].p - from_[b].p);
      result[b].R = Eigen::AngleAxisd(part * turn.angle(), turn.axis()) * from_[b].R;
    }
    return result;
  }

  /// The farthest that a node of a driven rigid body goes [m].
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
    return motion;
  }

  /// Moves tissue that is tied to one driven rigid body alone, and not supported, with it.
  void carry(double part, Eigen::VectorXd& y) const {
    const std::vector<Pose> poses = this->poses(part);
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
};

/// ∂f/∂s at y, s from 0 to 1 on the way, by a difference. Leaves `dynamics` at its far end: what
/// touches without pressure at s = 0 resists there.
Eigen::VectorXd force_rate(const DrivenWay& way, double part, double t, const Eigen::VectorXd& y,
                           Dynamics& dynamics) {
  std::vector<Pose> poses = way.poses(0);
  // Stiff contact holds to a plane what follows a round surface, which then stands off it.
  const Conditions conditions{.contact = {.soft = true}, .driven = &poses};
  dynamics.evaluate(y.data(), t, conditions);
  const Eigen::VectorXd before = dynamics.now().forces;
  Eigen::VectorXd carried = y;
  way.carry(part, carried);
  poses = way.poses(part);
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
