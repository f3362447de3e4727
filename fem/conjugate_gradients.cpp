#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "fem/linear_solver.hpp"

namespace articular::fem {
namespace {

/// Preconditioned conjugate gradients [Saad 2003, algorithm 9.1] on the lower half of A, which
/// halves what a product reads from memory. Sums run in a fixed order.
///
/// The residual of the recurrence drifts from b − A x by round-off: where it says that the goal is
/// reached, b − A x is computed, and if it is not below the goal, the iteration starts anew from x.
///
/// [Saad 2003] Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. SIAM.
class ConjugateGradients final : public LinearSolver {
 public:
  ConjugateGradients(double tolerance, int max_iterations)
      : tolerance_(tolerance), max_iterations_(max_iterations) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions&) override {
    if (A.num_blocks() != num_blocks() || A.pattern_id() != pattern_id_) take_pattern(A);
    for (std::size_t k = 0; k < slot_.size(); ++k) lower_[k] = A.block(slot_[k]);
    ready_ = false;
    for (int i = 0; i < num_blocks(); ++i) {
      // The lower half is mirrored, as in the off-diagonal blocks.
      diagonal_[i] = Mat3(A.block(diagonal_slot_[i])).selfadjointView<Eigen::Lower>();
      const Eigen::LLT<Mat3> factor(diagonal_[i]);
      if (factor.info() != Eigen::Success || !diagonal_[i].allFinite()) {
        return FactorStatus::NotPositiveDefinite;
      }
      inverse_diagonal_[i] = factor.solve(Mat3::Identity());
    }
    ready_ = true;
    return FactorStatus::Ready;
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    assert(ready_);
    assert(b.size() == r_.size());
    SolveReport report;
    const double b_norm = b.norm();
    if (b_norm == 0 || x.size() != b.size()) x.setZero(b.size());
    if (b_norm == 0) return report;

    report.relative_residual = std::numeric_limits<double>::infinity();
    while (true) {
      multiply(x, q_);
      r_ = b - q_;
      const double residual = r_.norm() / b_norm;
      const bool stagnates = !(residual < 0.5 * report.relative_residual);  // true for NaN
      report.relative_residual = residual;
      report.converged = residual <= tolerance_;
      if (report.converged || stagnates || report.iterations >= max_iterations_) return report;
      if (!iterate(tolerance_ * b_norm, x, report.iterations)) {
        report.converged = false;
        return report;
      }
    }
  }

 private:
  int num_blocks() const { return static_cast<int>(diagonal_.size()); }

  void take_pattern(const BlockMatrix& A) {
    pattern_id_ = A.pattern_id();
    const auto n = static_cast<std::size_t>(A.num_blocks());
    row_begin_.assign(1, 0);
    column_.clear();
    slot_.clear();
    diagonal_slot_.clear();
    for (int i = 0; i < A.num_blocks(); ++i) {
      for (int s = A.row_begin()[i]; s < A.row_begin()[i + 1]; ++s) {
        const int j = A.column()[s];
        if (j == i) diagonal_slot_.push_back(s);
        if (j >= i) break;
        column_.push_back(j);
        slot_.push_back(s);
      }
      row_begin_.push_back(static_cast<int>(column_.size()));
    }
    lower_.resize(column_.size());
    diagonal_.resize(n);
    inverse_diagonal_.resize(n);
    for (Eigen::VectorXd* vector : {&r_, &z_, &p_, &q_}) vector->resize(3 * A.num_blocks());
  }

  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    for (int i = 0; i < num_blocks(); ++i) {
      const Vec3 x_i = x.segment<3>(3 * Eigen::Index{i});
      Vec3 sum = diagonal_[i] * x_i;
      for (int k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
        const Eigen::Index j = 3 * Eigen::Index{column_[k]};
        sum += lower_[k] * x.segment<3>(j);
        y.segment<3>(j) += lower_[k].transpose() * x_i;
      }
      y.segment<3>(3 * Eigen::Index{i}) = sum;  // the first to write row i: later rows add to it
    }
  }

  /// Iterates from the residual r_ until its norm is `goal` or the iterations are used up.
  /// @return false where A proves not to be positive definite
  bool iterate(double goal, Eigen::VectorXd& x, int& iterations) {
    double rz = precondition();
    p_ = z_;
    while (iterations < max_iterations_) {
      multiply(p_, q_);
      const double curvature = p_.dot(q_);
      if (!(curvature > 0)) return false;  // NaN included
      const double alpha = rz / curvature;
      x += alpha * p_;
      r_ -= alpha * q_;
      ++iterations;
      if (r_.norm() <= goal) return true;
      const double rz_next = precondition();
      p_ = z_ + (rz_next / rz) * p_;
      rz = rz_next;
    }
    return true;
  }

  /// z = M⁻¹ r. @return r·z
  double precondition() {
    for (int i = 0; i < num_blocks(); ++i) {
      const Eigen::Index row = 3 * Eigen::Index{i};
      z_.segment<3>(row) = inverse_diagonal_[i] * r_.segment<3>(row);
    }
    return r_.dot(z_);
  }

  double tolerance_;
  int max_iterations_;
  bool ready_ = false;
  std::uint64_t pattern_id_ = 0;
  std::vector<int> row_begin_{0}, column_;  // of the blocks below the diagonal
  std::vector<int> slot_, diagonal_slot_;   // where A holds them
  std::vector<Mat3> lower_, diagonal_, inverse_diagonal_;
  Eigen::VectorXd r_, z_, p_, q_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradients(double tolerance, int max_iterations) {
  if (!(tolerance > 0) || max_iterations < 1) {
    std::ostringstream message;
    message << "conjugate gradients: tolerance is " << tolerance << ", must be positive; at most "
            << max_iterations << " iterations, must be at least 1";
    throw std::invalid_argument(message.str());
  }
  return std::make_unique<ConjugateGradients>(tolerance, max_iterations);
}

}  // namespace articular::fem
