#include "sim/integrator.hpp"

#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/newton_system.hpp"

namespace articular::sim {
namespace {

static_assert(std::is_same_v<realtype, double>);

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeArkode {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};
struct FreeVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct FreeSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
struct FreeTable {
  void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};
template <class Handle, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

void check(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string(call) + " failed: " + std::to_string(flag));
}

/// Newton's correction is converged when it is below this part of the tolerances.
constexpr double kNewtonFraction = 0.1;
/// Contact that opens and closes makes corrections grow for an iteration or two; ARKODE's limit of
/// 2.3 gives up then.
constexpr double kDivergenceRatio = 1e3;
constexpr double kActivationTolerance = 1e-4;

}  // namespace

struct ImplicitIntegrator::Memory {
  Memory(const Model& m, Dynamics& d) : model(m), dynamics(d), newton(m, d) {}
  [[nodiscard]] bool evolve(const Eigen::VectorXd& start, double t, double h);

  const Model& model;
  Dynamics& dynamics;
  NewtonSystem newton;
  IntegratorCounts counts;
  double step = 0;     // [s] being tried
  double t_start = 0;  // [s] of that step
  bool keep_matrix = false;
  std::exception_ptr error;  // thrown below a C callback; rethrown above it
  Owned<SUNContext, FreeContext> context;
  Owned<N_Vector, FreeVector> y;
  Owned<SUNLinearSolver, FreeSolver> solver;
  Owned<void*, FreeArkode> arkode;
};

namespace {

/// Runs body(); an exception becomes "stop" for ARKODE and is kept for the caller.
template <class State, class Body>
int guarded(State& state, Body&& body) {
  try {
    return body();
  } catch (...) {
    state.error = std::current_exception();
    return -1;
  }
}

template <class State>
int rate(realtype t, N_Vector y, N_Vector y_dot, void* data) {
  auto& state = *static_cast<State*>(data);
  return guarded(state, [&] {
    ++state.counts.force_evaluations;
    state.dynamics.evaluate(N_VGetArrayPointer(y), t);
    state.dynamics.rate(N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot));
    return state.dynamics.forces().allFinite() ? 0 : 1;
  });
}

/// The right-hand side was evaluated last where Newton's iteration stands: the residual comes
/// first.
template <class State>
int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  auto& state = *static_cast<State*>(solver->content);
  return guarded(state, [&] {
    ++state.counts.newton_iterations;
    double gamma = 0;
    N_Vector y = nullptr;
    check(ARKStepGetCurrentGamma(state.arkode.get(), &gamma), "ARKStepGetCurrentGamma");
    check(ARKStepGetCurrentState(state.arkode.get(), &y), "ARKStepGetCurrentState");
    const bool solved = state.newton.solve(N_VGetArrayPointer(y), gamma, N_VGetArrayPointer(b),
                                           N_VGetArrayPointer(x), state.counts);
    return solved ? 0 : 1;
  });
}

/// Weights of Newton's corrections: positions against position_tolerance, velocities against what
/// moves them so far in one step, rotations by the bone's size.
template <class State>
int weights(N_Vector, N_Vector w, void* data) {
  const auto& state = *static_cast<State*>(data);
  const Layout& layout = state.model.layout;
  const double position = 1 / state.model.scenario.integrator.position_tolerance;
  Eigen::Map<Eigen::VectorXd> weight(N_VGetArrayPointer(w), layout.size());
  weight.head(3 * layout.num_free_nodes).setConstant(position);
  weight.segment(layout.velocities(), 3 * layout.num_unknown_blocks())
      .setConstant(position * state.step);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const Bone& bone = state.model.bones[static_cast<std::size_t>(r)];
    // Radius of gyration: how far a turn by one radian moves the bone's mass.
    const double size = std::sqrt(bone.mass.inertia.trace() / (2 * bone.mass.mass));
    weight.segment<3>(layout.bone_p(r)).setConstant(position);
    weight.segment<4>(layout.bone_q(r)).setConstant(position * size);
    weight.segment<3>(layout.velocities() + 3 * bone.block + 3)
        .setConstant(position * size * state.step);
  }
  weight.tail(layout.num_muscles).setConstant(1 / kActivationTolerance);
  return 0;
}

/// A stage's iteration starts where everything would be if it moved on with its velocity of the
/// step's start: what is left to find is due to forces, and near what the contact search covers.
template <class State>
int predict_stage(realtype t, N_Vector z, void* data) {
  const auto& state = *static_cast<State*>(data);
  const Layout& layout = state.model.layout;
  double* y = N_VGetArrayPointer(z);
  const double h = t - state.t_start;
  Eigen::Map<Eigen::VectorXd> vector(y, layout.size());
  vector.head(3 * layout.num_free_nodes) +=
      h * vector.segment(layout.velocities(), 3 * layout.num_free_nodes);
  for (int r = 0; r < layout.num_rigid; ++r) {
    const int velocity =
        layout.velocities() + 3 * state.model.bones[static_cast<std::size_t>(r)].block;
    vector.segment<3>(layout.bone_p(r)) += h * vector.segment<3>(velocity);
    double* q = y + layout.bone_q(r);
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(rotation_matrix(h * vector.segment<3>(velocity + 3))) *
        Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    vector.segment<4>(layout.bone_q(r)) << turned.w(), turned.vec();
  }
  return 0;
}

void ignore_message(int, const char*, const char*, char*, void*) {}

