#include "tools/fit/least_squares.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace articular::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool is_limit(const LeastSquaresProblem& problem, Index i) {
  return !problem.limits.empty() && problem.limits[static_cast<std::size_t>(i)];
}

/// What counts of residuals.
VectorXd counted(const LeastSquaresProblem& problem, VectorXd r) {
  for (Index i = 0; i < r.size(); ++i)
    if (is_limit(problem, i)) r[i] = std::max(r[i], 0.0);
  return r;
}

/// r and J at x; the model of a step d from there is r + J d, and `damping` holds it back by
/// damping_i d_i^2 / 2.
struct Model {
  VectorXd x, r;
  MatrixXd jacobian;
  VectorXd damping;
};

/// Residuals of the model as Ceres asks for them: those of the problem, then of the damping.
class ModelResiduals : public ceres::CostFunction {
 public:
  ModelResiduals(const LeastSquaresProblem& problem, const Model& model)
      : problem_(problem), model_(model) {
    set_num_residuals(static_cast<int>(model.r.size() + model.x.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.x.size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index m = model_.r.size(), n = model_.x.size();
    const Eigen::Map<const VectorXd> d(parameters[0], n);
    const VectorXd r = counted(problem_, model_.r + model_.jacobian * d);
    Eigen::Map<VectorXd>(residuals, m) = r;
    Eigen::Map<VectorXd>(residuals + m, n) = model_.damping.cwiseSqrt().cwiseProduct(d);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
        jacobians[0], m + n, n);
    jacobian.topRows(m) = model_.jacobian;
    for (Index i = 0; i < m; ++i)
      if (is_limit(problem_, i) && r[i] == 0) jacobian.row(i).setZero();
    jacobian.bottomRows(n) = model_.damping.cwiseSqrt().asDiagonal();
    return true;
  }

 private:
  const LeastSquaresProblem& problem_;
  const Model& model_;
};

VectorXd slope_of(const LeastSquaresProblem& problem, const Model& model, const VectorXd& d) {
  return model.jacobian.transpose() * counted(problem, model.r + model.jacobian * d) +
         model.damping.cwiseProduct(d);
}

/// The components of d at a bound beyond which the model would fall.
std::vector<int> held_by_bounds(const LeastSquaresProblem& problem, const Model& model,
                                const VectorXd& d) {
  const VectorXd slope = slope_of(problem, model, d), x = model.x + d;
  std::vector<int> held;
  for (Index i = 0; i < x.size(); ++i)
    if ((x[i] <= problem.lowest[i] && slope[i] > 0) || (x[i] >= problem.highest[i] && slope[i] < 0))
      held.push_back(static_cast<int>(i));
  return held;
}

/// Minimises the model from d on, with some components as they are. Ceres cuts a correction at
/// bounds but does not know which of them hold: with one that holds it would creep.
void improve(const LeastSquaresProblem& problem, const Model& model, const std::vector<int>& kept,
             VectorXd& d) {
  const int n = static_cast<int>(d.size());
  if (kept.size() == static_cast<std::size_t>(n)) return;
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new ModelResiduals(problem, model), nullptr, d.data());
  for (int i = 0; i < n; ++i) {
    if (std::isfinite(problem.lowest[i]))
      ceres_problem.SetParameterLowerBound(d.data(), i, problem.lowest[i] - model.x[i]);
    if (std::isfinite(problem.highest[i]))
      ceres_problem.SetParameterUpperBound(d.data(), i, problem.highest[i] - model.x[i]);
  }
  if (!kept.empty()) ceres_problem.SetManifold(d.data(), new ceres::SubsetManifold(n, kept));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
}

/// The step to the least of the model within bounds.
VectorXd step_of(const LeastSquaresProblem& problem, const Model& model) {
  VectorXd d = VectorXd::Zero(model.x.size());
  std::vector<int> kept = held_by_bounds(problem, model, d);
  for (Index i = 0; i <= d.size(); ++i) {  // each time one more is kept at least
    improve(problem, model, kept, d);
    const std::vector<int> held = held_by_bounds(problem, model, d);
    if (held == kept) break;
    kept = held;
  }
  // A difference and a sum later it may have left a bound by a rounding.
  return (model.x + d).cwiseMax(problem.lowest).cwiseMin(problem.highest) - model.x;
}

/// Marquardt's scales: how much each unknown moves the residuals that count.
VectorXd scales_of(const LeastSquaresProblem& problem, const Model& model) {
  const VectorXd r = counted(problem, model.r);
  VectorXd scales = VectorXd::Constant(model.x.size(), 1e-6);
  for (Index i = 0; i < r.size(); ++i)
    if (!is_limit(problem, i) || r[i] > 0) scales += model.jacobian.row(i).transpose().cwiseAbs2();
  return scales;
}

double half_sum(const LeastSquaresProblem& problem, const VectorXd& r) {
  return counted(problem, r).squaredNorm() / 2;
}

/// How far steps are held back, by how well the model foresaw the last ones.
struct Damping {
  double factor = 0.1, growth = 2;

  void after_a_fall(double fall, double predicted) {
    const double ratio = predicted > 0 ? fall / predicted : 1;
    factor *= std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3));
    growth = 2;
  }
  void after_a_rise() {
    factor *= growth;
    growth *= 2;
  }
};

}  // namespace

LeastSquaresSolution minimise(const LeastSquaresProblem& problem) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres' opinions are no news for the terminal
  Model model;
  model.x = problem.start;
  int iterations = 0;
  const auto end = [&](bool converged, const char* why) {
    return LeastSquaresSolution{model.x, iterations, converged, why};
  };
  if (!problem.evaluate(model.x, model.r) || !problem.differentiate(model.x, model.jacobian))
    return end(false, "there are no residuals at the start");
  Damping damping;
  while (iterations < problem.most_iterations) {
    model.damping = damping.factor * scales_of(problem, model);
    const VectorXd d = step_of(problem, model);
    if (d.norm() <= problem.tolerance * (model.x.norm() + problem.tolerance))
      return end(true, "the next step is short");
    ++iterations;
    const double before = half_sum(problem, model.r);
    const VectorXd x = model.x + d;
    VectorXd r;
    const double fall = problem.evaluate(x, r) ? before - half_sum(problem, r) : -1;
    if (!(fall > 0)) {
      damping.after_a_rise();
      continue;
    }
    damping.after_a_fall(fall, before - half_sum(problem, model.r + model.jacobian * d));
    model.x = x;
    model.r = r;
    if (fall < problem.tolerance * before) return end(true, "the last step hardly lowered the sum");
    if (!problem.differentiate(model.x, model.jacobian))
      return end(false, "there are no slopes where it arrived");
  }
  return end(false, "the most iterations are made");
}

}  // namespace articular::tools
