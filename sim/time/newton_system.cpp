#include "sim/time/newton_system.hpp"

#include <algorithm>
#include <cmath>

#include "sim/assembly/body_imbalance.hpp"
#include "sim/assembly/line_search.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/contact/touch_left.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/model/newton_weights.hpp"

namespace articular::sim {
namespace {

/// A residual that falls by less than this asks for a new matrix.
constexpr double kSlowFall = 0.1;
/// More solutions for what a correction opens and closes save no more, see RESULTS.md.
constexpr int kMostForecasts = 2;

SystemScale scale_of(double gamma) { return {1, gamma, gamma * gamma, gamma}; }

Eigen::Quaterniond quaternion(const double* q) { return {q[0], q[1], q[2], q[3]}; }

/// How much longer a line gets when the blocks move by `shift` (rigid bodies: p, rotation vector).
double lengthening(std::span<const WeightedPoint> path, const Configuration& now,
                   const Eigen::VectorXd& shift) {
  const auto move = [&](const WeightedPoint& point) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < point.nodes.size(); ++k) {
      const NodeRef& node = point.nodes[k];
      Vec3 d = shift.segment<3>(3 * node.block);
      if (node.rigid >= 0) d += shift.segment<3>(3 * node.block + 3).cross(now.lever(node));
      sum += point.weights[k] * d;
    }
    return sum;
  };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec3 d = now.position(path[i + 1]) - now.position(path[i]);
    if (const double length = d.norm(); length > 0)
      sum += d.dot(move(path[i + 1]) - move(path[i])) / length;
  }
  return sum;
}

}  // namespace

NewtonSystem::NewtonSystem(const Model& model, Dynamics& dynamics)
    : model_(model), dynamics_(dynamics), solver_(make_linear_solver(model)), forecast_(model) {}

void NewtonSystem::restart() {
  solver_ = make_linear_solver(model_);
  start_.reset();
  gamma_ = 0;
}

void NewtonSystem::begin_step(bool keep_matrix, fem::Tangent tangent) {
  iteration_ = 0;
  first_ = tangent;
  used_consistent_ = false;
  dynamics_.contact().drop_friction_duals();
  if (keep_matrix) return;
  gamma_ = 0;
  dynamics_.forget_fibre_rates();
}

void NewtonSystem::end_step() {
  if (!dynamics_.matrix().has_pressures()) return;
  if (!start_) start_.emplace();
  start_->keep(dynamics_.now());
}

void NewtonSystem::begin_iteration() {
  pressures_ = {};
  if (start_) pressures_ = {&*start_, 0};
  dynamics_.contact().drop_friction_duals();
  correction_ = 0;
  anderson_.restart();
}

bool NewtonSystem::needs_matrix(double gamma) const {
  if (gamma != gamma_ || pattern_ != dynamics_.matrix().pattern_id() || has_parted()) return true;
  return iteration_ > 0 && residual_ > kSlowFall * last_residual_;
}

bool NewtonSystem::has_parted() const {
  return least_touch_left(touching_, dynamics_.now().contact.force_on_bodies()) == 0;
}

bool NewtonSystem::prepare(double gamma, fem::Tangent tangent, SolverCounts& counts) {
  tangent_ = tangent;
  if (tangent == fem::Tangent::Projected) ++counts.projected_tangents;
  return prepare(dynamics_.assemble(scale_of(gamma), tangent, pressures_), gamma, counts);
}

bool NewtonSystem::prepare(const NewtonEquations& equations, double gamma, SolverCounts& counts) {
  const Stopwatch watch(solve_seconds_);
  ++counts.factorizations;
  const bool ready = prepare_linear(*solver_, equations, dynamics_.now().configuration.x);
  friction_ = &equations.friction;
  gamma_ = ready ? gamma : 0;
  is_new_ = true;
  pattern_ = equations.A.pattern_id();
  touching_ = dynamics_.now().contact.force_on_bodies();
  return ready;
}

bool NewtonSystem::solve_symmetric(const Eigen::VectorXd& r, Eigen::VectorXd& w,
                                   SolverCounts& counts) {
  w.setZero(r.size());
  const fem::SolveReport report = solver_->solve(r, w);
  ++counts.linear_solves;
  counts.linear_iterations += report.iterations;
  return report.converged && w.allFinite();
}

