#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "fem/solver/mixed_multigrid.hpp"
#include "fem/solver/multigrid_preconditioner.hpp"
#include "fem/solver/preconditioner_reuse.hpp"

namespace articular::fem {
namespace {

/// Conjugate gradients in double precision, preconditioned by multigrid in single precision: the
/// flexible variant, whose β makes the new direction conjugate to the last one even where the
/// preconditioner is not quite symmetric [Notay 2000]. Sums run over fixed pieces in a fixed order.
///
/// [Notay 2000] Notay. Flexible Conjugate Gradients. SIAM Journal on Scientific Computing 22(4).
class MultigridSolver final : public LinearSolver {
 public:
  MultigridSolver(double tolerance, int max_iterations, std::shared_ptr<ThreadPool> pool)
      : tolerance_(tolerance),
        max_iterations_(max_iterations),
        pool_(std::move(pool)),
        mixed_(tolerance, max_iterations) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions& x) override {
    assert(x.cols() <= A.num_blocks());
    ready_ = with_pressure_ = false;
    if (!A_.has_pattern_of(A)) {
      A_.take_pattern(A);
      has_pattern_ = built_ = false;
      const Eigen::Index size = 3 * Eigen::Index{A.num_blocks()};
      for (Eigen::VectorXd* vector : {&r_, &z_, &p_, &q_}) vector->resize(size);
      parts_.resize((A.num_blocks() + kRowsOfSums - 1) / kRowsOfSums);
    }
    if (!A_.take_values(A, *pool_) || !has_positive_diagonal()) {
      return FactorStatus::NotPositiveDefinite;
    }
    if (!built_ || age_.is_too_old() || x.cols() != x_.cols()) {
      x_ = x;
      if (!build()) return FactorStatus::NotPositiveDefinite;
    } else {
      x_ = x;
      preconditioner_.turn(A_, x_, *pool_);
      is_current_ = false;
    }
    ready_ = true;
    return FactorStatus::Ready;
  }

  using LinearSolver::prepare_with_pressure;
  FactorStatus prepare_with_pressure(const BlockMatrix& A, const Positions& x,
                                     const PressurePart& part) override {
    if (part.terms.empty()) return prepare(A, x);
    const FactorStatus status = mixed_.prepare(A, x, part, *pool_);
    ready_ = with_pressure_ = status == FactorStatus::Ready;
    return status;
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    assert(ready_);
    if (with_pressure_) return mixed_.solve(b, x, *pool_);
    const SolveReport report = iterate_and_repair(b, x);
    if (!report.converged) built_ = false;  // a preconditioner that failed is not kept
    return report;
  }

 private:
  enum class Outcome {
    Ended,       // at the goal, or out of iterations
    Indefinite,  // A is not positive definite
    Unfit,       // the preconditioner is not positive definite
    TooOld       // it takes so long that a new one pays
  };

  SolveReport iterate_and_repair(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    assert(b.size() == r_.size());
    SolveReport report;
    const double b_norm = b.norm();
    if (b_norm == 0 || x.size() != b.size()) x.setZero(b.size());
    if (b_norm == 0) return report;

    use_cycle_ = true;
    report.relative_residual = std::numeric_limits<double>::infinity();
    while (true) {
      const double residual = find_residual(b, x) / b_norm;
      const bool stagnates = !(residual < 0.5 * report.relative_residual);  // true for NaN
      report.relative_residual = residual;
      report.converged = residual <= tolerance_;
      if (report.converged || report.iterations >= max_iterations_) return report;
      if (stagnates && !repaired_) return report;
      repaired_ = false;
      const Outcome outcome = iterate(tolerance_ * b_norm, residual * b_norm, x, report.iterations);
      if (outcome == Outcome::Indefinite) return report;
      if (outcome != Outcome::Ended) {
        ++report.repairs;
        repair(outcome);
      }
    }
  }

  bool has_positive_diagonal() {
    for (int i = 0; i < A_.num_rows(); ++i) {
      const Eigen::LLT<Mat3> factor(Eigen::Map<const Mat3>(A_.diagonal(i)));
      if (factor.info() != Eigen::Success) return false;
    }
    return true;
  }

  bool build() {
    built_ = preconditioner_.build(A_, !has_pattern_, x_, *pool_);
    has_pattern_ = built_;
    is_current_ = built_;
    sure_bounds_ = false;
    age_.restart();
    return built_;
  }

  void repair(Outcome outcome) {
    repaired_ = true;
    if (outcome == Outcome::TooOld || !is_current_) {
      if (!build()) use_cycle_ = false;
    } else if (!sure_bounds_) {
      preconditioner_.cycle().use_sure_bounds();
      sure_bounds_ = true;
    } else {
      use_cycle_ = false;
    }
  }

  /// f(begin, end) over pieces of the blocks. @return the sum of the two numbers that it returns
  template <class Function>
  Eigen::Vector2d sum_over_pieces(const Function& f) {
    pool_->run_pieces(A_.num_rows(), kRowsOfSums, [&](int begin, int end, int) {
      parts_[begin / kRowsOfSums] = f(Eigen::Index{begin}, Eigen::Index{end});
    });
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& part : parts_) sum += part;
    return sum;
  }