SUNLinearSolver_Type solver_type(SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; }
int free_solver(SUNLinearSolver solver) {
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

template <class State>
SUNLinearSolver make_solver(State& state) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(state.context.get());
  solver->content = &state;
  solver->ops->gettype = solver_type;
  solver->ops->solve = solve<State>;
  solver->ops->free = free_solver;
  return solver;
}

void set_scheme(void* arkode, Integrator::Scheme scheme) {
  if (scheme == Integrator::Scheme::TrBdf2) {
    check(ARKStepSetTableNum(arkode, ARKODE_TRBDF2_3_3_2, ARKODE_ERK_NONE), "ARKStepSetTableNum");
    return;
  }
  double one = 1;  // implicit Euler: y1 = y0 + h f(t1, y1)
  const Owned<ARKodeButcherTable, FreeTable> table(
      ARKodeButcherTable_Create(1, 1, 0, &one, &one, &one, nullptr));
  check(ARKStepSetTables(arkode, 1, 0, table.get(), nullptr), "ARKStepSetTables");
}

}  // namespace

ImplicitIntegrator::ImplicitIntegrator(const Model& model, Dynamics& dynamics)
    : memory_(std::make_unique<Memory>(model, dynamics)) {
  Memory& m = *memory_;
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  m.context.reset(context);
  m.y.reset(N_VNew_Serial(model.layout.size(), context));
  N_VConst(0, m.y.get());
  m.arkode.reset(ARKStepCreate(nullptr, rate<Memory>, 0, m.y.get(), context));
  if (!m.arkode) throw std::runtime_error("ARKStepCreate failed");
  void* arkode = m.arkode.get();
  check(ARKStepSetErrHandlerFn(arkode, ignore_message, nullptr), "ARKStepSetErrHandlerFn");
  check(ARKStepSetUserData(arkode, &m), "ARKStepSetUserData");
  set_scheme(arkode, model.scenario.integrator.scheme);
  check(ARKStepWFtolerances(arkode, weights<Memory>), "ARKStepWFtolerances");
  m.solver.reset(make_solver(m));
  check(ARKStepSetLinearSolver(arkode, m.solver.get(), nullptr), "ARKStepSetLinearSolver");
  check(ARKStepSetMaxNonlinIters(arkode, model.scenario.integrator.max_iterations),
        "ARKStepSetMaxNonlinIters");
  check(ARKStepSetMaxConvFails(arkode, 1), "ARKStepSetMaxConvFails");
  check(ARKStepSetNonlinConvCoef(arkode, kNewtonFraction), "ARKStepSetNonlinConvCoef");
  check(ARKStepSetNonlinRDiv(arkode, kDivergenceRatio), "ARKStepSetNonlinRDiv");
  // The stage's own rate, (z − y)/γ, and not f(z): a remaining error in z would come out amplified
  // by the stiffness.
  check(ARKStepSetDeduceImplicitRhs(arkode, SUNTRUE), "ARKStepSetDeduceImplicitRhs");
  check(ARKStepSetStagePredictFn(arkode, predict_stage<Memory>), "ARKStepSetStagePredictFn");
  check(ARKStepSetInterpolantType(arkode, ARK_INTERP_LAGRANGE), "ARKStepSetInterpolantType");
}

ImplicitIntegrator::~ImplicitIntegrator() = default;

void ImplicitIntegrator::forget() { memory_->keep_matrix = false; }

const IntegratorCounts& ImplicitIntegrator::counts() const { return memory_->counts; }

/// One step of ARKODE from y. @return false if Newton's iteration did not converge
bool ImplicitIntegrator::Memory::evolve(const Eigen::VectorXd& start, double t, double h) {
  Eigen::Map<Eigen::VectorXd> vector(N_VGetArrayPointer(y.get()), start.size());
  vector = start;
  check(ARKStepReset(arkode.get(), t, y.get()), "ARKStepReset");
  check(ARKStepSetFixedStep(arkode.get(), h), "ARKStepSetFixedStep");
  check(ARKStepSetStopTime(arkode.get(), t + h), "ARKStepSetStopTime");
  double reached = t;
  const int flag = ARKStepEvolve(arkode.get(), t + h, y.get(), &reached, ARK_ONE_STEP);
  if (error) std::rethrow_exception(std::exchange(error, nullptr));
  return flag >= 0 && vector.allFinite();
}

bool ImplicitIntegrator::advance(Eigen::VectorXd& y, double t, double h) {
  Memory& m = *memory_;
  if (y.size() == 0) {  // nothing to solve for: only driven bones move
    ++m.counts.steps;
    return true;
  }
  m.step = h;
  m.t_start = t;
  // Over a jump of the active contacts the Gauss–Newton matrix may get where the consistent one,
  // whose curvature is of the wrong side, does not: it has a try before the step is shortened.
  bool done = false;
  for (const fem::Tangent tangent : {fem::Tangent::Consistent, fem::Tangent::Projected}) {
    m.newton.begin_step(m.keep_matrix, tangent);
    m.keep_matrix = false;  // after a failure
    done = m.evolve(y, t, h);
    if (done) break;
  }
  if (!done) {
    ++m.counts.failed;
    return false;
  }
  ++m.counts.steps;
  m.keep_matrix = true;
  y = Eigen::Map<Eigen::VectorXd>(N_VGetArrayPointer(m.y.get()), y.size());
  return true;
}

}  // namespace articular::sim
