#include "sim/time/bdf.hpp"

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <cvode/cvode_proj.h>

#include <algorithm>
#include <cmath>

#include "sim/model/newton_weights.hpp"
#include "sim/time/rate_callback.hpp"

namespace articular::sim {
namespace {

using sundials::check;
using sundials::guarded;
using sundials::view;

struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

class Bdf final : public TimeIntegrator {
 public:
  Bdf(const Model& model, Dynamics& dynamics, const StepSettings& settings);
  std::optional<double> advance(Eigen::VectorXd& y, double t, double h) override;
  void restart(double next_step) override {
    newton_.restart();
    next_step_ = next_step;
    t_last_ = std::nullopt;
    keep_matrix_ = false;
  }
  std::optional<double> next_step() const override { return next_step_; }
  const SolverCounts& counts() const override { return counts_; }
  double solve_seconds() const override { return newton_.solve_seconds(); }

 private:
  static int rate(realtype t, N_Vector y, N_Vector y_dot, void* data);
  static int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype);
  static int weights(N_Vector, N_Vector w, void* data);
  static int project(realtype, N_Vector y, N_Vector correction, realtype, N_Vector, void* data);

  const Model& model_;
  Dynamics& dynamics_;
  const double longest_step_;  // [s]
  NewtonSystem newton_;
  SolverCounts counts_;
  double next_step_ = 0;          // [s]
  std::optional<double> t_last_;  // [s] that the history ends at
  Eigen::VectorXd y_last_;
  bool keep_matrix_ = false;
  std::exception_ptr error_;
  sundials::Context context_;
  sundials::Vector y_;
  sundials::Solver solver_;
  sundials::Owned<void*, FreeCvode> cvode_;
};

int Bdf::rate(realtype t, N_Vector y, N_Vector y_dot, void* data) {
  auto& self = *static_cast<Bdf*>(data);
  return sundials::evaluate_rate(self, self.dynamics_, self.counts_, self.error_, t, y, y_dot);
}

int Bdf::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  auto& self = *static_cast<Bdf*>(solver->content);
  return guarded(self.error_, [&] {
    double gamma = 0;
    N_Vector y = nullptr;
    check(CVodeGetCurrentGamma(self.cvode_.get(), &gamma), "CVodeGetCurrentGamma");
    check(CVodeGetCurrentState(self.cvode_.get(), &y), "CVodeGetCurrentState");
    return sundials::correct(self.newton_, self.counts_, gamma, y, x, b);
  });
}

int Bdf::weights(N_Vector, N_Vector w, void* data) {
  const auto& self = *static_cast<const Bdf*>(data);
  set_weights(self.model_, self.longest_step_, view(w));
  return 0;
}

/// Quaternions back to unit length.
int Bdf::project(realtype, N_Vector y, N_Vector correction, realtype, N_Vector, void* data) {
  const auto& self = *static_cast<const Bdf*>(data);
  auto change = view(correction);
  change.setZero();
  for (int r = 0; r < self.model_.layout.num_rigid; ++r) {
    const int row = self.model_.layout.rigid_q(r);
    const Eigen::Vector4d q = view(y).segment<4>(row);
    change.segment<4>(row) = q.normalized() - q;
  }
  return 0;
}

Bdf::Bdf(const Model& model, Dynamics& dynamics, const StepSettings& settings)
    : model_(model),
      dynamics_(dynamics),
      longest_step_(settings.step),
      newton_(model, dynamics),
      context_(sundials::make_context()),
      y_(sundials::make_vector(model.layout.size(), context_)),
      solver_(sundials::make_solver(context_, this, sundials::matrix_embedded, solve)),
      cvode_(CVodeCreate(CV_BDF, context_.get())) {
  if (!cvode_) throw std::runtime_error("CVodeCreate failed");
  void* cvode = cvode_.get();
  check(CVodeSetErrHandlerFn(cvode, sundials::ignore_message, nullptr), "CVodeSetErrHandlerFn");
  check(CVodeInit(cvode, rate, 0, y_.get()), "CVodeInit");
  check(CVodeSetUserData(cvode, this), "CVodeSetUserData");
  check(CVodeWFtolerances(cvode, weights), "CVodeWFtolerances");
  check(CVodeSetLinearSolver(cvode, solver_.get(), nullptr), "CVodeSetLinearSolver");
  check(CVodeSetMaxNonlinIters(cvode, settings.max_iterations), "CVodeSetMaxNonlinIters");
  check(CVodeSetMaxStep(cvode, longest_step_), "CVodeSetMaxStep");
  // Orders 3 to 5 amplify oscillations near the imaginary axis, and tissue is hardly damped.
  check(CVodeSetMaxOrd(cvode, 2), "CVodeSetMaxOrd");
  if (model.layout.num_rigid > 0) {
    check(CVodeSetProjFn(cvode, project), "CVodeSetProjFn");
    check(CVodeSetProjErrEst(cvode, SUNFALSE), "CVodeSetProjErrEst");
  }
}

std::optional<double> Bdf::advance(Eigen::VectorXd& y, double t, double h) {
  void* cvode = cvode_.get();
  if (!t_last_ || *t_last_ != t || y_last_ != y) {
    view(y_) = y;
    check(CVodeReInit(cvode, t, y_.get()), "CVodeReInit");
    check(CVodeSetInitStep(cvode, std::min(next_step_, h)), "CVodeSetInitStep");
    keep_matrix_ = false;
  }
  t_last_ = std::nullopt;
  check(CVodeSetStopTime(cvode, t + h), "CVodeSetStopTime");
  newton_.begin_step(keep_matrix_, fem::Tangent::Consistent);
  double reached = t;
  const int flag = CVode(cvode, t + h, y_.get(), &reached, CV_ONE_STEP);
  sundials::rethrow(error_);
  switch (flag) {
    case CV_CONV_FAILURE:
    case CV_ERR_FAILURE:
    case CV_LSOLVE_FAIL:
    case CV_PROJFUNC_FAIL:
    case CV_REPTD_PROJFUNC_ERR:
    case CV_RHSFUNC_FAIL:  // forces that are not finite
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      break;
    default:
      check(flag, "CVode");
  }
  if (flag < 0 || !view(y_).allFinite()) {
    ++counts_.rejected_newton;
    next_step_ = 0.1 * std::min(next_step_, h);
    return std::nullopt;
  }
  check(CVodeGetCurrentStep(cvode, &next_step_), "CVodeGetCurrentStep");
  ++counts_.steps;
  keep_matrix_ = true;
  t_last_ = reached;
  y = y_last_ = view(y_);
  return reached;
}

}  // namespace

std::unique_ptr<TimeIntegrator> make_bdf(const Model& model, Dynamics& dynamics,
                                         const StepSettings& settings) {
  return std::make_unique<Bdf>(model, dynamics, settings);
}

}  // namespace articular::sim