  /// r = b − A x. @return its norm
  double find_residual(const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
    return std::sqrt(sum_over_pieces([&](Eigen::Index begin, Eigen::Index end) {
      A_.multiply_rows(begin, end, x.data(), r_.data());
      const auto r = r_.segment(3 * begin, 3 * (end - begin));
      r_.segment(3 * begin, 3 * (end - begin)) = b.segment(3 * begin, r.size()) - r;
      return Eigen::Vector2d(r.squaredNorm(), 0);
    })[0]);
  }

  /// From the residual r_, of the given norm, until its norm is `goal`.
  Outcome iterate(double goal, double norm, Eigen::VectorXd& x, int& iterations) {
    const double first_norm = norm;
    const int first = iterations;
    const bool may_be_too_old = use_cycle_ && !is_current_ && !age_.is_new();
    const int patience = may_be_too_old ? age_.patience(norm / goal) : max_iterations_;
    // The preconditioner gets r over its last known norm, to stay within single precision.
    double scale = norm;
    pool_->run_pieces(A_.num_rows(), kRowsOfSums, [&](int begin, int end, int) {
      preconditioner_.enter(begin, end, r_.data(), 1 / scale);
    });
    double alpha = 0, rz = 0;
    p_.setZero();
    q_.setZero();
    while (true) {
      use_cycle_ ? preconditioner_.apply_cycle(*pool_) : preconditioner_.apply_nothing();
      const Eigen::Vector2d dots = sum_over_pieces([&](Eigen::Index begin, Eigen::Index end) {
        preconditioner_.leave(begin, end, scale, z_.data());
        const auto z = z_.segment(3 * begin, 3 * (end - begin));
        return Eigen::Vector2d(z.dot(r_.segment(3 * begin, z.size())),
                               z.dot(q_.segment(3 * begin, z.size())));
      });
      if (!(dots[0] > 0)) return Outcome::Unfit;  // NaN included
      // β = z·(r − r of before) / (r·z of before), and r is r of before − α q.
      const double beta = iterations > first ? -alpha * dots[1] / rz : 0;
      rz = dots[0];
      pool_->run_pieces(A_.num_rows(), kRowsOfSums, [&](Eigen::Index begin, Eigen::Index end, int) {
        auto p = p_.segment(3 * begin, 3 * (end - begin));
        p = z_.segment(3 * begin, p.size()) + beta * p;
      });
      const double curvature = sum_over_pieces([&](Eigen::Index begin, Eigen::Index end) {
        return Eigen::Vector2d(A_.multiply_rows(begin, end, p_.data(), q_.data()), 0);
      })[0];
      if (!(curvature > 0)) return Outcome::Indefinite;
      alpha = rz / curvature;
      scale = norm;
      norm = std::sqrt(sum_over_pieces([&](Eigen::Index begin, Eigen::Index end) {
        const Eigen::Index size = 3 * (end - begin);
        auto r = r_.segment(3 * begin, size);
        x.segment(3 * begin, size) += alpha * p_.segment(3 * begin, size);
        r -= alpha * q_.segment(3 * begin, size);
        preconditioner_.enter(begin, end, r_.data(), 1 / scale);
        return Eigen::Vector2d(r.squaredNorm(), 0);
      })[0]);
      ++iterations;
      if (norm <= goal || iterations >= max_iterations_) {
        if (use_cycle_ && norm > 0 && norm <= goal) {
          age_.add(iterations - first, first_norm / norm);
        }
        return Outcome::Ended;
      }
      if (iterations - first >= patience) return Outcome::TooOld;
    }
  }

  double tolerance_;
  int max_iterations_;
  std::shared_ptr<ThreadPool> pool_;
  MixedMultigrid mixed_;
  MirroredMatrix A_;
  Positions x_;  // of the nodes, as of the last prepare()
  MultigridPreconditioner preconditioner_;
  PreconditionerReuse age_;
  bool ready_ = false;
  bool with_pressure_ = false;  // the last prepare was
  bool has_pattern_ = false;    // of A, has the preconditioner
  bool built_ = false;
  bool is_current_ = false;   // the preconditioner is that of the values of A
  bool sure_bounds_ = false;  // its eigenvalues are bounded by norms
  bool use_cycle_ = true;     // in this solve
  bool repaired_ = false;     // just now
  Eigen::VectorXd r_, z_, p_, q_;
  std::vector<Eigen::Vector2d> parts_;  // of sums
};

}  // namespace

std::unique_ptr<LinearSolver> make_multigrid(double tolerance, int max_iterations,
                                             std::shared_ptr<ThreadPool> pool) {
  if (!(tolerance > 0) || max_iterations < 1) {
    std::ostringstream message;
    message << "multigrid: tolerance is " << tolerance << ", must be positive; at most "
            << max_iterations << " iterations, must be at least 1";
    throw std::invalid_argument(message.str());
  }
  return std::make_unique<MultigridSolver>(tolerance, max_iterations, std::move(pool));
}

}  // namespace articular::fem
