#include "sim/statics/equilibrium.hpp"

#include <kinsol/kinsol.h>
#include <kinsol/kinsol_ls.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/assembly/line_search.hpp"
#include "sim/assembly/solver_setup.hpp"
#include "sim/base/error.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/base/sundials.hpp"
#include "sim/model/displace.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/model/newton_weights.hpp"
#include "sim/statics/random_blocks.hpp"

namespace articular::sim {
namespace {

using sundials::check;
using sundials::guarded;
using sundials::guarded_solve;
using sundials::view;

/// A full correction below this part of what may move in one changes nothing: where nothing is
/// strained, forces are round-off, and their balance says nothing.
constexpr double kNoMotion = 1e-10;
/// Of a rigid body in one correction [rad]. Farther off nothing is linear, and where no contact
/// bounds a correction it would lead to another equilibrium.
constexpr double kMostTurn = 0.2;
/// The largest force is that at the solution: it is known there only.
constexpr int kMostRounds = 4;
/// Iterations with contact as stiff as it should be, before it is tried softer: they take a dozen
/// where they get there at all.
constexpr int kMostFromAfar = 20;
/// Where they don't, the line search says so early: this often in a row it takes but this part of
/// the correction.
constexpr int kMostShort = 3;
constexpr double kShort = 0.05;

struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatFreeEmpty(matrix); }
};

/// What a rotation vector θ gains by a small rotation on top of exp(θ): the inverse of the tangent
/// map of SO(3).
Mat3 inverse_tangent_map(const Vec3& theta) {
  const double angle = theta.norm();
  const Mat3 S = skew(theta);
  const double c =
      angle < 1e-4 ? 1.0 / 12 : (1 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  return Mat3::Identity() - 0.5 * S + c * S * S;
}

}  // namespace

class Equilibrium::Solver {
 public:
  Solver(const Model& model, Dynamics& dynamics, const StepSettings& settings);
  bool solve(Eigen::VectorXd& y, double t, double damping, const Conditions& conditions,
             const ContactCover& cover);
  bool yield(const Eigen::VectorXd& f, double damping, Eigen::VectorXd& y);
  bool linearise(double damping);
  bool is_stable(double damping);
  bool respond(const Eigen::VectorXd& f, Eigen::VectorXd& x);
  void restart() { linear_ = make_linear_solver(model_); }
  /// The largest force, or moment by the rigid body's size, of a vector of block forces [N].
  /// Infinite where one is not a number: std::max would pass over it.
  double largest(const Eigen::VectorXd& f) const;
  double residual() const { return largest(dynamics_.now().forces); }
  bool is_balanced(double part) const { return is_balanced(dynamics_.now().forces, part); }
  bool is_balanced(const Eigen::VectorXd& r, double part) const;
  double largest_acceleration() const;

  std::vector<NewtonIteration> iterations;
  SolverCounts counts;
  double seconds = 0;
  IterationWatch watch;
  std::function<bool()> is_to_stop;

 private:
  static int residual(N_Vector u, N_Vector r, void* data);
  static int assemble(N_Vector u, N_Vector, SUNMatrix, void* data, N_Vector, N_Vector);
  static int correct(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype);
  int run(double tolerance);
  void set_most_iterations(int most) {
    check(KINSetNumMaxIters(kinsol_.get(), most), "KINSetNumMaxIters");
  }
  [[nodiscard]] bool balance(bool soft);
  [[nodiscard]] bool iterate(double tolerance);
  /// Of r_ and what it is small against.
  bool is_finite() const { return std::isfinite(dynamics_.now().largest_force) && r_.allFinite(); }
  [[nodiscard]] bool balance_within_bounds();
  void move(const Eigen::VectorXd& u, Eigen::VectorXd& y) const;
  /// @throws Interruption
  void stop_if_asked() const {
    if (is_to_stop && is_to_stop()) throw Interruption();
  }
  /// r at u; kept, as KINSOL asks again for what the line search has seen.
  const Eigen::VectorXd& residual_at(const Eigen::VectorXd& u);
  bool prepare(fem::Tangent tangent);
  bool prepare(const NewtonEquations& equations);
  bool solve_linear();
  [[nodiscard]] bool solve_for_correction();
  [[nodiscard]] bool solve_downhill();
  void make_way();
  double slope_at(double part);
  void correct_for(const GroupChanges& changes);
  std::optional<double> find_correction();
  /// With the projected matrix where the consistent one turns out not to be positive definite: a
  /// factorization says so at once, iterations when they meet it.
  bool solve_by_either_tangent();
  /// How far things move [m].
  double motion_scale() const {
    return std::isfinite(model_.trusted_motion) ? model_.trusted_motion : 1;
  }
  double largest_displacement(const Eigen::VectorXd& u) const;
  double largest_turn(const Eigen::VectorXd& u) const;
  const Eigen::VectorXd& searched_residual(double part);

