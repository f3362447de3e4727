#include "sim/step/state_response.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sim/assembly/solver_setup.hpp"
#include "sim/model/displace.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/model/newton_weights.hpp"

namespace articular::sim {
namespace {

/// Between nearby states, of the smallest element: far below what contact and laws bend in, and far
/// above round-off.
constexpr double kNearMotion = 1e-6;
constexpr double kNearMotionAlone = 1e-9;  // [m] without tissue and contact
constexpr double kNearActivation = 1e-6;
constexpr double kNearSpeed = 1e-6;  // [m/s]

/// Corrections end below this part of the response. By the balance alone it would not do: where
/// tissue bends easily, little is left of the forces long before.
constexpr double kSolved = 3e-4;
constexpr int kMostCorrections = 20;

/// Of each column: what is left out where few stand for all.
constexpr double kLeftOut = 1e-4;

/// The largest of the blocks' displacements [m], or velocities [m/s].
double largest_motion(const Model& model, const Eigen::VectorXd& blocks) {
  double largest = blocks.head(3 * model.layout.num_free_nodes).lpNorm<Eigen::Infinity>();
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(r)];
    largest = std::max({largest, blocks.segment<3>(3 * rigid.block).norm(),
                        turning_radius(rigid) * blocks.segment<3>(3 * rigid.block + 3).norm()});
  }
  return largest;
}

NearbyStates states_along(const Model& model, const Eigen::VectorXd& y,
                          const Eigen::VectorXd& motion, const Eigen::VectorXd& velocity,
                          const Eigen::VectorXd& activation) {
  const Layout& layout = model.layout;
  const double near_motion =
      std::isfinite(model.trusted_motion) ? kNearMotion * model.trusted_motion : kNearMotionAlone;
  const double size = std::max(
      {largest_motion(model, motion) / near_motion, largest_motion(model, velocity) / kNearSpeed,
       activation.size() > 0 ? activation.lpNorm<Eigen::Infinity>() / kNearActivation : 0});
  if (size == 0) return {y, y, 1};
  const double part = 1 / size;
  Eigen::VectorXd middle = y;
  for (int m = 0; m < layout.num_muscles; ++m) {
    const double room = part * std::abs(activation[m]);
    double& a = middle[layout.activations() + m];
    a = std::clamp(a, room, 1 - room);
  }
  const auto moved = [&](double by) {
    Eigen::VectorXd z = middle;
    displace(model, by * motion, z);
    z.segment(layout.velocities(), velocity.size()) += by * velocity;
    z.segment(layout.activations(), layout.num_muscles) += by * activation;
    return z;
  };
  return {moved(-part), moved(part), 2 * part};
}

/// Columns that are combinations of few: basis * parts, up to kLeftOut of each.
struct FewColumns {
  Eigen::MatrixXd basis, parts;
};

/// By the principal directions of the columns, each taken at the same size.
FewColumns few_columns(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd size = columns.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd alike = columns * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(alike.transpose() * alike);
  // Increasing; their sum is the number of columns.
  const Eigen::VectorXd& squares = gram.eigenvalues();
  Eigen::Index kept = 0;
  double left = squares.cwiseMax(0).sum();
  while (kept < squares.size() && left > kLeftOut * kLeftOut)
    left -= squares[squares.size() - ++kept];
  const Eigen::MatrixXd W = gram.eigenvectors().rightCols(kept);
  return {alike * W, W.transpose() * size.asDiagonal()};
}

/// Rows that count alike, whatever their unit.
double largest_column(const Eigen::MatrixXd& rows) {
  const double largest = rows.colwise().norm().maxCoeff();
  return largest > 0 ? largest : 1;
}

}  // namespace

StateResponse no_response(const Model& model, Eigen::Index inputs) {
  const Eigen::Index rows = 3 * model.layout.num_unknown_blocks();
  return {Eigen::MatrixXd::Zero(rows, inputs), Eigen::MatrixXd::Zero(rows, inputs),
          Eigen::MatrixXd::Zero(model.layout.num_muscles, inputs), 0};
}

NearbyStates nearby_states(const Model& model, const Eigen::VectorXd& y,
                           const StateResponse& response, Eigen::Index input) {
  return states_along(model, y, response.motion.col(input), response.velocity.col(input),
                      response.activation.col(input));
}

ResponseSolver::ResponseSolver(const Model& model, Dynamics& dynamics)
    : model_(model), dynamics_(dynamics), solver_(make_linear_solver(model)) {}

bool ResponseSolver::factor(const SystemScale& scale) {
  dynamics_.evaluate(y_.data(), t_, conditions_);
  for (const fem::Tangent tangent : {fem::Tangent::Consistent, fem::Tangent::Projected})
    if (prepare_linear(*solver_, dynamics_.assemble(scale, tangent),
                       dynamics_.now().configuration.x))
      return true;
  return false;
}

/// Of the unknown blocks along the column [N, N m].
Eigen::VectorXd ResponseSolver::force_change(const Column& column) {
  const NearbyStates states =
      states_along(model_, y_, column.motion, column.velocity, column.activation);
  const Eigen::Index rows = column.motion.size();
  dynamics_.evaluate(states.above.data(), t_, conditions_);
  Eigen::VectorXd change = dynamics_.now().forces.head(rows);
  dynamics_.evaluate(states.below.data(), t_, conditions_);
  change -= dynamics_.now().forces.head(rows);
  return change / states.apart;
}

