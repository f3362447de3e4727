#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "fem/sparse/signed_cholesky.hpp"

namespace articular::fem {
namespace {

class Cholesky final : public LinearSolver {
 public:
  explicit Cholesky(std::shared_ptr<ThreadPool> pool) : factor_(std::move(pool)) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions&) override {
    if (matrix_.size() == 0 || A.pattern_id() != pattern_id_) analyze(A);
    copy_values(A, matrix_.value.data());
    ready_ = factor_.factorize(matrix_) == Pivots::Right;
    return ready_ ? FactorStatus::Ready : FactorStatus::NotPositiveDefinite;
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    assert(ready_ && b.size() == matrix_.size());
    SolveReport report;
    const double b_norm = b.norm();
    x = b;
    if (b_norm == 0) return report;
    factor_.solve(x);
    matrix_.multiply(x, residual_);
    report.relative_residual = (b - residual_).norm() / b_norm;
    report.converged = std::isfinite(report.relative_residual);
    return report;
  }

 private:
  void analyze(const BlockMatrix& A) {
    matrix_ = {};
    append_pattern(A, matrix_);
    matrix_.value.resize(matrix_.row.size());
    const auto n = static_cast<std::size_t>(matrix_.size());
    factor_.analyze(matrix_, std::vector<int>(n, 1), groups_of_three(A.num_blocks()));
    pattern_id_ = A.pattern_id();
  }

  SymmetricMatrix matrix_;
  SignedCholesky<double> factor_;
  Eigen::VectorXd residual_;
  std::uint64_t pattern_id_ = 0;
  bool ready_ = false;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholesky(std::shared_ptr<ThreadPool> pool) {
  return std::make_unique<Cholesky>(std::move(pool));
}

}  // namespace articular::fem