  const Model& model_;
  Dynamics& dynamics_;
  const int max_iterations_;
  std::unique_ptr<fem::LinearSolver> linear_;
  Eigen::VectorXd start_, y_, u_, r_, before_, r_before_, trial_, rhs_, correction_, first_,
      inertia_;
  double t_ = 0, damping_ = 0;
  double most_ = 1;                                  // that may be taken of correction_
  fem::Tangent tangent_ = fem::Tangent::Consistent;  // of the last matrix
  bool known_ = false;                               // r_ belongs to u_
  bool from_afar_ = false;                           // contact is stiff, and things may be far off
  int short_in_a_row_ = 0;                           // corrections of which little was taken
  std::optional<Supports> supports_;                 // where the last correction began
  ContactForecast forecast_;
  PressurePrediction prediction_;
  PredictedPressures taken_;  // by the last correction
  Conditions conditions_;
  const ContactCover* cover_ = nullptr;  // of the solution that goes on
  std::exception_ptr error_;
  sundials::Context context_;
  sundials::Vector solution_, u_scale_, r_scale_;
  sundials::Owned<SUNMatrix, FreeMatrix> matrix_;
  sundials::Solver solver_;
  sundials::Owned<void*, FreeKinsol> kinsol_;
};

Equilibrium::Solver::Solver(const Model& model, Dynamics& dynamics, const StepSettings& settings)
    : model_(model),
      dynamics_(dynamics),
      max_iterations_(settings.max_iterations),
      linear_(make_linear_solver(model)),
      forecast_(model),
      context_(sundials::make_context()) {
  const Eigen::Index n = 3 * model.layout.num_unknown_blocks();
  solution_ = sundials::make_vector(n, context_);
  u_scale_ = sundials::make_vector(n, context_);
  r_scale_ = sundials::make_vector(n, context_);
  N_VConst(1 / motion_scale(), u_scale_.get());
  // The matrix is ours: KINSOL only passes its handle on.
  matrix_.reset(SUNMatNewEmpty(context_.get()));
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  solver_ = sundials::make_solver(
      context_, this, [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }, correct);
  kinsol_.reset(KINCreate(context_.get()));
  if (!kinsol_) throw std::runtime_error("KINCreate failed");
  void* kinsol = kinsol_.get();
  check(KINSetErrHandlerFn(kinsol, sundials::ignore_message, nullptr), "KINSetErrHandlerFn");
  check(KINInit(kinsol, residual, solution_.get()), "KINInit");
  check(KINSetUserData(kinsol, this), "KINSetUserData");
  check(KINSetLinearSolver(kinsol, solver_.get(), matrix_.get()), "KINSetLinearSolver");
  check(KINSetJacFn(kinsol, assemble), "KINSetJacFn");
  check(KINSetMaxSetupCalls(kinsol, 1), "KINSetMaxSetupCalls");
  check(KINSetScaledStepTol(kinsol, kNoMotion), "KINSetScaledStepTol");
  check(KINSetMaxNewtonStep(kinsol, 1e300), "KINSetMaxNewtonStep");
}

/// y = start moved by u.
void Equilibrium::Solver::move(const Eigen::VectorXd& u, Eigen::VectorXd& y) const {
  y = start_;
  displace(model_, u, y);
}

