#include <arkode/arkode_arkstep.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/contact/touch_left.hpp"
#include "sim/model/angular_momentum.hpp"
#include "sim/model/newton_weights.hpp"
#include "sim/time/arkode.hpp"
#include "sim/time/newton_system.hpp"
#include "sim/time/rate_callback.hpp"
#include "sim/time/runge_kutta.hpp"

namespace articular::sim {
namespace {

using sundials::check;
using sundials::guarded_solve;
using sundials::view;

struct FreeNonlinear {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};

/// Newton's correction is converged when it is below this part of the tolerances.
constexpr double kNewtonFraction = 0.1;
/// Of that part: residuals below count as none.
constexpr double kLeastResidual = 1e-12;
/// With stiff contact, a second try searches corrections from this one on for how far they may go.
constexpr int kSearchesFrom = 8, kNever = std::numeric_limits<int>::max();
/// Contact that opens and closes makes corrections grow for an iteration or two; ARKODE's limit of
/// 2.3 gives up then.
constexpr double kDivergenceRatio = 1e3;
/// A prediction in which less is left of the force on a body has taken it from what it touches.
constexpr double kLeastLeft = 0.3;

class ImplicitRungeKutta final : public TimeIntegrator {
 public:
  ImplicitRungeKutta(const Model& model, Dynamics& dynamics, const StepSettings& settings);
  std::optional<double> advance(Eigen::VectorXd& y, double t, double h) override;
  void restart(double) override {
    newton_.restart();
    keep_matrix_ = false;
    acceleration_.setZero();
    touched_.clear();
    t_landing_.reset();
  }
  const SolverCounts& counts() const override { return counts_; }
  double solve_seconds() const override { return newton_.solve_seconds(); }

 private:
  static int rate(realtype t, N_Vector y, N_Vector y_dot, void* data);
  static int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype);
  static int weights(N_Vector, N_Vector w, void* data);
  static int is_converged(SUNNonlinearSolver solver, N_Vector, N_Vector correction,
                          realtype tolerance, N_Vector weights, void* data);
  static int predict_stage(realtype t, N_Vector z, void* data);
  /// Where everything would be after the time h.
  /// @param y  a state, and then that one
  void predict(const Eigen::VectorXd& acceleration, double h, Eigen::Ref<Eigen::VectorXd> y) const;
  bool has_let_go() const;
  [[nodiscard]] bool evolve(const Eigen::VectorXd& start, double t, double h);
  [[nodiscard]] bool evolve_by_either_tangent(const Eigen::VectorXd& start, double t, double h,
                                              bool lands = false);
  [[nodiscard]] bool evolve_from_soft_contact(const Eigen::VectorXd& start, double t, double h);
  Eigen::VectorXd mean_acceleration(const Eigen::VectorXd& start, const Eigen::VectorXd& end,
                                    double h) const;

  const Model& model_;
  Dynamics& dynamics_;
  const Integrator::Scheme scheme_;
  NewtonSystem newton_;
  SolverCounts counts_;
  double step_ = 0;        // [s] being tried
  Conditions conditions_;  // of that step
  bool keep_matrix_ = false;
  const bool has_stiff_contact_;
  std::optional<double> t_landing_;  // [s] a step from there is known to need soft contact first
  Eigen::VectorXd acceleration_;     // mean of the last step, zero if there is none
  std::vector<double> touched_;      // force on bodies at the end of the last step [N]
  Eigen::VectorXd stage_start_;      // before it was predicted
  double stage_time_ = 0;            // [s] from the step's start to the stage
  bool may_predict_again_ = false, has_predicted_again_ = false;  // in this stage
  std::exception_ptr error_;                                      // thrown below a C callback
  sundials::Context context_;
  sundials::Vector y_;
  sundials::Solver solver_;
  sundials::Owned<SUNNonlinearSolver, FreeNonlinear> nonlinear_;
  sundials::Arkode arkode_;
  double correction_size_ = 0;   // of the last one, by the weights
  double convergence_rate_ = 1;  // how corrections shrink from one to the next
};

int ImplicitRungeKutta::rate(realtype t, N_Vector y, N_Vector y_dot, void* data) {
  auto& self = *static_cast<ImplicitRungeKutta*>(data);
  // ARKODE asks for it where a step begins too. A scheme of one implicit stage does not use it.
  if (self.scheme_ == Integrator::Scheme::ImplicitEuler && t == self.conditions_.step_start) {
    N_VConst(0, y_dot);
    return 0;
  }
  return sundials::evaluate_rate(self, self.dynamics_, self.conditions_, self.counts_, self.error_,
                                 t, y, y_dot);
}

SUNLinearSolver_Type matrix_embedded(SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; }

/// x: Newton's correction at the stage's state, where the rate was evaluated last (the residual
/// comes first).
int ImplicitRungeKutta::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  auto& self = *static_cast<ImplicitRungeKutta*>(solver->content);
  return guarded_solve(self.error_, [&] {
    double gamma = 0;
    N_Vector y = nullptr;
    check(ARKStepGetCurrentGamma(self.arkode_.get(), &gamma), "ARKStepGetCurrentGamma");
    check(ARKStepGetCurrentState(self.arkode_.get(), &y), "ARKStepGetCurrentState");
    if (std::exchange(self.may_predict_again_, false) && self.has_let_go()) {
      self.has_predicted_again_ = true;
      self.predict(Eigen::VectorXd::Zero(self.acceleration_.size()), self.stage_time_,
                   self.stage_start_);
      view(x) = self.stage_start_ - view(y);
      return true;
    }
    ++self.counts_.newton_iterations;
    return self.newton_.solve(N_VGetArrayPointer(y), gamma, N_VGetArrayPointer(b),
                              N_VGetArrayPointer(x), self.conditions_, self.counts_);
  });
}