bool NewtonSystem::solve_linear(const Eigen::VectorXd& r, SolverCounts& counts) {
  const Stopwatch watch(solve_seconds_);
  const auto solve = [&](Eigen::VectorXd& part, Eigen::VectorXd& w) {
    keep_free_part(model_, part);
    return solve_symmetric(part, w, counts);
  };
  const FrictionCoupling& coupling = *friction_;
  const bool solved = solve_symmetric(r, w_, counts) &&
                      (coupling.num_groups() == 0 || solve_with_friction(coupling, solve, r, w_));
  used_consistent_ |= solved && tangent_ == fem::Tangent::Consistent;
  return solved;
}

bool NewtonSystem::find_correction(double gamma, SolverCounts& counts) {
  is_new_ = false;
  bool ready = !needs_matrix(gamma) || prepare(gamma, first_, counts);
  ++iteration_;
  if (ready && solve_linear(mass_rhs_, counts)) return true;
  // Not positive definite: Cholesky says so at once, conjugate gradients when they meet it.
  if (tangent_ == fem::Tangent::Projected) return false;
  // Where the iteration is slow besides, the other one is not asked again in this step.
  if (anderson_.is_slow()) first_ = fem::Tangent::Projected;
  ready = prepare(gamma, fem::Tangent::Projected, counts);
  return ready && solve_linear(mass_rhs_, counts);
}

bool NewtonSystem::prepare_foreseen(double gamma, const GroupChanges& changes,
                                    SolverCounts& counts) {
  if (is_new_)
    return prepare(dynamics_.assemble_again(changes, scale_of(gamma), tangent_, pressures_), gamma,
                   counts);
  return prepare(gamma, first_, counts) ||
         (first_ == fem::Tangent::Consistent && prepare(gamma, fem::Tangent::Projected, counts));
}

bool NewtonSystem::solve_foreseen(double gamma, const GroupChanges& changes, SolverCounts& counts) {
  foreseen_rhs_.setZero(w_.size());
  forecast_.add_force(dynamics_.contact(), dynamics_.now().configuration, foreseen_rhs_);
  foreseen_rhs_ = mass_rhs_ + gamma * foreseen_rhs_;
  keep_free_part(model_, foreseen_rhs_);
  return prepare_foreseen(gamma, changes, counts) && solve_linear(foreseen_rhs_, counts);
}

void NewtonSystem::correct_for_contact(double gamma, SolverCounts& counts) {
  if (!dynamics_.now().contact.has_patches() || is_at_end(gamma)) return;
  const auto foresee = [&]() -> const GroupChanges& {
    way_ = gamma * w_;
    return forecast_.foresee(dynamics_.contact(), dynamics_.now().configuration, way_);
  };
  const GroupChanges* changes = &foresee();
  for (int round = 0; round < kMostForecasts && gamma * forecast_.missed() > residual_; ++round) {
    const double missed = forecast_.missed();
    plain_w_ = w_;
    const bool solved = solve_foreseen(gamma, *changes, counts);
    if (solved) changes = &foresee();
    if (solved && forecast_.missed() < missed) continue;
    w_ = plain_w_;
    gamma_ = 0;
    break;
  }
  dynamics_.contact().forget_foreseen();
}

void NewtonSystem::predict_pressures(double gamma) {
  if (!dynamics_.matrix().has_pressures()) return;
  trial_ = gamma * w_;
  prediction_.predict(dynamics_.now(), dynamics_.matrix(), trial_);
}

double NewtonSystem::largest_motion(double gamma) const {
  double largest = 0;  // displacement of a node or rigid body [m]
  for (int block = 0; block < model_.layout.num_free_nodes; ++block)
    largest = std::max(largest, w_.segment<3>(3 * block).squaredNorm());
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const double radius = turning_radius(rigid);
    largest = std::max({largest, w_.segment<3>(3 * rigid.block).squaredNorm(),
                        radius * radius * w_.segment<3>(3 * rigid.block + 3).squaredNorm()});
  }
  return gamma * std::sqrt(largest);
}