const Eigen::VectorXd& Equilibrium::Solver::residual_at(const Eigen::VectorXd& u) {
  if (known_ && u == u_) return r_;
  stop_if_asked();
  ++counts.force_evaluations;
  u_ = u;
  move(u, y_);
  dynamics_.evaluate(y_.data(), t_, conditions_);
  r_ = -dynamics_.now().forces.head(u.size());
  if (damping_ > 0) {
    dynamics_.multiply_mass(u, inertia_);
    r_ += damping_ * inertia_;
  }
  known_ = true;
  return r_;
}

int Equilibrium::Solver::residual(N_Vector u, N_Vector r, void* data) {
  auto& self = *static_cast<Solver*>(data);
  return guarded(self.error_, [&] {
    view(r) = self.residual_at(view(u));
    return view(r).allFinite() ? 0 : 1;
  });
}

/// What the line search looks at, at trial_: the pressures go along with the displacements, as both
/// are unknowns of Newton's method. Those of the positions alone are steep where ν is near 0.5, and
/// would stop every search.
const Eigen::VectorXd& Equilibrium::Solver::searched_residual(double part) {
  if (!dynamics_.matrix().has_pressures()) return residual_at(trial_);
  conditions_.pressures = {&prediction_, part};
  const Eigen::VectorXd& r = residual_at(trial_);
  conditions_.pressures = {};
  known_ = false;
  return r;
}

bool Equilibrium::Solver::prepare(fem::Tangent tangent) {
  stop_if_asked();
  tangent_ = tangent;
  if (tangent == fem::Tangent::Projected) ++counts.projected_tangents;
  return prepare(dynamics_.assemble({damping_, 0, 1}, tangent, taken_));
}

bool Equilibrium::Solver::prepare(const NewtonEquations& equations) {
  stop_if_asked();
  const Stopwatch watch(seconds);
  ++counts.factorizations;
  return prepare_linear(*linear_, equations, dynamics_.now().configuration.x);
}

bool Equilibrium::Solver::solve_linear() {
  stop_if_asked();
  const Stopwatch watch(seconds);
  correction_.setZero(rhs_.size());
  const fem::SolveReport report = linear_->solve(rhs_, correction_);
  ++counts.linear_solves;
  counts.linear_iterations += report.iterations;
  return report.converged && correction_.allFinite();
}

bool Equilibrium::Solver::solve_by_either_tangent() {
  return solve_linear() || (tangent_ == fem::Tangent::Consistent &&
                            prepare(fem::Tangent::Projected) && solve_linear());
}

int Equilibrium::Solver::assemble(N_Vector u, N_Vector, SUNMatrix, void* data, N_Vector, N_Vector) {
  auto& self = *static_cast<Solver*>(data);
  return guarded(self.error_, [&] {
    self.residual_at(view(u));
    const bool ready =
        self.prepare(fem::Tangent::Consistent) || self.prepare(fem::Tangent::Projected);
    return ready ? 0 : 1;
  });
}

double Equilibrium::Solver::largest_displacement(const Eigen::VectorXd& u) const {
  double largest = 0;
  for (int block = 0; block < model_.layout.num_free_nodes; ++block)
    largest = std::max(largest, u.segment<3>(3 * block).norm());
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    largest = std::max({largest, u.segment<3>(3 * rigid.block).norm(),
                        turning_radius(rigid) * u.segment<3>(3 * rigid.block + 3).norm()});
  }
  return largest;
}

double Equilibrium::Solver::largest_turn(const Eigen::VectorXd& u) const {
  double largest = 0;
  for (int r = 0; r < model_.layout.num_rigid; ++r)
    largest = std::max(
        largest,
        u.segment<3>(3 * model_.rigid_bodies[static_cast<std::size_t>(r)].block + 3).norm());
  return largest;
}

