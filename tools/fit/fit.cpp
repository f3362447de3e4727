#include "tools/fit/fit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/base/error.hpp"
#include "tools/fit/fit_runs.hpp"
#include "tools/fit/fit_values.hpp"
#include "tools/fit/least_squares.hpp"

namespace articular::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A parameter without a spread is taken to be known to this many of its difference steps, so that
/// unknowns are of one size.
constexpr double kStepsPerUnit = 20;

/// So that a limit is positive where it is broken.
double sign(const FitMeasurement& measurement) {
  return measurement.target == FitTarget::AtLeast ? -1 : 1;
}

Index count(const std::vector<FitParameter>& parameters) {
  return static_cast<Index>(parameters.size());
}

/// The problem in unknowns x = (parameter - start) / unit. Limits are residuals that are positive
/// where they are broken.
class FitProblem {
 public:
  FitProblem(const Fit& fit, const StudyRunOptions& options)
      : fit_(fit), options_(options), measured_(measurements_of(fit, FitPart::Fitted)) {
    const Index n = count(fit.parameters);
    start_.resize(n), units_.resize(n), lowest_.resize(n), highest_.resize(n);
    for (Index i = 0; i < n; ++i) {
      const FitParameter& p = parameter(i);
      start_[i] = p.start;
      units_[i] = p.spread.value_or(kStepsPerUnit * p.step);
      lowest_[i] = (p.lowest - p.start) / units_[i];
      highest_[i] = (p.highest - p.start) / units_[i];
      if (p.spread) known_.push_back(i);
      start_off_.push_back(p.known ? (p.start - *p.known) / units_[i] : 0);
    }
  }

  LeastSquaresProblem problem(int most_iterations) {
    LeastSquaresProblem problem;
    problem.start = VectorXd::Zero(start_.size());
    problem.lowest = lowest_;
    problem.highest = highest_;
    problem.residuals = static_cast<int>(measured_.size() + known_.size());
    problem.limits.resize(measured_.size() + known_.size());
    for (std::size_t k = 0; k < measured_.size(); ++k)
      problem.limits[k] = measured_[k].target != FitTarget::Value;
    problem.most_iterations = most_iterations;
    problem.evaluate = [this](const VectorXd& x, VectorXd& r) { return evaluate(x, r); };
    problem.differentiate = [this](const VectorXd& x, MatrixXd& j) { return differentiate(x, j); };
    return problem;
  }

  VectorXd parameters(const VectorXd& x) const { return start_ + units_.cwiseProduct(x); }

  /// d(misfit)/d(unknown) of the measurements where it was last asked for; none of limits that
  /// hold.
  const MatrixXd& jacobian() const { return jacobian_; }
  const VectorXd& units() const { return units_; }
  const VectorXd& misfits() const { return misfits_; }

 private:
  const FitParameter& parameter(Index i) const {
    return fit_.parameters[static_cast<std::size_t>(i)];
  }

  std::vector<TrialValues> run(const std::vector<FitTrial>& trials) const {
    try {
      return run_trials(fit_, trials, FitPart::Fitted, options_);
    } catch (const sim::InputError& error) {
      if (trials_ == 0) throw;  // the start is what the user wrote
      throw sim::InputError({fit_.file.string()},
                            fmt::format("{}, where the scenario can't be run; give `lowest` or "
                                        "`highest`. What it says: {}",
                                        gone_to(trials, error.what()), error.what()));
    }
  }

  /// Which parameters went where: those whose path is spoken of, or all. Of trials for difference
  /// quotients each changes the parameter of its name.
  std::string gone_to(const std::vector<FitTrial>& trials, const std::string& error) const {
    std::string spoken_of, all;
    for (const FitTrial& trial : trials)
      for (Index i = 0; i < trial.parameters.size(); ++i) {
        const FitParameter& p = parameter(i);
        if (trials.size() > 1 && trial.name != p.name) continue;
        const std::string text =
            fmt::format("parameter `{}` went to {:.6g}{}{}, ", p.name, trial.parameters[i],
                        p.unit.empty() ? "" : " ", p.unit);
        all += text;
        if (!p.path.empty() && error.find(p.path) != std::string::npos) spoken_of += text;
      }
    const std::string& text = spoken_of.empty() ? all : spoken_of;
    return text.substr(0, text.size() - 2);
  }

  bool evaluate(const VectorXd& x, VectorXd& r) {
    if (at_.size() == x.size() && x == at_) {  // asked for again, with the derivatives
      r = residuals_;
      return true;
    }
    const std::string name = trials_ == 0 ? "start" : fmt::format("step {}", trials_);
    const TrialValues trial = run({{name, parameters(x)}})[0];
    ++trials_;
    if (!trial.failure.empty()) return false;
    const Index m = static_cast<Index>(measured_.size());
    r.resize(m + static_cast<Index>(known_.size()));
    misfits_.resize(m);
    for (Index k = 0; k < m; ++k) {
      const FitMeasurement& measurement = measured_[static_cast<std::size_t>(k)];
      r[k] = sign(measurement) * difference_in_spreads(measurement, trial.values[k]);
      misfits_[k] = misfit(measurement, trial.values[k]);
    }
    for (std::size_t k = 0; k < known_.size(); ++k)
      r[m + static_cast<Index>(k)] = x[known_[k]] + start_off_[static_cast<std::size_t>(known_[k])];
    at_ = x;
    values_ = trial.values;
    residuals_ = r;
    if (!options_.quiet)
      fmt::print(stderr, "articular: {}: sum of squares {:.4g}\n", name,
                 misfits_.squaredNorm() + r.tail(static_cast<Index>(known_.size())).squaredNorm());
    return true;
  }