int ImplicitRungeKutta::weights(N_Vector, N_Vector w, void* data) {
  const auto& self = *static_cast<const ImplicitRungeKutta*>(data);
  set_weights(self.model_, self.step_, view(w));
  return 0;
}

/// ARKODE's own test, but for corrections that were shortened or accelerated: they may be small
/// however far the solution is, and steps accepted after one don't keep the momentum. And what
/// touches must be in balance: its residual falls as the corrections do.
int ImplicitRungeKutta::is_converged(SUNNonlinearSolver solver, N_Vector, N_Vector correction,
                                     realtype tolerance, N_Vector weights, void* data) {
  constexpr double kLeastRateFall = 0.3;
  auto& self = *static_cast<ImplicitRungeKutta*>(data);
  int iteration = 0;
  SUNNonlinSolGetCurIter(solver, &iteration);
  if (self.has_predicted_again_ && --iteration < 0) return SUN_NLS_CONTINUE;
  const double size = N_VWrmsNorm(correction, weights), last = self.correction_size_;
  self.correction_size_ = size;
  self.convergence_rate_ =
      iteration == 0 ? 1 : std::max(kLeastRateFall * self.convergence_rate_, size / last);
  const double rate = std::min(1.0, self.convergence_rate_);
  if (!self.newton_.changed() && rate * size <= tolerance && rate * self.newton_.imbalance() <= 1)
    return SUN_NLS_SUCCESS;
  return iteration > 0 && size > kDivergenceRatio * last ? SUN_NLS_CONV_RECVR : SUN_NLS_CONTINUE;
}

/// A stage's iteration starts where everything would be if it went on as in the last step, with the
/// velocity of this one's start and the acceleration of that one: bodies in contact then start
/// pressed together about as they will be, and few contacts open or close in the iteration. But
/// where bodies have met in the last step the blow does not go on: see has_let_go().
int ImplicitRungeKutta::predict_stage(realtype t, N_Vector z, void* data) {
  auto& self = *static_cast<ImplicitRungeKutta*>(data);
  self.newton_.begin_iteration();
  self.stage_time_ = t - self.conditions_.step_start;
  self.stage_start_ = view(z);
  self.may_predict_again_ = true;
  self.has_predicted_again_ = false;
  self.predict(self.acceleration_, self.stage_time_, view(z));
  return 0;
}

void ImplicitRungeKutta::predict(const Eigen::VectorXd& acceleration, double h,
                                 Eigen::Ref<Eigen::VectorXd> y) const {
  const Layout& layout = model_.layout;
  y.segment(layout.velocities(), acceleration.size()) += h * acceleration;
  y.head(3 * layout.num_free_nodes) +=
      h * y.segment(layout.velocities(), 3 * layout.num_free_nodes);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int velocity =
        layout.velocities() + 3 * model_.rigid_bodies[static_cast<std::size_t>(r)].block;
    y.segment<3>(layout.rigid_p(r)) += h * y.segment<3>(velocity);
    turn(y.data() + layout.rigid_q(r), h * y.segment<3>(velocity + 3));
  }
}

