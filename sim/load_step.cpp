#include "sim/load_step.hpp"

#include <algorithm>
#include <cmath>

#include "sim/free_motion.hpp"

namespace articular::sim {
namespace {

/// Detections in a row without contacts that hold where the solution ends.
constexpr int kMostDetections = 20;
/// Solutions in pseudo-time before the load step is given up.
constexpr int kMostSolutions = 400;
constexpr double kMotionRise = 4, kMotionFall = 0.2;
/// The part of the trusted motion by which what is free moves in the first one.
constexpr double kFirstMotion = 0.25;
/// Where nothing limits the motion (no tissue, no contact) [m].
constexpr double kLooseMotion = 1e-3;

class LoadStep {
 public:
  LoadStep(const Model& model, Dynamics& dynamics, Equilibrium& equilibrium,
           const ContactHooks& contacts, double t_before, double t,
           std::vector<ConvergenceRow>& convergence)
      : model_(model),
        dynamics_(dynamics),
        equilibrium_(equilibrium),
        contacts_(contacts),
        t_before_(t_before),
        t_(t),
        convergence_(convergence),
        reach_(std::isfinite(dynamics.trusted_motion()) ? dynamics.trusted_motion()
                                                        : kLooseMotion) {}

  LoadStepResult take(Eigen::VectorXd& y) {
    carry_along(y);
    look(y, 0);
    LoadStepResult result;
    result.loose = find_free_motion(model_, dynamics_);
    result.reached = !result.loose && balance(y);
    if (!result.reached) settle(y, result);
    return result;
  }

 private:
  /// Tissue that is tied to one driven bone alone begins where that bone would carry it: as
  /// stressed as it was, where the motion of its tied nodes alone would crush the elements next to
  /// them.
  void carry_along(Eigen::VectorXd& y) {
    dynamics_.evaluate(y.data(), t_before_);
    const std::vector<Pose> before = dynamics_.configuration().poses;
    dynamics_.evaluate(y.data(), t_);
    const std::vector<Pose>& after = dynamics_.configuration().poses;
    for (const Tissue& tissue : model_.tissues) {
      const int bone = only_bone(tissue);
      if (bone < model_.layout.num_rigid) continue;
      const Pose& a = before[static_cast<std::size_t>(bone)];
      const Pose& b = after[static_cast<std::size_t>(bone)];
      for (const NodeRef& node : tissue.nodes) {
        if (node.bone >= 0) continue;
        auto x = y.segment<3>(model_.layout.node_x(node.block));
        x = b.p + b.R * a.R.transpose() * (x - a.p);
      }
    }
  }

  /// The bone that all tied nodes of a tissue are tied to; -1: none or several.
  static int only_bone(const Tissue& tissue) {
    int bone = -1;
    for (const NodeRef& node : tissue.nodes) {
      if (node.bone < 0 || node.bone == bone) continue;
      if (bone >= 0) return -1;
      bone = node.bone;
    }
    return bone;
  }

  /// Finds contacts at y, for things that will move so far [m], and evaluates there.
  void look(const Eigen::VectorXd& y, double motion) {
    dynamics_.evaluate(y.data(), t_);
    if (!contacts_.find) return;
    contacts_.find(dynamics_.configuration(), motion);
    dynamics_.evaluate(y.data(), t_);
  }

  bool solve(Eigen::VectorXd& y, double damping) {
    const bool solved = equilibrium_.solve(y, t_, damping);
    int k = 0;
    for (const NewtonIteration& newton : equilibrium_.iterations())
      convergence_.push_back({t_, solution_, damping, k++, newton});
    ++solution_;
    if (solved) dynamics_.evaluate(y.data(), t_);
    return solved;
  }

  /// Without damping, until the contacts hold where it ends.
  bool balance(Eigen::VectorXd& y) {
    Eigen::VectorXd trial = y;
    for (int k = 0; k < kMostDetections; ++k) {
      if (!solve(trial, 0)) return false;
      if (!contacts_.covered || contacts_.covered()) {
        y = trial;
        return true;
      }
      look(trial, 0);
    }
    return false;
  }

  void settle(Eigen::VectorXd& y, LoadStepResult& result) {
    double motion = kFirstMotion * reach_;  // of the node that the forces accelerate most [m]
    for (int k = 0; k < kMostSolutions; ++k) {
      look(y, motion);
      const double damping = equilibrium_.largest_acceleration() / motion;
      Eigen::VectorXd trial = y;
      if (!solve(trial, damping) || (contacts_.covered && !contacts_.covered())) {
        motion *= kMotionFall;
        continue;
      }
      if (result.loose) result.settling_loss += damping * work(y, trial);
      y = trial;
      look(y, 0);
      result.loose = find_free_motion(model_, dynamics_);
      result.reached = equilibrium_.residual() <= 2 * kBalanced * dynamics_.largest_force() ||
                       (!result.loose && balance(y));
      if (result.reached) return;
      motion = std::min(kMotionRise * motion, reach_);
    }
  }

  /// ∫ M (u − u₀)·du over one solution, per damping: ½ u·M u [J s²].
  double work(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
    const Layout& layout = model_.layout;
    double sum = 0;
    for (int block = 0; block < layout.num_free_nodes; ++block) {
      const int row = layout.node_x(block);
      sum +=
          dynamics_.mass_of(block) * (after.segment<3>(row) - before.segment<3>(row)).squaredNorm();
    }
    for (int r = 0; r < layout.num_rigid; ++r) {
      const int row = layout.bone_p(r);
      sum += model_.bones[static_cast<std::size_t>(r)].mass.mass *
             (after.segment<3>(row) - before.segment<3>(row)).squaredNorm();
    }
    return sum;
  }

  const Model& model_;
  Dynamics& dynamics_;
  Equilibrium& equilibrium_;
  const ContactHooks& contacts_;
  double t_before_, t_;
  std::vector<ConvergenceRow>& convergence_;
  double reach_;
  int solution_ = 0;
};

}  // namespace

LoadStepResult take_load_step(const Model& model, Dynamics& dynamics, Equilibrium& equilibrium,
                              const ContactHooks& contacts, double t_before, double t,
                              Eigen::VectorXd& y, std::vector<ConvergenceRow>& convergence) {
  return LoadStep(model, dynamics, equilibrium, contacts, t_before, t, convergence).take(y);
}

}  // namespace articular::sim
