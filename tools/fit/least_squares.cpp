#include "tools/fit/least_squares.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <exception>
#include <vector>

namespace articular::tools {
namespace {

/// The problem as Ceres asks for it. Ceres does not expect exceptions: the first one is kept, and
/// everything after it fails.
class Residuals : public ceres::CostFunction {
 public:
  explicit Residuals(const LeastSquaresProblem& problem) : problem_(problem) {
    set_num_residuals(problem.residuals);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.start.size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    if (error_) return false;
    try {
      return evaluate(parameters[0], residuals, jacobians != nullptr ? jacobians[0] : nullptr);
    } catch (...) {
      error_ = std::current_exception();
      return false;
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  bool evaluate(const double* unknowns, double* residuals, double* jacobian) const {
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(unknowns, problem_.start.size());
    Eigen::VectorXd r;
    if (!problem_.evaluate(x, r)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, problem_.residuals) = r;
    if (jacobian == nullptr) return true;
    Eigen::MatrixXd derivative;
    if (!problem_.differentiate(x, derivative)) return false;
    Eigen::Map<RowMajor>(jacobian, derivative.rows(), derivative.cols()) = derivative;
    return true;
  }

  const LeastSquaresProblem& problem_;
  mutable std::exception_ptr error_;
};

ceres::Solver::Options options_of(const LeastSquaresProblem& problem, int most_iterations) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = most_iterations;
  options.function_tolerance = options.parameter_tolerance = problem.tolerance;
  options.initial_trust_region_radius = 10;
  return options;
}

/// Solves from solution.x on, with these unknowns as they are. Ceres cuts a correction at bounds
/// but does not know which of them hold: with one that holds it would creep.
void solve(const LeastSquaresProblem& problem, const std::vector<int>& kept,
           LeastSquaresSolution& solution) {
  const int n = static_cast<int>(solution.x.size());
  if (kept.size() == static_cast<std::size_t>(n)) return;
  ceres::Problem ceres_problem;
  auto* residuals = new Residuals(problem);  // Ceres takes it over
  double* const x = solution.x.data();
  ceres_problem.AddResidualBlock(residuals, nullptr, x);
  for (int i = 0; i < n; ++i) {
    if (std::isfinite(problem.lowest[i]))
      ceres_problem.SetParameterLowerBound(x, i, problem.lowest[i]);
    if (std::isfinite(problem.highest[i]))
      ceres_problem.SetParameterUpperBound(x, i, problem.highest[i]);
  }
  if (!kept.empty()) ceres_problem.SetManifold(x, new ceres::SubsetManifold(n, kept));
  ceres::Solver::Summary summary;
  ceres::Solve(options_of(problem, problem.most_iterations - solution.iterations), &ceres_problem,
               &summary);
  residuals->rethrow();
  solution.iterations += static_cast<int>(summary.iterations.size()) - 1;
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  solution.message = summary.message;
}

/// The unknowns at a bound beyond which the sum of squares would fall.
std::vector<int> held_by_bounds(const LeastSquaresProblem& problem, const Eigen::VectorXd& x) {
  const bool any =
      (x.array() <= problem.lowest.array()).any() || (x.array() >= problem.highest.array()).any();
  Eigen::VectorXd r;
  Eigen::MatrixXd jacobian;
  if (!any || !problem.evaluate(x, r) || !problem.differentiate(x, jacobian)) return {};
  const Eigen::VectorXd slope = jacobian.transpose() * r;
  std::vector<int> held;
  for (int i = 0; i < static_cast<int>(x.size()); ++i)
    if ((x[i] <= problem.lowest[i] && slope[i] > 0) || (x[i] >= problem.highest[i] && slope[i] < 0))
      held.push_back(i);
  return held;
}

}  // namespace

LeastSquaresSolution minimise(const LeastSquaresProblem& problem) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // a step that fails is no news for the terminal
  LeastSquaresSolution solution;
  solution.x = problem.start;
  std::vector<int> kept;
  while (solution.iterations < problem.most_iterations) {
    const int before = solution.iterations;
    solve(problem, kept, solution);
    const std::vector<int> held = held_by_bounds(problem, solution.x);
    if (held == kept || (solution.iterations == before && !kept.empty())) break;
    kept = held;
  }
  return solution;
}

}  // namespace articular::tools