  /// By one difference quotient a parameter, away from its bound; to the other side where that run
  /// fails.
  bool differentiate(const VectorXd& x, MatrixXd& jacobian) {
    VectorXd r;
    if (!evaluate(x, r)) return false;
    const Index n = x.size(), m = static_cast<Index>(measured_.size());
    VectorXd steps(n);
    for (Index i = 0; i < n; ++i) {
      const double step = parameter(i).step / units_[i];
      steps[i] = x[i] + step > highest_[i] ? -step : step;
    }
    MatrixXd slopes(m, n);
    std::vector<Index> left;
    for (Index i = 0; i < n; ++i) left.push_back(i);
    for (int side = 0; side < 2 && !left.empty(); ++side) {
      left = difference_quotients(x, steps, left, slopes);
      steps = -steps;
    }
    if (!left.empty()) return false;
    jacobian_ = MatrixXd::Zero(m, n);
    jacobian.setZero(m + static_cast<Index>(known_.size()), n);
    for (Index k = 0; k < m; ++k) {
      const FitMeasurement& measurement = measured_[static_cast<std::size_t>(k)];
      jacobian.row(k) = sign(measurement) * slopes.row(k) / measurement.spread;
      if (misfits_[k] != 0 || measurement.target == FitTarget::Value)
        jacobian_.row(k) = slopes.row(k) / measurement.spread;
    }
    for (std::size_t k = 0; k < known_.size(); ++k)
      jacobian(m + static_cast<Index>(k), known_[k]) = 1;
    return true;
  }

  /// @return those parameters whose runs failed
  std::vector<Index> difference_quotients(const VectorXd& x, const VectorXd& steps,
                                          const std::vector<Index>& wanted, MatrixXd& slopes) {
    std::vector<FitTrial> trials;
    for (const Index i : wanted) {
      VectorXd changed = x;
      changed[i] += steps[i];
      trials.push_back({parameter(i).name, parameters(changed)});
    }
    const std::vector<TrialValues> results = run(trials);
    std::vector<Index> failed;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (results[k].failure.empty())
        slopes.col(wanted[k]) = (results[k].values - values_) / steps[wanted[k]];
      else
        failed.push_back(wanted[k]);
    }
    return failed;
  }

  const Fit& fit_;
  const StudyRunOptions& options_;
  std::vector<FitMeasurement> measured_;
  std::vector<Index> known_;       // parameters with a spread
  std::vector<double> start_off_;  // (start - what is known before) / unit
  VectorXd start_, units_, lowest_, highest_;
  int trials_ = 0;
  VectorXd at_, values_, residuals_, misfits_;  // of the last evaluation
  MatrixXd jacobian_;
};

/// What the measurements determine near the unknowns x, in the parameters' units.
Determination determination_near(const VectorXd& x, const Fit& fit,
                                 const LeastSquaresProblem& least_squares,
                                 const FitProblem& problem) {
  VectorXd residuals;
  MatrixXd jacobian;
  if (!least_squares.evaluate(x, residuals) || !least_squares.differentiate(x, jacobian))
    throw sim::SimulationError("the scenario does not run near the fitted parameters");
  VectorXd spreads(x.size());
  for (Index i = 0; i < spreads.size(); ++i)
    spreads[i] = fit.parameters[static_cast<std::size_t>(i)].spread
                     ? 1
                     : std::numeric_limits<double>::infinity();
  Determination determination = determine(problem.jacobian(), spreads, problem.misfits());
  determination.widths = determination.widths.cwiseProduct(problem.units());
  return determination;
}

/// All measurements at one place, those held out too.
VectorXd all_values(const Fit& fit, const FitTrial& trial, const StudyRunOptions& options) {
  const TrialValues values = run_trials(fit, {trial}, FitPart::All, options)[0];
  if (!values.failure.empty())
    throw sim::SimulationError("the scenario does not run with these parameters: " +
                               values.failure);
  return values.values;
}

}  // namespace

FitResult fit_parameters(const Fit& fit, int most_iterations, const StudyRunOptions& options,
                         FitWidths widths) {
  FitProblem problem(fit, options);
  FitResult result;
  // First, so that a mistake in what is held out is found before the work.
  result.before = all_values(
      fit, {"start", problem.parameters(VectorXd::Zero(count(fit.parameters)))}, options);
  const LeastSquaresProblem least_squares = problem.problem(most_iterations);
  const LeastSquaresSolution solution = minimise(least_squares);
  result.parameters = problem.parameters(solution.x);
  result.iterations = solution.iterations;
  result.converged = solution.converged;
  result.message = solution.message;
  if (widths == FitWidths::Found)
    result.determination = determination_near(solution.x, fit, least_squares, problem);
  result.after = all_values(fit, {"fitted", result.parameters}, options);
  return result;
}

}  // namespace articular::tools
