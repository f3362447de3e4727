#include "sim/statics/load_step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/assembly/load_work.hpp"
#include "sim/assembly/rigid_body_modes.hpp"
#include "sim/model/newton_weights.hpp"
#include "sim/statics/load_prediction.hpp"
#include "sim/statics/pseudo_time.hpp"

namespace articular::sim {
namespace {

/// Detections in a row without contacts that hold where the solution ends.
constexpr int kMostDetections = 20;
/// Solutions in pseudo-time before the load step is given up.
constexpr int kMostSolutions = 400;
/// Of what is loose in a scene that has nothing to come to rest on or to hang from.
constexpr int kMostAlone = 10;
/// Where nothing limits the motion (no tissue, no contact) [m].
constexpr double kLooseMotion = 1e-3;

/// Of a load step that followed its equilibrium, at most so many times what the stiffness where it
/// began lets expect.
constexpr double kMostUnexpected = 10;

Eigen::Quaterniond rotation(const Layout& layout, int r, const Eigen::VectorXd& y) {
  const double* q = y.data() + layout.rigid_q(r);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

struct FarthestMotion {
  int body = -1;
  double motion = 0;  // [m]; of a rigid body, that of its surface as it turns too
};

FarthestMotion farthest_motion(const Model& model, const Eigen::VectorXd& y,
                               const Eigen::VectorXd& z) {
  const Layout& layout = model.layout;
  FarthestMotion farthest;
  const auto look_at = [&](int body, double motion) {
    if (motion > farthest.motion) farthest = {body, motion};
  };
  for (const Tissue& tissue : model.tissues)
    for (const NodeRef& node : tissue.nodes) {
      if (node.rigid >= 0) continue;
      const int x = layout.node_x(node.block);
      look_at(tissue.body, (z.segment<3>(x) - y.segment<3>(x)).norm());
    }
  for (int r = 0; r < layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    const int p = layout.rigid_p(r);
    const double turn = rotation(layout, r, z).angularDistance(rotation(layout, r, y));
    look_at(rigid.body,
            std::max((z.segment<3>(p) - y.segment<3>(p)).norm(), turning_radius(rigid) * turn));
  }
  return farthest;
}

class LoadStep {
 public:
  LoadStep(const Model& model, Dynamics& dynamics, Equilibrium& equilibrium,
           const ContactHooks& contacts, double t_before, double t, int most_iterations,
           std::vector<ConvergenceRow>& convergence)
      : model_(model),
        dynamics_(dynamics),
        equilibrium_(equilibrium),
        contacts_(contacts),
        t_before_(t_before),
        t_(t),
        most_iterations_(most_iterations),
        convergence_(convergence),
        first_row_(convergence.size()),
        reach_(std::isfinite(model.trusted_motion) ? model.trusted_motion : kLooseMotion) {}

  LoadStepResult take(Eigen::VectorXd& y) {
    LoadStepResult result;
    if (model_.layout.num_unknown_blocks() == 0) {  // all is held
      look(y, 0);
      result.reached = true;
      return result;
    }
    const Eigen::VectorXd start = y;
    begin(y);
    result.loose = find_rigid_body_mode(model_, dynamics_);
    result.reached = !result.loose && balance(y);
    if (!result.reached) {
      const bool held = !result.loose;
      const double expected = farthest_motion(model_, start, y).motion + first_correction();
      result.reached =
          approach_in_pseudo_time(reach_, is_alone(result) ? kMostAlone : kMostSolutions,
                                  [&](double motion) { return settle(motion, y, result); });
      if (held && !result.loose) look_for_snap(start, y, expected, result);
    }
    result.iterations = iterations_;
    return result;
  }

 private:
  /// Of the first solution of this load step [m]; infinite where it found none.
  double first_correction() const {
    if (convergence_.size() == first_row_) return std::numeric_limits<double>::infinity();
    const NewtonIteration& first = convergence_[first_row_].newton;
    return first.correction / first.fraction;
  }

  void look_for_snap(const Eigen::VectorXd& start, const Eigen::VectorXd& end, double expected,
                     LoadStepResult& result) const {
    const auto [body, motion] = farthest_motion(model_, start, end);
    if (motion > std::max(reach_, kMostUnexpected * expected))
      result.snap = {.body = body, .motion = motion, .expected = expected};
  }

  /// The prediction, or, where a linear one is worse, where things were. What contact follows on a
  /// round surface is curved: there it is.
  void begin(Eigen::VectorXd& y) {
    find_contacts(y, t_before_, 0);
    const std::optional<Eigen::VectorXd> predicted =
        predict_load_step(model_, dynamics_, equilibrium_, t_before_, t_, y);
    if (predicted && soft_residual(*predicted) < soft_residual(y)) y = *predicted;
    look(y, 0);
  }

  /// The largest unbalanced force with soft contact [N]: stiff contact would hide what else is.
  double soft_residual(const Eigen::VectorXd& y) {
    look(y, 0, {.contact = {.soft = true}});
    const double residual = equilibrium_.residual();
    return std::isfinite(residual) ? residual : std::numeric_limits<double>::infinity();
  }

  /// Finds contacts at y, for things that will move so far [m], and evaluates there.
  void look(const Eigen::VectorXd& y, double motion, const Conditions& conditions = {}) {
    find_contacts(y, t_, motion);
    dynamics_.evaluate(y.data(), t_, conditions);
  }

  void find_contacts(const Eigen::VectorXd& y, double t, double motion) {
    if (!contacts_.find) return;
    read_state(model_, y.data(), t, where_);
    contacts_.find(where_, motion);
  }

  bool is_exhausted() const { return iterations_ >= most_iterations_; }
  bool is_alone(const LoadStepResult& result) const {
    return result.loose && model_.contacts.empty() && model_.lines.empty();
  }

  bool solve(Eigen::VectorXd& y, double damping) {
    if (is_exhausted()) return false;
    const bool solved = equilibrium_.solve(y, t_, damping, {}, contacts_.cover);
    int k = 0;
    for (const NewtonIteration& newton : equilibrium_.iterations())
      convergence_.push_back({t_, solution_, damping, k++, newton});
    iterations_ += k;
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

  PseudoStep settle(double motion, Eigen::VectorXd& y, LoadStepResult& result) {
    if (is_exhausted()) return PseudoStep::GaveUp;
    look(y, motion);
    const double damping = equilibrium_.largest_acceleration() / motion;
    const Configuration from = dynamics_.now().configuration;
    const Eigen::VectorXd before = dynamics_.now().forces;
    Eigen::VectorXd trial = y;
    if (!solve(trial, damping) || (contacts_.covered && !contacts_.covered()))
      return PseudoStep::Failed;
    if (result.loose)
      result.settling_loss += work(y, before, trial, dynamics_.now().forces) - surplus(from);
    y = trial;
    look(y, 0);
    result.loose = find_rigid_body_mode(model_, dynamics_);
    const bool reached = equilibrium_.is_balanced(2 * kBalanced) || (!result.loose && balance(y));
    return reached ? PseudoStep::Arrived : PseudoStep::Moved;
  }

  /// What the loads of the step's end do on the way since `from` more than their means over the
  /// step, which the ledger counts [J].
  double surplus(const Configuration& from) const {
    const Configuration& now = dynamics_.now().configuration;
    return load_work(model_, from, now, t_, t_) - load_work(model_, from, now, t_before_, t_);
  }

  /// Of the unbalanced forces f on the way from y to z, by the trapezoidal rule [J].
  double work(const Eigen::VectorXd& y, const Eigen::VectorXd& f_y, const Eigen::VectorXd& z,
              const Eigen::VectorXd& f_z) const {
    const Layout& layout = model_.layout;
    double sum = 0;
    const auto add = [&](int row, const Vec3& motion) {
      sum += 0.5 * (f_y.segment<3>(row) + f_z.segment<3>(row)).dot(motion);
    };
    for (int block = 0; block < layout.num_free_nodes; ++block)
      add(3 * block, z.segment<3>(layout.node_x(block)) - y.segment<3>(layout.node_x(block)));
    for (int r = 0; r < layout.num_rigid; ++r) {
      const int row = 3 * model_.rigid_bodies[static_cast<std::size_t>(r)].block;
      add(row, z.segment<3>(layout.rigid_p(r)) - y.segment<3>(layout.rigid_p(r)));
      const Eigen::AngleAxisd turn(rotation(layout, r, z) * rotation(layout, r, y).conjugate());
      add(row + 3, turn.angle() * turn.axis());
    }
    return sum;
  }

  const Model& model_;
  Dynamics& dynamics_;
  Equilibrium& equilibrium_;
  const ContactHooks& contacts_;
  double t_before_, t_;
  int most_iterations_;
  std::vector<ConvergenceRow>& convergence_;
  std::size_t first_row_;  // of this load step
  double reach_;
  Configuration where_;  // contacts are looked for
  int solution_ = 0;
  int iterations_ = 0;  // of all solutions
};

}  // namespace

LoadStepResult take_load_step(const Model& model, Dynamics& dynamics, Equilibrium& equilibrium,
                              const ContactHooks& contacts, double t_before, double t,
                              int most_iterations, Eigen::VectorXd& y,
                              std::vector<ConvergenceRow>& convergence) {
  return LoadStep(model, dynamics, equilibrium, contacts, t_before, t, most_iterations, convergence)
      .take(y);
}

}  // namespace articular::sim
