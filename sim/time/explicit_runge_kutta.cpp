#include <arkode/arkode_arkstep.h>

#include <algorithm>

#include "sim/model/newton_weights.hpp"
#include "sim/time/arkode.hpp"
#include "sim/time/explicit_limit.hpp"
#include "sim/time/rate_callback.hpp"
#include "sim/time/runge_kutta.hpp"

namespace articular::sim {
namespace {

using sundials::check;
using sundials::view;

constexpr ARKODE_ERKTableID kTable = ARKODE_BOGACKI_SHAMPINE_4_2_3;

class ExplicitRungeKutta final : public TimeIntegrator {
 public:
  ExplicitRungeKutta(const Model& model, Dynamics& dynamics, const StepSettings& settings,
                     ExplicitSteps steps);
  std::optional<double> advance(Eigen::VectorXd& y, double t, double h) override;
  void restart(double next_step) override { next_step_ = next_step; }
  std::optional<double> next_step() const override {
    return fixed_ ? std::nullopt : std::optional(next_step_);
  }
  const SolverCounts& counts() const override { return counts_; }
  double solve_seconds() const override { return 0; }

 private:
  static int rate(realtype t, N_Vector y, N_Vector y_dot, void* data);
  static int weights(N_Vector, N_Vector w, void* data);

  const Model& model_;
  Dynamics& dynamics_;
  const double longest_step_;  // [s]
  const bool fixed_;
  SolverCounts counts_;
  double next_step_ = 0;   // [s]
  Conditions conditions_;  // of the step
  std::exception_ptr error_;
  sundials::Context context_;
  sundials::Vector y_;
  sundials::Arkode arkode_;
};

int ExplicitRungeKutta::rate(realtype t, N_Vector y, N_Vector y_dot, void* data) {
  auto& self = *static_cast<ExplicitRungeKutta*>(data);
  return sundials::evaluate_rate(self, self.dynamics_, self.conditions_, self.counts_, self.error_,
                                 t, y, y_dot);
}

/// Velocities against what moves the tolerance in the longest step: what steps are shorter for is
/// stability, whose limit has nothing to do with the accuracy that is asked for.
int ExplicitRungeKutta::weights(N_Vector, N_Vector w, void* data) {
  const auto& self = *static_cast<const ExplicitRungeKutta*>(data);
  set_weights(self.model_, self.longest_step_, view(w));
  return 0;
}

ExplicitRungeKutta::ExplicitRungeKutta(const Model& model, Dynamics& dynamics,
                                       const StepSettings& settings, ExplicitSteps steps)
    : model_(model),
      dynamics_(dynamics),
      longest_step_(settings.step),
      fixed_(steps == ExplicitSteps::Fixed),
      context_(sundials::make_context()),
      y_(sundials::make_vector(model.layout.size(), context_)),
      arkode_(ARKStepCreate(rate, nullptr, 0, y_.get(), context_.get())) {
  if (!arkode_) throw std::runtime_error("ARKStepCreate failed");
  void* arkode = arkode_.get();
  check(ARKStepSetErrHandlerFn(arkode, sundials::ignore_message, nullptr),
        "ARKStepSetErrHandlerFn");
  check(ARKStepSetUserData(arkode, this), "ARKStepSetUserData");
  check(ARKStepWFtolerances(arkode, weights), "ARKStepWFtolerances");
  check(ARKStepSetTableNum(arkode, ARKODE_DIRK_NONE, kTable), "ARKStepSetTableNum");
  if (fixed_) return;
  check(ARKStepSetMaxStep(arkode, longest_step_), "ARKStepSetMaxStep");
}

std::optional<double> ExplicitRungeKutta::advance(Eigen::VectorXd& y, double t, double h) {
  view(y_) = y;
  conditions_.step_start = t;
  void* arkode = arkode_.get();
  check(ARKStepReset(arkode, t, y_.get()), "ARKStepReset");
  if (fixed_)
    check(ARKStepSetFixedStep(arkode, h), "ARKStepSetFixedStep");
  else
    check(ARKStepSetInitStep(arkode, std::min(next_step_, h)), "ARKStepSetInitStep");
  check(ARKStepSetStopTime(arkode, t + h), "ARKStepSetStopTime");
  double reached = t;
  const int flag = ARKStepEvolve(arkode, t + h, y_.get(), &reached, ARK_ONE_STEP);
  sundials::rethrow(error_);
  switch (flag) {
    case ARK_ERR_FAILURE:
    case ARK_TOO_MUCH_ACC:  // so much motion that its round-off is beyond the tolerance
    case ARK_RHSFUNC_FAIL:  // forces that are not finite
    case ARK_FIRST_RHSFUNC_ERR:
    case ARK_REPTD_RHSFUNC_ERR:
    case ARK_UNREC_RHSFUNC_ERR:
      break;
    default:
      check(flag, "ARKStepEvolve");
  }
  if (flag < 0 || !view(y_).allFinite()) {
    ++counts_.rejected_newton;
    next_step_ = 0.1 * std::min(next_step_, h);
    return std::nullopt;
  }
  // A step that was cut short by the stop says nothing of what accuracy allows.
  double next = 0;
  check(ARKStepGetCurrentStep(arkode, &next), "ARKStepGetCurrentStep");
  if (reached < t + h || next > next_step_) next_step_ = next;
  ++counts_.steps;
  y = view(y_);
  for (int r = 0; r < model_.layout.num_rigid; ++r)
    y.segment<4>(model_.layout.rigid_q(r)).normalize();
  return reached;
}

}  // namespace

std::unique_ptr<TimeIntegrator> make_explicit_runge_kutta(const Model& model, Dynamics& dynamics,
                                                          const StepSettings& settings,
                                                          ExplicitSteps steps) {
  return std::make_unique<ExplicitRungeKutta>(model, dynamics, settings, steps);
}

std::vector<double> explicit_growth() {
  const sundials::ButcherTable table(ARKodeButcherTable_LoadERK(kTable));
  if (!table) throw std::runtime_error("ARKodeButcherTable_LoadERK failed");
  const int stages = table->stages;
  Eigen::MatrixXd A(stages, stages);
  Eigen::VectorXd b(stages), power = Eigen::VectorXd::Ones(stages);
  for (int i = 0; i < stages; ++i) {
    b[i] = table->b[i];
    for (int j = 0; j < stages; ++j) A(i, j) = table->A[i][j];
  }
  std::vector<double> coefficients = {1};
  for (int k = 0; k < stages; ++k) {
    coefficients.push_back(b.dot(power));
    power = A * power;
  }
  return coefficients;
}

}  // namespace articular::sim