/// What activations change of the forces of now() on the unknown blocks, a column an input [N, N
/// m].
Eigen::MatrixXd ResponseSolver::pulls(const Eigen::MatrixXd& activation) {
  const Eigen::Index rows = 3 * model_.layout.num_unknown_blocks();
  Eigen::MatrixXd by_muscle = Eigen::MatrixXd::Zero(rows, model_.layout.num_muscles);
  const Moment& now = dynamics_.now();
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    if (model_.lines[l].muscle < 0) continue;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(now.forces.size());
    add_line_force(path_of(now, l), now.configuration, now.lines[l].tension_per_activation, f);
    by_muscle.col(model_.lines[l].muscle) += f.head(rows);
  }
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(rows);
  for (const Tissue& tissue : model_.tissues)
    if (tissue.muscle >= 0)
      by_muscle.col(tissue.muscle) = force_change(
          {rest, rest, Eigen::VectorXd::Unit(model_.layout.num_muscles, tissue.muscle)});
  for (auto column : by_muscle.colwise()) {
    Eigen::VectorXd free = column;
    keep_free_part(model_, free);
    column = free;
  }
  return by_muscle * activation;
}

/// x with residual(x) = 0 from where it is, as far as corrections by the matrix make that smaller.
template <class Residual>
bool ResponseSolver::solve(const Residual& residual, Eigen::VectorXd& x, double& error) {
  Eigen::VectorXd r = residual(x), correction(x.size());
  const double first = r.norm();
  double left = first;
  for (int k = 0; k < kMostCorrections && left > 0; ++k) {
    correction.setZero();
    if (!solver_->solve(r, correction).converged || !correction.allFinite()) return false;
    keep_free_part(model_, correction);
    const Eigen::VectorXd next = x + correction;
    r = residual(next);
    if (!(r.norm() < left)) break;
    x = next;
    left = r.norm();
    if (largest_motion(model_, correction) <= kSolved * largest_motion(model_, x)) break;
  }
  if (first > 0) error = std::max(error, left / first);
  return true;
}

bool ResponseSolver::follow_equilibrium(const Eigen::VectorXd& y, double t,
                                        const Eigen::MatrixXd& excitation,
                                        StateResponse& response) {
  y_ = y;
  t_ = t;
  conditions_ = {};
  response = no_response(model_, excitation.cols());
  response.activation = excitation;
  if (model_.layout.num_unknown_blocks() == 0) return true;
  if (!factor({0, 0, 1})) return false;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(response.velocity.rows()),
                        same = Eigen::VectorXd::Zero(model_.layout.num_muscles);
  FewColumns few = few_columns(pulls(excitation));
  for (auto column : few.basis.colwise()) {
    const Eigen::VectorXd pull = column;
    Eigen::VectorXd motion = rest;
    const auto unbalanced = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return pull + force_change({x, rest, same});
    };
    if (!solve(unbalanced, motion, response.error)) return false;
    column = motion;
  }
  response.motion = few.basis * few.parts;
  return true;
}

// v' of implicit Euler: M (v' − v) = h (Δf(x + h v', v') + ∂f/∂a a'). Muscles move a few bones, so
// that few combinations of x, v and pulls stand for all inputs.
bool ResponseSolver::follow_step(const Eigen::VectorXd& y, double t_before, double t,
                                 const Eigen::MatrixXd& excitation, StateResponse& response) {
  const double h = t - t_before;
  y_ = y;
  t_ = t;
  conditions_ = {};
  conditions_.step_start = t_before;
  for (int m = 0; m < model_.layout.num_muscles; ++m) {
    const double part = h / activation_time(model_, y.data(), t, m);
    response.activation.row(m) =
        (response.activation.row(m) + part * excitation.row(m)) / (1 + part);
  }
  if (model_.layout.num_unknown_blocks() == 0) return true;
  if (!factor({1, h, h * h, h})) return false;
  const Eigen::MatrixXd pull = pulls(response.activation);
  const Eigen::Index n = pull.rows();
  const double motions = largest_column(response.motion),
               velocities = largest_column(response.velocity), forces = largest_column(pull);
  Eigen::MatrixXd all(3 * n, pull.cols());
  all << response.motion / motions, response.velocity / velocities, pull / forces;
  const FewColumns few = few_columns(all);
  const Eigen::VectorXd same = Eigen::VectorXd::Zero(model_.layout.num_muscles);
  Eigen::MatrixXd velocity(n, few.basis.cols());
  for (Eigen::Index k = 0; k < few.basis.cols(); ++k) {
    const Eigen::VectorXd x = motions * few.basis.col(k).head(n),
                          before = velocities * few.basis.col(k).segment(n, n),
                          force = forces * few.basis.col(k).tail(n);
    Eigen::VectorXd v_next = before, inertia;
    const auto unbalanced = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      const Eigen::VectorXd change = h * (force + force_change({x + h * v, v, same}));
      dynamics_.multiply_mass(v - before, inertia);
      return change - inertia;
    };
    if (!solve(unbalanced, v_next, response.error)) return false;
    velocity.col(k) = v_next;
  }
  response.velocity = velocity * few.parts;
  response.motion += h * response.velocity;
  return true;
}

}  // namespace articular::sim