bool NewtonSystem::is_at_end(double gamma) const {
  constexpr double kOfTolerance = 0.1;
  return imbalance_ <= 1 && largest_motion(gamma) <= kOfTolerance * model_.position_tolerance;
}

double NewtonSystem::step_fraction(double gamma) const {
  const double motion = largest_motion(gamma);
  return motion > model_.trusted_motion ? model_.trusted_motion / motion : 1;
}

bool NewtonSystem::accelerate(double gamma) {
  // Tissue alone is left to Newton's method: a block that was inside out was accelerated into an
  // equilibrium that is none to stay in.
  if (!dynamics_.now().contact.has_patches()) {
    anderson_.restart();
    return false;
  }
  dynamics_.multiply_mass(w_, mass_rhs_);
  anderson_.see(w_, mass_rhs_, residual_ > last_residual_);
  if (!anderson_.is_slow()) return false;
  if (is_at_end(gamma)) return false;  // by Newton's own correction
  anderson_.improve(w_);
  return true;
}

/// The energy is the one that an implicit step makes least. Its slope along w is −wᵀ r with the
/// right hand side r of solve(), which along w changes by γ times the forces' change less part * M
/// w.
double NewtonSystem::searched_fraction(double most, const double* y, double gamma, const double* x,
                                       const Conditions& conditions, SolverCounts& counts) {
  if (!dynamics_.now().contact.has_patches() || is_at_end(gamma)) return most;
  const Eigen::Map<const Eigen::VectorXd> start(y, model_.layout.size());
  const Eigen::Map<const Eigen::VectorXd> way(x, model_.layout.size());
  const double t = dynamics_.now().configuration.t;
  dynamics_.multiply_mass(w_, weighted_);
  const double slope = -w_.dot(mass_rhs_), inertia = w_.dot(weighted_);
  forces_ = dynamics_.now().forces.head(w_.size());
  return searched_part(most, slope, [&](double part) {
    ++counts.force_evaluations;
    trial_ = start + part * way;
    Conditions along = conditions;
    if (dynamics_.matrix().has_pressures()) along.pressures = {&prediction_, part};
    dynamics_.evaluate(trial_.data(), t, along);
    return slope + part * inertia -
           gamma * w_.dot(dynamics_.now().forces.head(w_.size()) - forces_);
  });
}

