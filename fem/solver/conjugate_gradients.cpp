#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "fem/solver/preconditioned_iteration.hpp"
#include "fem/sparse/lower_blocks.hpp"

namespace articular::fem {
namespace {

/// Block Jacobi as preconditioner. Sums run in a fixed order.
class ConjugateGradients final : public LinearSolver {
 public:
  ConjugateGradients(double tolerance, int max_iterations, std::shared_ptr<ThreadPool> pool)
      : tolerance_(tolerance), max_iterations_(max_iterations), pool_(std::move(pool)) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions& x) override {
    return prepare_with_pressure(A, x, {});
  }

  using LinearSolver::prepare_with_pressure;
  FactorStatus prepare_with_pressure(const BlockMatrix& A, const Positions&,
                                     const PressurePart& part) override {
    pressure_.set(part.terms);
    A_.take(A);
    memory_.resize(3 * Eigen::Index{A.num_blocks()});
    ready_ = invert_diagonal();
    return ready_ ? FactorStatus::Ready : FactorStatus::NotPositiveDefinite;
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    assert(ready_);
    assert(b.size() == memory_.r.size());
    return preconditioned_iteration(
        [this](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
          A_.multiply(v, y, *pool_);
          pressure_.add_product(v, y);
        },
        [this](const Eigen::VectorXd& r, Eigen::VectorXd& z) { precondition(r, z); }, tolerance_,
        max_iterations_, b, x, memory_);
  }

 private:
  /// @return false where a block is not positive definite
  bool invert_diagonal() {
    inverse_diagonal_.resize(A_.diagonal().size());
    for (int i = 0; i < A_.num_blocks(); ++i) {
      const Mat3 whole = A_.diagonal()[i] + pressure_.diagonal_estimate(i);
      const Eigen::LLT<Mat3> factor(whole);
      if (factor.info() != Eigen::Success || !whole.allFinite()) return false;
      inverse_diagonal_[i] = factor.solve(Mat3::Identity());
    }
    return true;
  }

  /// z = M⁻¹ r
  void precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) const {
    for (int i = 0; i < A_.num_blocks(); ++i) {
      const Eigen::Index row = 3 * Eigen::Index{i};
      z.segment<3>(row) = inverse_diagonal_[i] * r.segment<3>(row);
    }
  }

  double tolerance_;
  int max_iterations_;
  std::shared_ptr<ThreadPool> pool_;
  LowerBlocks A_;
  std::vector<Mat3> inverse_diagonal_;
  bool ready_ = false;
  PressureOperator pressure_;
  IterationMemory memory_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_conjugate_gradients(double tolerance, int max_iterations,
                                                       std::shared_ptr<ThreadPool> pool) {
  if (!(tolerance > 0) || max_iterations < 1) {
    std::ostringstream message;
    message << "conjugate gradients: tolerance is " << tolerance << ", must be positive; at most "
            << max_iterations << " iterations, must be at least 1";
    throw std::invalid_argument(message.str());
  }
  return std::make_unique<ConjugateGradients>(tolerance, max_iterations, std::move(pool));
}

}  // namespace articular::fem