/// correction_ from before_, with contact as it is foreseen.
bool Equilibrium::Solver::solve_for_correction() {
  rhs_ = -r_before_;
  forecast_.add_force(dynamics_.contact(), dynamics_.now().configuration, rhs_);
  keep_free_part(model_, rhs_);
  if (!solve_by_either_tangent()) return false;
  keep_free_part(model_, correction_);  // round-off out of what is held
  return true;
}

/// Where contact that was foreseen leads uphill, it is taken as it is.
bool Equilibrium::Solver::solve_downhill() {
  if (!solve_for_correction()) return false;
  if (correction_.dot(r_before_) < 0 || !forecast_.is_made(dynamics_.contact())) return true;
  dynamics_.contact().forget_foreseen();
  return prepare(tangent_) && solve_for_correction();
}

/// Pressures go along with correction_; a rigid body's becomes a rotation on top of where it is.
void Equilibrium::Solver::make_way() {
  prediction_.predict(dynamics_.now(), dynamics_.matrix(), correction_);
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const int row = 3 * model_.rigid_bodies[static_cast<std::size_t>(r)].block + 3;
    correction_.segment<3>(row) =
        inverse_tangent_map(before_.segment<3>(row)) * correction_.segment<3>(row);
  }
  // What can touch must not be carried through what it is to meet. But for turns nothing else
  // bounds a correction: the search sees where the laws take it.
  const double trusted =
      model_.contacts.empty() ? std::numeric_limits<double>::infinity() : model_.trusted_motion;
  const double motion = largest_displacement(correction_), turn = largest_turn(correction_);
  most_ = std::min({1.0, trusted / motion, kMostTurn / turn});
  if (*cover_) (*cover_)(dynamics_.now().configuration, most_ * motion);
}

/// Of the energy along correction_, by the part of it.
double Equilibrium::Solver::slope_at(double part) {
  trial_ = before_ + part * correction_;
  return correction_.dot(searched_residual(part));
}

/// correction_ with what it was foreseen to change of contact; as it was where that fails.
void Equilibrium::Solver::correct_for(const GroupChanges& changes) {
  first_ = correction_;
  residual_at(before_);
  const NewtonEquations equations =
      dynamics_.assemble_again(changes, {damping_, 0, 1}, tangent_, taken_);
  if (prepare(equations) && solve_for_correction() && correction_.dot(r_before_) < 0)
    make_way();
  else
    correction_ = first_;
}

/// Makes correction_ from before_. @return the part of it to take; none where no matrix can be
/// solved
std::optional<double> Equilibrium::Solver::find_correction() {
  if (!solve_downhill()) return std::nullopt;
  const GroupChanges* changes = nullptr;
  if (from_afar_)  // the second try does without
    changes = &forecast_.foresee(dynamics_.contact(), dynamics_.now().configuration, correction_);
  make_way();
  double slope = correction_.dot(r_before_), there = slope_at(most_);
  if (changes != nullptr && changes->size() > 0 && is_far_uphill(slope, there)) {
    correct_for(*changes);
    slope = correction_.dot(r_before_);
    there = slope_at(most_);
  }
  return searched_part(most_, slope, there, [this](double part) { return slope_at(part); });
}

int Equilibrium::Solver::correct(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector,
                                 realtype) {
  auto& self = *static_cast<Solver*>(solver->content);
  return guarded_solve(self.error_, [&] {
    ++self.counts.newton_iterations;
    Supports supports(self.dynamics_.now());
    self.before_ = self.u_;
    self.r_before_ = self.r_;
    const double residual = self.largest(self.r_) / self.dynamics_.now().largest_force;
    const std::optional<double> part = self.find_correction();
    if (!part) return false;
    self.taken_ = {&self.prediction_, *part};
    view(x) = *part * self.correction_;
    self.short_in_a_row_ = *part <= kShort ? self.short_in_a_row_ + 1 : 0;
    if (self.from_afar_ && self.short_in_a_row_ == kMostShort) return false;
    self.iterations.push_back(
        {residual, *part * self.largest_displacement(self.correction_), *part});
    if (self.supports_) self.iterations.back().changes = supports.changes_since(*self.supports_);
    self.supports_ = std::move(supports);
    if (self.watch && self.watch(self.t_, self.iterations.back())) throw Interruption();
    return true;
  });
}