/// A body that something pressed on at the end of the last step is free, or nearly, where the last
/// step's acceleration leads: that was a blow. Newton's iteration from there would throw it back,
/// deep into what it had touched.
bool ImplicitRungeKutta::has_let_go() const {
  return least_touch_left(touched_, dynamics_.now().contact.force_on_bodies()) < kLeastLeft;
}

void set_scheme(void* arkode, Integrator::Scheme scheme) {
  if (scheme == Integrator::Scheme::ImplicitEuler) {
    double one = 1;  // implicit Euler: y1 = y0 + h f(t1, y1)
    const sundials::ButcherTable table(
        ARKodeButcherTable_Create(1, 1, 0, &one, &one, &one, nullptr));
    check(ARKStepSetTables(arkode, 1, 0, table.get(), nullptr), "ARKStepSetTables");
    return;
  }
  // Kvaernoe's 4(2)3 scheme is stiffly accurate and L-stable like the other two: what is stiff is
  // damped, not carried on.
  const ARKODE_DIRKTableID table =
      scheme == Integrator::Scheme::TrBdf2 ? ARKODE_TRBDF2_3_3_2 : ARKODE_KVAERNO_4_2_3;
  check(ARKStepSetTableNum(arkode, table, ARKODE_ERK_NONE), "ARKStepSetTableNum");
}

ImplicitRungeKutta::ImplicitRungeKutta(const Model& model, Dynamics& dynamics,
                                       const StepSettings& settings)
    : model_(model),
      dynamics_(dynamics),
      scheme_(settings.scheme),
      newton_(model, dynamics),
      has_stiff_contact_(
          model.contacts.any([](const ContactModel& contact) { return contact.starts_soft(); })),
      acceleration_(Eigen::VectorXd::Zero(3 * model.layout.num_unknown_blocks())),
      context_(sundials::make_context()),
      y_(sundials::make_vector(model.layout.size(), context_)),
      solver_(sundials::make_solver(context_, this, matrix_embedded, solve)),
      nonlinear_(SUNNonlinSol_Newton(y_.get(), context_.get())),
      arkode_(ARKStepCreate(nullptr, rate, 0, y_.get(), context_.get())) {
  if (!arkode_) throw std::runtime_error("ARKStepCreate failed");
  void* arkode = arkode_.get();
  check(ARKStepSetErrHandlerFn(arkode, sundials::ignore_message, nullptr),
        "ARKStepSetErrHandlerFn");
  check(ARKStepSetUserData(arkode, this), "ARKStepSetUserData");
  set_scheme(arkode, scheme_);
  check(ARKStepWFtolerances(arkode, weights), "ARKStepWFtolerances");
  check(ARKStepSetNonlinearSolver(arkode, nonlinear_.get()), "ARKStepSetNonlinearSolver");
  check(SUNNonlinSolSetConvTestFn(nonlinear_.get(), is_converged, this),
        "SUNNonlinSolSetConvTestFn");
  check(ARKStepSetLinearSolver(arkode, solver_.get(), nullptr), "ARKStepSetLinearSolver");
  // Else ARKODE takes small residuals for solved and leaves the correction at zero.
  check(ARKStepSetEpsLin(arkode, kLeastResidual), "ARKStepSetEpsLin");
  check(ARKStepSetMaxNonlinIters(arkode, settings.max_iterations), "ARKStepSetMaxNonlinIters");
  check(ARKStepSetMaxConvFails(arkode, 1), "ARKStepSetMaxConvFails");
  check(ARKStepSetNonlinConvCoef(arkode, kNewtonFraction), "ARKStepSetNonlinConvCoef");
  // The stage's own rate, (z − y)/γ, and not f(z): a remaining error in z would come out amplified
  // by the stiffness.
  check(ARKStepSetDeduceImplicitRhs(arkode, SUNTRUE), "ARKStepSetDeduceImplicitRhs");
  check(ARKStepSetStagePredictFn(arkode, predict_stage), "ARKStepSetStagePredictFn");
  check(ARKStepSetInterpolantType(arkode, ARK_INTERP_LAGRANGE), "ARKStepSetInterpolantType");
}