bool NewtonSystem::solve(const double* y, double gamma, const double* b, double* x,
                         const Conditions& conditions, SolverCounts& counts) {
  const Layout& layout = model_.layout;
  const int num_velocities = 3 * layout.num_unknown_blocks();
  // b_x by blocks, a rigid body's as a rotation vector; then b_v + b_x/γ.
  shift_.setZero(3 * model_.num_blocks);
  shift_.head(3 * layout.num_free_nodes) =
      Eigen::Map<const Eigen::VectorXd>(b, 3 * layout.num_free_nodes);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int row = 3 * model_.rigid_bodies[static_cast<std::size_t>(r)].block;
    shift_.segment<3>(row) = Eigen::Map<const Vec3>(b + layout.rigid_p(r));
    const Eigen::Quaterniond q = quaternion(y + layout.rigid_q(r));
    const Eigen::Quaterniond turn = quaternion(b + layout.rigid_q(r)) * q.conjugate();
    shift_.segment<3>(row + 3) = 2 / q.squaredNorm() * turn.vec();
  }
  velocity_rhs_ = Eigen::Map<const Eigen::VectorXd>(b + layout.velocities(), num_velocities) +
                  shift_.head(num_velocities) / gamma;
  dynamics_.multiply_mass(velocity_rhs_, mass_rhs_);

  // Activations are on their own; their change pulls on the lines' points.
  pull_.setZero(3 * model_.num_blocks);
  for (int m = 0; m < layout.num_muscles; ++m) {
    const int i = layout.activations() + m;
    const double tau = activation_time(model_, y, dynamics_.now().configuration.t, m);
    x[i] = b[i] / (1 + gamma / tau);
    // What fibres in tissue pull more is left to the next iteration.
    const int index = model_.muscles[static_cast<std::size_t>(m)].line;
    const auto line = static_cast<std::size_t>(index);
    if (x[i] != 0 && index >= 0)
      add_line_force(path_of(dynamics_.now(), line), dynamics_.now().configuration,
                     dynamics_.now().lines[line].tension_per_activation * x[i], pull_);
  }
  // D b_x: dampers depend on δv = w − b_x/γ.
  const Configuration& now = dynamics_.now().configuration;
  for (std::size_t l = 0; l < model_.lines.size(); ++l)
    if (const double viscosity = dynamics_.now().lines[l].viscosity; viscosity != 0)
      add_line_force(path_of(dynamics_.now(), l), now,
                     -viscosity / gamma * lengthening(path_of(dynamics_.now(), l), now, shift_),
                     pull_);
  damping_.add_product(dynamics_.now(), shift_, 1 / gamma, pull_);
  dynamics_.now().contact.add_damping_product(now, shift_, 1 / gamma, pull_);
  relaxation_.add_known_force(dynamics_.now(), b, gamma, pull_);
  mass_rhs_ += gamma * pull_.head(num_velocities);
  keep_free_part(model_, mass_rhs_);

  imbalance_ = body_imbalance(model_, dynamics_, mass_rhs_, gamma);
  last_residual_ = residual_;
  residual_ = mass_rhs_.norm();
  w_.resize(num_velocities);
  const bool searches = correction_++ >= searches_from_;
  if (num_velocities > 0) {
    if (!find_correction(gamma, counts)) return false;
    if (!searches) correct_for_contact(gamma, counts);
  }
  // The rows of held freedoms are δv = b_v. With w = 0 there instead, the round-off of axes that
  // are turned would be predicted on and on, twice as large in each step.
  for (const auto& [block, free] : model_.held_blocks) {
    const Vec3 given = velocity_rhs_.segment<3>(3 * block);
    auto own = w_.segment<3>(3 * block);
    own = (free * own + given - free * given).eval();
  }
  const bool accelerated = !searches && accelerate(gamma);

  Eigen::Map<Eigen::VectorXd>(x, 3 * layout.num_free_nodes) =
      gamma * w_.head(3 * layout.num_free_nodes);
  Eigen::Map<Eigen::VectorXd> velocity_change(x + layout.velocities(), num_velocities);
  velocity_change = w_ - shift_.head(num_velocities) / gamma;
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int row = 3 * model_.rigid_bodies[static_cast<std::size_t>(r)].block;
    Eigen::Map<Vec3>(x + layout.rigid_p(r)) = gamma * w_.segment<3>(row);
    // δq = ½ δθ ⊗ q, and the part of b_q along q that changes its length.
    const Eigen::Quaterniond q = quaternion(y + layout.rigid_q(r));
    const Eigen::Quaterniond b_q = quaternion(b + layout.rigid_q(r));
    const Vec3 theta = 0.5 * gamma * w_.segment<3>(row + 3);
    const Eigen::Quaterniond dq = Eigen::Quaterniond(0, theta.x(), theta.y(), theta.z()) * q;
    const double growth = b_q.dot(q) / q.squaredNorm();
    double* x_q = x + layout.rigid_q(r);
    x_q[0] = dq.w() + growth * q.w();
    x_q[1] = dq.x() + growth * q.x();
    x_q[2] = dq.y() + growth * q.y();
    x_q[3] = dq.z() + growth * q.z();
  }
  velocity_change_.setZero(3 * model_.num_blocks);
  velocity_change_.head(num_velocities) = velocity_change;
  dynamics_.contact().update_friction_duals(dynamics_.now().configuration, velocity_change_);
  relaxation_.correct(dynamics_.now(), b, gamma, w_, x);
  predict_pressures(gamma);
  double scale = step_fraction(gamma);
  if (searches) scale = searched_fraction(scale, y, gamma, x, conditions, counts);
  if (!searches) anderson_.took(scale, w_);
  if (dynamics_.matrix().has_pressures()) pressures_ = {&prediction_, scale};
  changed_ = accelerated || scale < 1;
  if (scale < 1) Eigen::Map<Eigen::VectorXd>(x, layout.size()) *= scale;
  return true;
}

}  // namespace articular::sim
