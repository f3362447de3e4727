#include <Eigen/Eigenvalues>
#include <cassert>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/solver/linear_solver.hpp"

namespace articular::fem {
namespace {

// Directions in the span of the solutions with less than this part of the largest energy are noise.
constexpr double kNoise = 1e-10;  // [-]

/// Starts from the x = Σ c_k x_k, over the last solutions x_k, that is best in the energy norm:
/// (x_kᵀ A x_l) c = x_kᵀ b [Fischer 1998, method 1, over a window of solutions].
///
/// [Fischer 1998] Fischer. Projection techniques for iterative solution of Ax = b with successive
/// right-hand sides. Computer Methods in Applied Mechanics and Engineering 163.
class ProjectedStart final : public LinearSolver {
 public:
  ProjectedStart(std::unique_ptr<LinearSolver> solver, int num_kept)
      : solver_(std::move(solver)), num_kept_(static_cast<std::size_t>(num_kept)) {}

  using LinearSolver::prepare;
  FactorStatus prepare(const BlockMatrix& A, const Positions& x) override {
    update_kept(A, {});
    return solver_->prepare(A, x);
  }

  using LinearSolver::prepare_with_pressure;
  FactorStatus prepare_with_pressure(const BlockMatrix& A, const Positions& x,
                                     const PressurePart& part) override {
    update_kept(A, part.terms);
    return solver_->prepare_with_pressure(A, x, part);
  }

  SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) override {
    find_start(b, x);
    const SolveReport report = solver_->solve(b, x);
    if (report.converged && x.squaredNorm() > 0) keep(b, x);
    return report;
  }

 private:
  struct Kept {
    Eigen::VectorXd x, A_x;
  };

  void update_kept(const BlockMatrix& A, std::span<const PressureTerm> terms) {
    if (!kept_.empty() && kept_[0].x.size() != 3 * Eigen::Index{A.num_blocks()}) {
      kept_.clear();
      oldest_ = 0;
    }
    pressure_.set(terms);
    for (Kept& kept : kept_) {
      A.multiply(kept.x, kept.A_x);
      pressure_.add_product(kept.x, kept.A_x);
    }
  }

  void find_start(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    x.setZero(b.size());
    const auto n = static_cast<Eigen::Index>(kept_.size());
    if (n == 0) return;
    Eigen::MatrixXd energy(n, n);
    Eigen::VectorXd work(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      for (Eigen::Index l = 0; l <= k; ++l) energy(k, l) = kept_[k].A_x.dot(kept_[l].x);
      work[k] = kept_[k].x.dot(b);
    }
    const Eigen::VectorXd scale = energy.diagonal().cwiseSqrt().cwiseInverse();
    if (!scale.allFinite()) return;
    energy = scale.asDiagonal() * energy * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(energy);  // of the lower half
    Eigen::VectorXd part = modes.eigenvectors().transpose() * scale.cwiseProduct(work);
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool noise = !(modes.eigenvalues()[k] > kNoise * modes.eigenvalues()[n - 1]);
      part[k] = noise ? 0 : part[k] / modes.eigenvalues()[k];
    }
    const Eigen::VectorXd c = scale.cwiseProduct(modes.eigenvectors() * part);
    if (!c.allFinite()) return;
    residual_ = b;
    for (Eigen::Index k = 0; k < n; ++k) residual_ -= c[k] * kept_[k].A_x;
    if (!(residual_.norm() < b.norm())) return;  // nearer in energy, and farther from the goal
    for (Eigen::Index k = 0; k < n; ++k) x += c[k] * kept_[k].x;
  }

  /// A x = b up to the solver's tolerance: no product is needed until A changes.
  void keep(const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
    if (kept_.size() < num_kept_) {
      kept_.push_back({x, b});
      return;
    }
    Kept& oldest = kept_[oldest_];
    oldest.x = x;
    oldest.A_x = b;
    oldest_ = (oldest_ + 1) % num_kept_;
  }

  std::unique_ptr<LinearSolver> solver_;
  std::size_t num_kept_, oldest_ = 0;
  std::vector<Kept> kept_;
  PressureOperator pressure_;
  Eigen::VectorXd residual_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_projected_start(std::unique_ptr<LinearSolver> solver,
                                                   int num_kept) {
  if (!solver || num_kept < 1) {
    std::ostringstream message;
    message << "start values from " << num_kept
            << " solutions, must be at least 1 and have a solver";
    throw std::invalid_argument(message.str());
  }
  return std::make_unique<ProjectedStart>(std::move(solver), num_kept);
}

}  // namespace articular::fem