/// One step of ARKODE from y. @return false if Newton's iteration did not converge
bool ImplicitRungeKutta::evolve(const Eigen::VectorXd& start, double t, double h) {
  view(y_) = start;
  void* arkode = arkode_.get();
  check(ARKStepReset(arkode, t, y_.get()), "ARKStepReset");
  check(ARKStepSetFixedStep(arkode, h), "ARKStepSetFixedStep");
  check(ARKStepSetStopTime(arkode, t + h), "ARKStepSetStopTime");
  double reached = t;
  const int flag = ARKStepEvolve(arkode, t + h, y_.get(), &reached, ARK_ONE_STEP);
  sundials::rethrow(error_);
  switch (flag) {
    case ARK_CONV_FAILURE:
    case ARK_LSOLVE_FAIL:
    case ARK_RHSFUNC_FAIL:  // forces that are not finite
    case ARK_FIRST_RHSFUNC_ERR:
    case ARK_REPTD_RHSFUNC_ERR:
    case ARK_UNREC_RHSFUNC_ERR:
      return false;
    default:
      check(flag, "ARKStepEvolve");
  }
  return view(y_).allFinite();
}

/// Over a jump of the active contacts the Gauss–Newton matrix may get where the consistent one,
/// whose curvature is of the wrong side, does not: it has a try before the step is shortened. So
/// has a line search where contact is stiff, which ends cycles; at a kink that Newton's iteration
/// steps over it may creep without end.
/// @param lands  contact is where soft contact leads: each correction is searched
bool ImplicitRungeKutta::evolve_by_either_tangent(const Eigen::VectorXd& start, double t, double h,
                                                  bool lands) {
  const int first = lands ? 0 : kNever;
  const int second = has_stiff_contact_ && !lands ? kSearchesFrom : first;
  for (const auto& [tangent, searched_from] :
       {std::pair(fem::Tangent::Consistent, first), std::pair(fem::Tangent::Projected, second)}) {
    newton_.search_lines(searched_from);
    newton_.begin_step(keep_matrix_, tangent);
    keep_matrix_ = false;  // after a failure
    if (evolve(start, t, h)) return true;
    if (newton_.used_projected_only() && first == second) break;
  }
  return false;
}

/// Where bodies land, stiff contact throws the iteration back and forth: it starts from where the
/// step leads with soft contact, as statics does.
bool ImplicitRungeKutta::evolve_from_soft_contact(const Eigen::VectorXd& start, double t,
                                                  double h) {
  conditions_.contact.soft = true;
  const bool landed = evolve_by_either_tangent(start, t, h);
  conditions_.contact.soft = false;
  if (!landed) return false;
  acceleration_ = mean_acceleration(start, view(y_), h);
  return evolve_by_either_tangent(start, t, h, true);
}

Eigen::VectorXd ImplicitRungeKutta::mean_acceleration(const Eigen::VectorXd& start,
                                                      const Eigen::VectorXd& end, double h) const {
  return (end - start).segment(model_.layout.velocities(), acceleration_.size()) / h;
}

std::optional<double> ImplicitRungeKutta::advance(Eigen::VectorXd& y, double t, double h) {
  step_ = h;
  conditions_.step_start = t;
  bool done = t_landing_ != t && evolve_by_either_tangent(y, t, h);
  if (!done && has_stiff_contact_) {
    t_landing_ = t;
    done = evolve_from_soft_contact(y, t, h);
  }
  if (!done) {
    acceleration_.setZero();
    ++counts_.rejected_newton;
    return std::nullopt;
  }
  ++counts_.steps;
  keep_matrix_ = true;
  newton_.end_step();
  touched_ = dynamics_.now().contact.force_on_bodies();
  const Eigen::VectorXd before = y;
  y = view(y_);
  for (int r = 0; r < model_.layout.num_rigid; ++r)
    y.segment<4>(model_.layout.rigid_q(r)).normalize();
  if (scheme_ == Integrator::Scheme::ImplicitEuler) keep_angular_momentum(model_, before, h, y);
  acceleration_ = mean_acceleration(before, y, h);
  return t + h;
}

}  // namespace

std::unique_ptr<TimeIntegrator> make_implicit_runge_kutta(const Model& model, Dynamics& dynamics,
                                                          const StepSettings& settings) {
  return std::make_unique<ImplicitRungeKutta>(model, dynamics, settings);
}

}  // namespace articular::sim
