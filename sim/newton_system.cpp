#include "sim/newton_system.hpp"

#include "sim/stopwatch.hpp"

namespace articular::sim {
namespace {

/// Conjugate gradients stop here: Newton's iteration corrects the rest.
constexpr double kLinearTolerance = 1e-6;
constexpr int kMostLinearIterations = 2000;

std::unique_ptr<fem::LinearSolver> make_solver(const Model& model) {
  if (model.scenario.integrator.solver == Integrator::Solver::Cholesky) return fem::make_cholesky();
  return fem::make_conjugate_gradients(kLinearTolerance, kMostLinearIterations);
}

/// A residual that falls by less than this asks for a new matrix.
constexpr double kSlowFall = 0.1;

Eigen::Quaterniond quaternion(const double* q) { return {q[0], q[1], q[2], q[3]}; }

}  // namespace

NewtonSystem::NewtonSystem(const Model& model, Dynamics& dynamics)
    : model_(model), dynamics_(dynamics), solver_(make_solver(model)) {}

void NewtonSystem::begin_step(bool keep_matrix) {
  iteration_ = 0;
  if (!keep_matrix) gamma_ = 0;
}

bool NewtonSystem::needs_matrix(double gamma) const {
  if (gamma != gamma_ || pattern_ != dynamics_.pattern_id()) return true;
  return iteration_ > 0 && residual_ > kSlowFall * last_residual_;
}

bool NewtonSystem::prepare(double gamma, IntegratorCounts& counts) {
  for (const fem::Tangent tangent : {fem::Tangent::Consistent, fem::Tangent::Projected}) {
    const fem::BlockMatrix& A = dynamics_.matrix(gamma, tangent);
    const Stopwatch watch(counts.solve_seconds);
    ++counts.factorizations;
    gamma_ = gamma;
    pattern_ = A.pattern_id();
    if (solver_->prepare(A) == fem::FactorStatus::Ready) return true;
    gamma_ = 0;
    if (tangent == fem::Tangent::Consistent) ++counts.projected_tangents;
  }
  return false;
}

bool NewtonSystem::solve(const double* y, double gamma, const double* b, double* x,
                         IntegratorCounts& counts) {
  const Layout& layout = model_.layout;
  const int num_velocities = 3 * layout.num_unknown_blocks();
  // b_v + b_x/γ
  velocity_rhs_ = Eigen::Map<const Eigen::VectorXd>(b + layout.velocities(), num_velocities);
  velocity_rhs_.head(3 * layout.num_free_nodes) +=
      Eigen::Map<const Eigen::VectorXd>(b, 3 * layout.num_free_nodes) / gamma;
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int row = 3 * model_.bones[static_cast<std::size_t>(r)].block;
    velocity_rhs_.segment<3>(row) += Eigen::Map<const Vec3>(b + layout.bone_p(r)) / gamma;
    const Eigen::Quaterniond q = quaternion(y + layout.bone_q(r));
    const Eigen::Quaterniond turn = quaternion(b + layout.bone_q(r)) * q.conjugate();
    velocity_rhs_.segment<3>(row + 3) += 2 / q.squaredNorm() * turn.vec() / gamma;
  }
  dynamics_.multiply_mass(velocity_rhs_, mass_rhs_);

  // Activations are on their own; their change pulls on the lines' points.
  pull_.setZero(3 * model_.num_blocks);
  for (int m = 0; m < layout.num_muscles; ++m) {
    const int i = layout.activations() + m;
    const double tau = dynamics_.activation_time(y, dynamics_.configuration().t, m);
    x[i] = b[i] / (1 + gamma / tau);
    const auto line = static_cast<std::size_t>(model_.muscles[static_cast<std::size_t>(m)].line);
    if (x[i] != 0)
      add_line_force(model_.lines[line], dynamics_.configuration(),
                     dynamics_.lines()[line].tension_per_activation * x[i], pull_);
  }
  mass_rhs_ += gamma * pull_.head(num_velocities);

  last_residual_ = residual_;
  residual_ = mass_rhs_.norm();
  w_.setZero(num_velocities);
  if (num_velocities > 0) {
    if (needs_matrix(gamma) && !prepare(gamma, counts)) return false;
    ++iteration_;
    const Stopwatch watch(counts.solve_seconds);
    const fem::SolveReport report = solver_->solve(mass_rhs_, w_);
    counts.linear_iterations += report.iterations;
    if (!report.converged || !w_.allFinite()) return false;
  }

  Eigen::Map<Eigen::VectorXd>(x, 3 * layout.num_free_nodes) =
      gamma * w_.head(3 * layout.num_free_nodes);
  Eigen::Map<Eigen::VectorXd> velocity_change(x + layout.velocities(), num_velocities);
  velocity_change = w_;
  velocity_change.head(3 * layout.num_free_nodes) -=
      Eigen::Map<const Eigen::VectorXd>(b, 3 * layout.num_free_nodes) / gamma;
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int row = 3 * model_.bones[static_cast<std::size_t>(r)].block;
    const Eigen::Map<const Vec3> b_p(b + layout.bone_p(r));
    Eigen::Map<Vec3>(x + layout.bone_p(r)) = gamma * w_.segment<3>(row);
    velocity_change.segment<3>(row) -= b_p / gamma;
    // δq = ½ δθ ⊗ q, and the part of b_q along q that changes its length.
    const Eigen::Quaterniond q = quaternion(y + layout.bone_q(r));
    const Eigen::Quaterniond b_q = quaternion(b + layout.bone_q(r));
    const Eigen::Quaterniond turn = b_q * q.conjugate();
    velocity_change.segment<3>(row + 3) -= 2 / q.squaredNorm() * turn.vec() / gamma;
    const Vec3 theta = 0.5 * gamma * w_.segment<3>(row + 3);
    const Eigen::Quaterniond dq = Eigen::Quaterniond(0, theta.x(), theta.y(), theta.z()) * q;
    const double growth = b_q.dot(q) / q.squaredNorm();
    double* x_q = x + layout.bone_q(r);
    x_q[0] = dq.w() + growth * q.w();
    x_q[1] = dq.x() + growth * q.x();
    x_q[2] = dq.y() + growth * q.y();
    x_q[3] = dq.z() + growth * q.z();
  }
  return true;
}

}  // namespace articular::sim
