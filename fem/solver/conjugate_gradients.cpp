#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "fem/solver/preconditioned_iteration.hpp"

namespace articular::fem {
namespace {

/// Block Jacobi as preconditioner. Only the lower half of A is kept, and of that what is not zero
/// (couplings of contacts that might close, or have opened, are): a product takes as long as
/// reading it from memory. Sums run in a fixed order.
class ConjugateGradients final : public LinearSolver {
 public:
  ConjugateGradients(double tolerance, int max_iterations)
      : tolerance_(tolerance), max_iterations_(max_iterations) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions& x) override {
    return prepare_with_pressure(A, x, {});
  }

  using LinearSolver::prepare_with_pressure;
  FactorStatus prepare_with_pressure(const BlockMatrix& A, const Positions&,
                                     const PressurePart& part) override {
    pressure_.set(part.terms);
    if (A.num_blocks() != num_blocks() || A.pattern_id() != pattern_id_) take_pattern(A);
    take_blocks(A);
    ready_ = false;
    for (int i = 0; i < num_blocks(); ++i) {
      // The lower half is mirrored, as in the off-diagonal blocks.
      diagonal_[i] = Mat3(A.block(diagonal_slot_[i])).selfadjointView<Eigen::Lower>();
      const Mat3 whole = diagonal_[i] + pressure_.diagonal_estimate(i);
      const Eigen::LLT<Mat3> factor(whole);
      if (factor.info() != Eigen::Success || !whole.allFinite()) {
        return FactorStatus::NotPositiveDefinite;
      }
      inverse_diagonal_[i] = factor.solve(Mat3::Identity());
    }
    ready_ = true;
    return FactorStatus::Ready;
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    assert(ready_);
    assert(b.size() == memory_.r.size());
    return preconditioned_iteration(
        [this](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
          multiply(v, y);
          pressure_.add_product(v, y);
        },
        [this](const Eigen::VectorXd& r, Eigen::VectorXd& z) { precondition(r, z); }, tolerance_,
        max_iterations_, b, x, memory_);
  }

 private:
  int num_blocks() const { return static_cast<int>(diagonal_.size()); }

  void take_pattern(const BlockMatrix& A) {
    pattern_id_ = A.pattern_id();
    const auto n = static_cast<std::size_t>(A.num_blocks());
    diagonal_slot_.resize(n);
    for (int i = 0; i < A.num_blocks(); ++i) diagonal_slot_[i] = A.slot(i, i);
    diagonal_.resize(n);
    inverse_diagonal_.resize(n);
    memory_.resize(3 * Eigen::Index{A.num_blocks()});
  }

  void take_blocks(const BlockMatrix& A) {
    row_begin_.assign(1, 0);
    column_.clear();
    lower_.clear();
    for (int i = 0; i < num_blocks(); ++i) {
      for (int s = A.row_begin()[i]; s < diagonal_slot_[i]; ++s) {
        const Eigen::Map<const Mat3> block = A.block(s);
        if ((block.array() == 0).all()) continue;
        column_.push_back(A.column()[s]);
        lower_.push_back(block);
      }
      row_begin_.push_back(static_cast<int>(column_.size()));
    }
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

  /// z = M⁻¹ r
  void precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) const {
    for (int i = 0; i < num_blocks(); ++i) {
      const Eigen::Index row = 3 * Eigen::Index{i};
      z.segment<3>(row) = inverse_diagonal_[i] * r.segment<3>(row);
    }
  }

  double tolerance_;
  int max_iterations_;
  bool ready_ = false;
  std::uint64_t pattern_id_ = 0;
  std::vector<int> diagonal_slot_;          // where A holds the blocks of the diagonal
  std::vector<int> row_begin_{0}, column_;  // of the blocks below it that are not zero
  std::vector<Mat3> lower_, diagonal_, inverse_diagonal_;
  PressureOperator pressure_;
  IterationMemory memory_;
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