double Equilibrium::Solver::largest(const Eigen::VectorXd& f) const {
  if (!f.allFinite()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (int block = 0; block < model_.layout.num_free_nodes; ++block)
    largest = std::max(largest, f.segment<3>(3 * block).norm());
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    largest = std::max({largest, f.segment<3>(3 * rigid.block).norm(),
                        f.segment<3>(3 * rigid.block + 3).norm() / turning_radius(rigid)});
  }
  return largest;
}

/// Where forces are no numbers, nothing is.
bool Equilibrium::Solver::is_balanced(const Eigen::VectorXd& r, double part) const {
  const double force = dynamics_.now().largest_force;
  return std::isfinite(force) && largest(r) <= part * force;
}

double Equilibrium::Solver::largest_acceleration() const {
  const Eigen::VectorXd& f = dynamics_.now().forces;
  double largest = 0;
  for (int block = 0; block < model_.layout.num_free_nodes; ++block)
    largest = std::max(largest, f.segment<3>(3 * block).norm() / model_.node_mass[block]);
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const double moment = f.segment<3>(3 * rigid.block + 3).norm() / turning_radius(rigid);
    largest = std::max({largest, f.segment<3>(3 * rigid.block).norm() / rigid.mass.mass,
                        moment / rigid.mass.mass});
  }
  return largest;
}

/// KINSOL from u = 0. @param tolerance  [N]
int Equilibrium::Solver::run(double tolerance) {
  auto scale = view(r_scale_);
  scale.setConstant(1 / tolerance);
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    scale.segment<3>(3 * rigid.block + 3).setConstant(1 / (tolerance * turning_radius(rigid)));
  }
  check(KINSetFuncNormTol(kinsol_.get(), 1), "KINSetFuncNormTol");
  const int flag = KINSol(kinsol_.get(), solution_.get(), KIN_NONE, u_scale_.get(), r_scale_.get());
  sundials::rethrow(error_);
  return flag;
}

/// From where solution_ is. @param soft  contact is, and about balanced will do
bool Equilibrium::Solver::balance(bool soft) {
  constexpr double kAboutBalanced = 1e-3;
  conditions_.contact.soft = soft;
  known_ = false;
  taken_ = {};
  const bool balanced = iterate(soft ? kAboutBalanced : kBalanced);
  dynamics_.contact().forget_foreseen();
  conditions_.contact.soft = false;
  return balanced;
}

/// @param tolerance  of the largest force
bool Equilibrium::Solver::iterate(double tolerance) {
  residual_at(view(solution_));
  for (int round = 0; round < kMostRounds; ++round) {
    if (!is_finite()) return false;
    if (dynamics_.now().largest_force == 0) break;  // nothing acts
    const int flag = run(tolerance * dynamics_.now().largest_force);
    const bool stuck = flag == KIN_STEP_LT_STPTOL && iterations.back().fraction < 1;
    if (flag < 0 || stuck) return false;
    residual_at(view(solution_));
    if (flag == KIN_STEP_LT_STPTOL || is_balanced(r_, 2 * tolerance)) break;
  }
  return is_finite();
}

/// With multipliers where contact penetrates too much.
bool Equilibrium::Solver::balance_within_bounds() {
  constexpr int kMostUpdates = 20;
  if (!balance(false)) return false;
  for (int update = 0; update < kMostUpdates && dynamics_.contact().augment(); ++update)
    if (!balance(false)) return false;
  return true;
}

bool Equilibrium::Solver::solve(Eigen::VectorXd& y, double t, double damping,
                                const Conditions& conditions, const ContactCover& cover) {
  conditions_ = conditions;
  cover_ = &cover;
  taken_ = {};
  start_ = y;
  t_ = t;
  damping_ = damping;
  known_ = false;
  iterations.clear();
  supports_.reset();
  view(solution_).setZero();
  if (view(solution_).size() == 0) {  // only driven rigid bodies
    dynamics_.evaluate(y.data(), t, conditions);
    ++counts.steps;
    return true;
  }
  dynamics_.contact().drop_multipliers();
  residual_at(view(solution_));
  // From afar, contact that is as stiff as it should be throws iterations back and forth.
  const bool touches = dynamics_.now().contact.has_patches();
  from_afar_ = touches;
  short_in_a_row_ = 0;
  set_most_iterations(touches ? std::min(max_iterations_, kMostFromAfar) : max_iterations_);
  bool balanced = balance_within_bounds();
  set_most_iterations(max_iterations_);
  from_afar_ = false;
  if (!balanced && touches) {
    view(solution_).setZero();
    if (!balance(true)) view(solution_).setZero();
    dynamics_.contact().drop_multipliers();
    balanced = balance_within_bounds();
  }
  if (!balanced) {
    ++counts.rejected_newton;
    return false;
  }
  ++counts.steps;
  y = y_;
  for (int r = 0; r < model_.layout.num_rigid; ++r)
    y.segment<4>(model_.layout.rigid_q(r)).normalize();
  return true;
}

bool Equilibrium::Solver::yield(const Eigen::VectorXd& f, double damping, Eigen::VectorXd& y) {
  if (!linearise(damping)) return false;
  rhs_ = f.head(view(solution_).size());
  if (!solve_linear()) return false;
  keep_free_part(model_, correction_);
  start_ = y;
  move(correction_, y);
  return true;
}

bool Equilibrium::Solver::linearise(double damping) {
  taken_ = {};
  damping_ = damping;
  return prepare(fem::Tangent::Consistent) || prepare(fem::Tangent::Projected);
}

/// A factorization says so at once. Iterations meet a direction that is driven on by a load that
/// has a part along it: one at random has.
bool Equilibrium::Solver::is_stable(double damping) {
  taken_ = {};
  damping_ = damping;
  if (!prepare(fem::Tangent::Consistent)) return false;
  rhs_ = random_blocks(view(solution_).size());
  keep_free_part(model_, rhs_);
  correction_.setZero(rhs_.size());
  return !linear_->solve(rhs_, correction_).is_indefinite;
}

bool Equilibrium::Solver::respond(const Eigen::VectorXd& f, Eigen::VectorXd& x) {
  rhs_ = f.head(view(solution_).size());
  if (!solve_by_either_tangent()) return false;
  x = correction_;
  return true;
}

Equilibrium::Equilibrium(const Model& model, Dynamics& dynamics, const StepSettings& settings)
    : solver_(std::make_unique<Solver>(model, dynamics, settings)) {}
Equilibrium::~Equilibrium() = default;

bool Equilibrium::solve(Eigen::VectorXd& y, double t, double damping, const Conditions& conditions,
                        const ContactCover& cover) {
  return solver_->solve(y, t, damping, conditions, cover);
}
bool Equilibrium::yield(const Eigen::VectorXd& f, double damping, Eigen::VectorXd& y) {
  return solver_->yield(f, damping, y);
}
bool Equilibrium::linearise(double damping) { return solver_->linearise(damping); }
bool Equilibrium::is_stable(double damping) { return solver_->is_stable(damping); }
bool Equilibrium::respond(const Eigen::VectorXd& f, Eigen::VectorXd& x) {
  return solver_->respond(f, x);
}
void Equilibrium::set_watch(IterationWatch watch) { solver_->watch = std::move(watch); }
void Equilibrium::set_stop(std::function<bool()> is_to_stop) {
  solver_->is_to_stop = std::move(is_to_stop);
}
void Equilibrium::restart() { solver_->restart(); }
double Equilibrium::residual() const { return solver_->residual(); }
bool Equilibrium::is_balanced(double part) const { return solver_->is_balanced(part); }
double Equilibrium::largest_acceleration() const { return solver_->largest_acceleration(); }
const std::vector<NewtonIteration>& Equilibrium::iterations() const { return solver_->iterations; }
const SolverCounts& Equilibrium::counts() const { return solver_->counts; }
double Equilibrium::solve_seconds() const { return solver_->seconds; }

}  // namespace articular::sim
