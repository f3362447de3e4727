#include "sim/step/stepper.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/assembly/load_work.hpp"
#include "sim/base/error.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/contact/touch_left.hpp"
#include "sim/lines/bolus_law.hpp"
#include "sim/model/carried_tissue.hpp"
#include "sim/model/driven_supports.hpp"
#include "sim/model/relative_motion.hpp"
#include "sim/scenario/curve.hpp"
#include "sim/statics/contact_hooks.hpp"
#include "sim/statics/load_prediction.hpp"
#include "sim/step/failure_diagnosis.hpp"
#include "sim/step/run_extrema.hpp"

namespace articular::sim {
namespace {

/// Of the step that was asked for: it is halved thirteen times, no further. What fails all the same
/// does not fail for the length of the step.
constexpr double kLeastPart = 0x1p-13;

const char* words_for(Rejection why) {
  switch (why) {
    case Rejection::NoConvergence:
      return "Newton's iteration did not converge with a step";
    case Rejection::NoEquilibrium:
      return "no equilibrium was found with a load step";
    case Rejection::TooFast:
      return "bodies move by more than an element, or past each other, in a step";
    case Rejection::NotFinite:
      return "forces are not finite after a step";
    case Rejection::Crossing:
      return "surfaces go through each other in a step";
  }
  return "";
}

/// @param gap  between its points [m]
/// @throws SimulationError  if it is higher
void put_in(const BolusModel& bolus, double gap, double t, BolusState& state) {
  state.height = bolus.given.height.value_or(gap);
  if (state.height > gap * (1 + 1e-9))
    throw SimulationError(fmt::format(
        "{}bolus `{}` is {:.4g} mm high and can't be put in at {:.4g} s: there are {:.4g} mm "
        "between its points",
        prefix(bolus.given.where), bolus.given.name, 1e3 * state.height, t, 1e3 * gap));
}

}  // namespace

int most_load_step_iterations(const StepSettings& settings) {
  constexpr int kMost = 2000, kMostSolutions = 10;
  return std::max(kMost, kMostSolutions * settings.max_iterations);
}

double numerical_loss(const State& state, const StoredEnergy& now) {
  const EnergyLedger& l = state.energy;
  return l.start + l.muscle_work + l.load_work + l.motion_work - l.ligament_loss - l.bolus_loss -
         l.tissue_loss - l.contact_loss - l.settling_loss - now.total();
}

Stepper::Stepper(const Model& model, const StepSettings& settings)
    : model_(model), settings_(settings) {
  dynamics_ = std::make_unique<Dynamics>(model);
  if (model.is_static)
    equilibrium_ = std::make_unique<Equilibrium>(model, *dynamics_, settings);
  else
    integrator_ = make_time_integrator(model, *dynamics_, settings);
  if (model.contacts.empty()) return;
  search_ = std::make_unique<ContactSearch>(model, settings);
  crossings_ = std::make_unique<CrossingSearch>(model);
}

State Stepper::initial() {
  State state;
  state.y = initial_state(model_);
  state.next_step = settings_.step;
  state.next_margin = model_.detection_margin;
  state.wraps = initial_wraps(model_);
  state.boluses.resize(model_.boluses.size());
  for (std::size_t b = 0; b < model_.boluses.size(); ++b)
    if (const BolusModel& bolus = model_.boluses[b]; !(bolus.given.from > 0))
      put_in(bolus, model_.lines[static_cast<std::size_t>(bolus.line)].start_length, 0,
             state.boluses[b]);
  restart(state);
  state.energy.start = stored_energy().total();
  state.ways = ways_that_begin(model_, dynamics_->now().configuration);
  note_extrema(dynamics_->now(), state);
  return state;
}

void Stepper::set_watch(IterationWatch watch) {
  if (equilibrium_) equilibrium_->set_watch(std::move(watch));
}

void Stepper::set_stop(const std::function<bool()>& is_to_stop) {
  if (integrator_) integrator_->set_stop(is_to_stop);
  if (equilibrium_) equilibrium_->set_stop(is_to_stop);
}

void Stepper::look_at(const State& state, const Eigen::VectorXd& y) {
  dynamics_->evaluate(y.data(), state.t, {.step_start = model_.is_static ? 0 : t_before_});
}

bool Stepper::follow(const State& state, const Eigen::MatrixXd& excitation,
                     StateResponse& response) {
  if (!response_) response_ = std::make_unique<ResponseSolver>(model_, *dynamics_);
  dynamics_->set_boluses(about_to_be_crushed(state));
  const bool followed =
      model_.is_static ? response_->follow_equilibrium(state.y, state.t, excitation, response)
                       : response_->follow_step(state.y, t_before_, state.t, excitation, response);
  look_at(state, state.y);
  return followed;
}

/// Food that is as deep as ever has a slope for crushing and another one for letting go. Here it
/// has that of crushing near by, too, with the same force.
std::vector<BolusState> Stepper::about_to_be_crushed(const State& state) const {
  constexpr double kNear = 1e-6, kBack = 0.01;  // of the depth
  std::vector<BolusState> boluses = state.boluses;
  for (std::size_t b = 0; b < boluses.size(); ++b) {
    const auto line = static_cast<std::size_t>(model_.boluses[b].line);
    const double depth = boluses[b].height - dynamics_->now().lines[line].length;
    if (depth > (1 - kNear) * boluses[b].deepest) boluses[b].deepest = (1 - kBack) * depth;
  }
  return boluses;
}

void Stepper::restart(const State& state) {
  dynamics_->forget();
  if (integrator_) integrator_->restart(state.next_step);
  if (equilibrium_) equilibrium_->restart();
  dynamics_->set_wraps(state.wraps);
  dynamics_->set_boluses(state.boluses);
  Configuration now;
  read_state(model_, state.y.data(), state.t, now);
  find_contacts(now, state.next_margin);
  dynamics_->evaluate(state.y.data(), state.t, {.step_start = state.t});
}

void Stepper::find_contacts(const Configuration& where, double margin) {
  if (!search_) return;
  search_->find(where, margin);
  dynamics_->set_candidates(search_->candidates());
}

void Stepper::step(State& state, double t_target) {
  const double nominal = settings_.step;
  const double remaining = t_target - state.t;
  const bool free_steps = integrator_ && integrator_->next_step();
  double h = std::min(free_steps ? nominal : std::min(state.next_step, nominal), remaining);
  if (!free_steps) h = remaining / std::max(1.0, std::ceil(remaining / h - 1e-9));
  const bool last = h >= remaining * (1 - 1e-12);

  const SearchCounts search_before = search_ ? search_->counts() : SearchCounts{};
  const SolverCounts solver_before = solver_counts();
  const EvaluationCounts evaluations_before = evaluations();
  remember_start(state);

  double tried = h;
  const double t_start = state.t;
  first_row_ = convergence_.size();
  iterations_ = 0;
  for (;;) {
    if (try_step(state, tried)) break;
    if (0.5 * tried < kLeastPart * nominal || is_exhausted()) fail(state, tried);
    tried *= 0.5;
  }
  if (last && state.t - t_start >= remaining * (1 - 1e-12)) state.t = t_target;
  if (free_steps)
    state.next_step = *integrator_->next_step();
  else
    state.next_step = tried < h ? tried : std::min(nominal, 2 * state.next_step);

  state.counts.evaluations += evaluations();
  state.counts.evaluations -= evaluations_before;
  if (integrator_) stop_where_energy_is_made(state);
  static_cast<SolverCounts&>(state.counts) = state.counts + (solver_counts() - solver_before);
  if (search_) {
    state.counts.tree_updates += search_->counts().tree_updates - search_before.tree_updates;
    state.counts.narrow_tests += search_->counts().narrow_tests - search_before.narrow_tests;
    state.counts.reported_pairs += search_->counts().reported_pairs - search_before.reported_pairs;
    state.counts.deep_pairs += search_->counts().deep_pairs - search_before.deep_pairs;
  }
}

EvaluationCounts Stepper::evaluations() const {
  EvaluationCounts sum = dynamics_->evaluations();
  if (search_) sum += search_->counts().evaluations;
  return sum;
}

SolverCounts Stepper::solver_counts() const {
  return integrator_ ? integrator_->counts() : equilibrium_->counts();
}

void Stepper::remember_start(const State& state) {
  dynamics_->set_boluses(state.boluses);
  lines_before_ = dynamics_->now().lines;
  forces_before_ = dynamics_->now().forces;
  touched_before_ = dynamics_->now().contact.force_on_bodies();
  start_ = dynamics_->now().configuration;
  t_before_ = state.t;
  if (equilibrium_) {
    const StoredEnergy& stored = stored_energy();
    stored_before_ = stored.total();
    loss_before_ = numerical_loss(state, stored);
  }
  depths_before_ = dynamics_->now().contact.point_depths();
  damping_before_ = damping_.power(dynamics_->now());
  contact_power_before_ = dynamics_->now().contact.damping_power();
  fibre_energy_before_.assign(model_.tissues.size(), 0);
  for (std::size_t t = 0; t < model_.tissues.size(); ++t)
    if (model_.tissues[t].muscle >= 0)
      fibre_energy_before_[t] = energy_per_activation(dynamics_->now(), t);
  reactions_before_.assign(model_.rigid_bodies.size(), Vec6::Zero());
  for (std::size_t b = 0; b < model_.rigid_bodies.size(); ++b)
    if (model_.rigid_bodies[b].motion && model_.rigid_bodies[b].unknown)
      reactions_before_[b] = reaction_as_step_begins(dynamics_->now(), static_cast<int>(b));
  support_forces_before_.clear();
  for (const SupportModel& support : model_.supports)
    support_forces_before_.push_back(held_force_on_support(dynamics_->now(), support));
}

bool Stepper::is_exhausted() const {
  return equilibrium_ && iterations_ >= most_load_step_iterations(settings_);
}

bool Stepper::try_step(State& state, double h) {
  if (!(integrator_ ? try_time_step(state, h) : try_load_step(state, h))) return false;
  crush_boluses(state);
  account(state);
  note_snap(state);
  keep_wraps(dynamics_->now().paths, state.wraps);
  dynamics_->set_wraps(state.wraps);
  return true;
}

/// What buckles or snaps through loses a good part of the work that was done.
void Stepper::note_snap(State& after) const {
  constexpr double kMuchLost = 0.25;
  if (snap_.body < 0 || after.extrema.snap.body >= 0) return;
  const StoredEnergy& stored = stored_energy();
  const double loss = numerical_loss(after, stored) - loss_before_;
  const double gained = stored.total() - stored_before_;
  if (!(loss > kMuchLost * std::max(std::abs(gained), std::abs(gained + loss)))) return;
  after.extrema.snap = snap_;
  after.extrema.snap.at = after.t;
  after.extrema.snap.loss = loss;
}

void Stepper::judge_stability() {
  constexpr double kLeastSpeed = 1e-8;  // of the fastest motion: what is slower has no stiffness
  if (!equilibrium_ || !indifferent_.empty() || model_.layout.num_unknown_blocks() == 0) return;
  is_unstable_ = !equilibrium_->is_stable(kLeastSpeed * fastest_rate(model_, *dynamics_));
}

/// Food stays as it was pressed in this step. What is put in has no force yet.
void Stepper::crush_boluses(State& state) const {
  for (std::size_t b = 0; b < model_.boluses.size(); ++b) {
    const BolusModel& bolus = model_.boluses[b];
    BolusState& now = state.boluses[b];
    const double length = dynamics_->now().lines[static_cast<std::size_t>(bolus.line)].length;
    if (now.height > 0)
      state.energy.bolus_loss += crush(bolus.given, now.height - length, now);
    else if (state.t >= bolus.given.from * (1 - 1e-9))
      put_in(bolus, length, state.t, now);
  }
}

/// The door of every step: where it ended, with the forces there.
bool Stepper::is_finite() const { return y_.allFinite() && dynamics_->now().forces.allFinite(); }

/// What has gone through another body since the step's start is lost to contact: there is no force,
/// and an equilibrium without it.
bool Stepper::crosses(State& state) {
  if (!crossings_) return false;
  const Stopwatch watch(crossing_seconds_);
  crossing_ = crossings_->find(start_, dynamics_->now().configuration, depths_before_);
  if (!crossing_) return false;
  ++state.counts.rejected_motion;
  why_ = Rejection::Crossing;
  return true;
}

/// Something moved farther than contacts were looked for. If no force differs, but for the order of
/// sums, once they are looked for where the step ended, it is the solution with them all.
bool Stepper::holds_with_contacts_of_end(const State& state, double t) {
  constexpr double kRoundOff = 1e-12;
  forces_at_end_ = dynamics_->now().forces;
  find_contacts(dynamics_->now().configuration, state.next_margin);
  dynamics_->evaluate(y_.data(), t, {.step_start = state.t});
  const Eigen::VectorXd& forces = dynamics_->now().forces;
  return (forces - forces_at_end_).lpNorm<Eigen::Infinity>() <=
         kRoundOff * forces.lpNorm<Eigen::Infinity>();
}

bool Stepper::try_time_step(State& state, double h) {
  // Implicit Euler needs contacts where the step ends: they are looked for where everything will be
  // if it moves on as now. A scheme with stages between needs them on the whole way, and looks from
  // its middle.
  const bool only_end = settings_.scheme == Integrator::Scheme::ImplicitEuler;
  const Configuration end = predicted(model_, start_, h);
  if (search_ && search_->passes_unseen(start_, end)) {
    ++state.counts.rejected_motion;
    why_ = Rejection::TooFast;
    return false;
  }
  const Configuration where = only_end ? end : predicted(model_, start_, 0.5 * h);
  for (;;) {
    find_contacts(where, state.next_margin);
    y_ = state.y;
    const std::optional<double> reached =
        y_.size() == 0 ? std::optional(state.t + h)  // only driven rigid bodies move
                       : integrator_->advance(y_, state.t, h);
    if (!reached) {
      why_ = Rejection::NoConvergence;
      return false;
    }
    dynamics_->evaluate(y_.data(), *reached, {.step_start = state.t});
    if (!is_finite()) {
      why_ = Rejection::NotFinite;
      return false;
    }
    if (search_) {
      double stray = search_->motion_since(dynamics_->now().configuration);
      if (!only_end) stray = std::max(stray, search_->motion_since(start_));
      if (stray > model_.trusted_motion) {
        ++state.counts.rejected_motion;
        why_ = Rejection::TooFast;
        return false;
      }
      const bool covered = stray <= 0.5 * search_->margin();
      state.next_margin = margin_for(model_, stray);
      if (!covered && !(only_end && holds_with_contacts_of_end(state, *reached))) {
        ++state.counts.rejected_motion;
        continue;
      }
    }
    if (crosses(state)) return false;
    state.y = y_;
    state.t = *reached;
    return true;
  }
}

bool Stepper::try_load_step(State& state, double h) {
  y_ = state.y;
  for (std::size_t m = 0; m < model_.muscles.size(); ++m)
    y_[model_.layout.activations() + static_cast<int>(m)] =
        steady_activation(model_.muscles[m], state.t + h);
  ContactHooks contacts;
  if (search_)
    contacts = contact_hooks(model_, *search_, *dynamics_, state.next_margin,
                             state.counts.rejected_motion);
  const LoadStepResult result =
      take_load_step(model_, *dynamics_, *equilibrium_, contacts, state.t, state.t + h,
                     most_load_step_iterations(settings_) - iterations_, y_, convergence_);
  iterations_ += result.iterations;
  loose_ = result.loose;
  snap_ = result.snap;
  if (!result.reached) {
    why_ = Rejection::NoEquilibrium;
    if (loose_) fail(state, h);  // a smaller load would not hold it either
    return false;
  }
  if (!is_finite()) {
    why_ = Rejection::NotFinite;
    return false;
  }
  if (crosses(state)) return false;
  const auto same_body = [&](const RigidBodyMode& other) { return other.body == loose_->body; };
  if (loose_ && std::none_of(indifferent_.begin(), indifferent_.end(), same_body))
    indifferent_.push_back(*loose_);
  state.energy.settling_loss += result.settling_loss;
  state.y = y_;
  state.t += h;
  return true;
}

/// Something touched the body when the step began, and nothing does at its end: the force went on
/// over the depth of that contact, not over half of the way.
bool Stepper::has_parted(int body) const {
  return touch_left(touched_before_, dynamics_->now().contact.force_on_bodies(),
                    static_cast<std::size_t>(body)) == 0;
}

void Stepper::account(State& after) {
  const Configuration& now = dynamics_->now().configuration;
  EnergyLedger& ledger = after.energy;
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    const LineState &a = lines_before_[l], &b = dynamics_->now().lines[l];
    const double stretch = b.length - a.length;
    ledger.muscle_work -= 0.5 * (a.active + b.active) * stretch;
    // What draws at the far end of a muscle stretches its passive part.
    const double passive = 0.5 * (a.tension - a.active + b.tension - b.active);
    ledger.muscle_work += passive * (b.beyond - a.beyond);
    ledger.ligament_loss += 0.5 * (a.damping + b.damping) * stretch;
  }
  for (std::size_t t = 0; t < model_.tissues.size(); ++t) {
    const int muscle = model_.tissues[t].muscle;
    if (muscle < 0) continue;
    const double rise = now.activation[muscle] - start_.activation[muscle];
    ledger.muscle_work +=
        0.5 * (fibre_energy_before_[t] + energy_per_activation(dynamics_->now(), t)) * rise;
  }
  ledger.tissue_loss +=
      0.5 * (damping_before_ + damping_.power(dynamics_->now())) * (after.t - t_before_);
  ledger.contact_loss += 0.5 * (contact_power_before_ + dynamics_->now().contact.damping_power()) *
                         (after.t - t_before_);
  ledger.load_work += load_work(model_, start_, now, t_before_, after.t);
  for (std::size_t b = 0; b < model_.rigid_bodies.size(); ++b) {
    const RigidBody& rigid = model_.rigid_bodies[b];
    if (!rigid.motion) continue;
    const double before = has_parted(rigid.body) ? 0 : 0.5, then = 1 - before;
    if (rigid.unknown) {
      const Vec6 reaction = reaction_of(dynamics_->now(), static_cast<int>(b));
      ledger.motion_work -=
          before * reactions_before_[b].dot(
                       driven_way(rigid, t_before_, after.t, start_.poses[b].R, t_before_)) +
          then * reaction.dot(driven_way(rigid, t_before_, after.t, now.poses[b].R, after.t));
      continue;
    }
    const Eigen::AngleAxisd turn(now.poses[b].R * start_.poses[b].R.transpose());
    const auto mean = [&](int block) -> Vec3 {
      return before * forces_before_.segment<3>(3 * block) +
             then * dynamics_->now().forces.segment<3>(3 * block);
    };
    const Vec3 force = mean(rigid.block), moment = mean(rigid.block + 1);
    ledger.motion_work -=
        force.dot(now.poses[b].p - start_.poses[b].p) + moment.dot(turn.angle() * turn.axis());
    if (drives_tissue(model_, rigid))
      ledger.motion_work += carried_kinetic_energy(rigid, now.poses[b], now.velocities[b]) -
                            carried_kinetic_energy(rigid, start_.poses[b], start_.velocities[b]);
  }
  if (has_driven_supports(model_)) ledger.motion_work += work_on_supports(after.t);
  lengthen(model_, start_, now, after.ways);
  note_extrema(dynamics_->now(), after);
}

/// Of what drives supports, since the step's start [J].
double Stepper::work_on_supports(double t) const {
  const std::vector<Vec3> from = support_shifts(model_, t_before_), to = support_shifts(model_, t);
  double work = 0;
  for (std::size_t s = 0; s < model_.supports.size(); ++s) {
    const Vec3 force = held_force_on_support(dynamics_->now(), model_.supports[s]);
    work -= 0.5 * (support_forces_before_[s] + force).dot(to[s] - from[s]);
  }
  if (!model_.is_static)
    work += driven_kinetic_energy(model_, t) - driven_kinetic_energy(model_, t_before_);
  return work;
}

/// What moves has had its energy at the start, from gravity or from what drives it. Where it is
/// twice that, or as much was made by then, be it gone again, what follows means nothing. The work
/// of a driven motion that strikes something within a step is known to about itself.
void Stepper::stop_where_energy_is_made(const State& state) const {
  constexpr double kMost = 2;                // the ledger's sums are trapezoids,
  constexpr double kOfLedger = 0.01;         // each known to about this part
  constexpr double kFarFromTolerance = 1e4;  // a hundred times its velocity
  const EnergyLedger& ledger = state.energy;
  const double kinetic = kinetic_energy(dynamics_->now());
  const double given = ledger.start - gravity_energy(dynamics_->now()) +
                       std::abs(ledger.muscle_work) + std::abs(ledger.load_work) +
                       std::abs(ledger.motion_work);
  const double floor = kFarFromTolerance * energy_of_tolerance(model_, settings_.step) +
                       kOfLedger * turned_over(state);
  const double source = std::max(given, 0.0);
  std::string what;
  if (kinetic > kMost * source + floor)
    what = fmt::format(
        "bodies move with {:.2g} J and were given {:.2g} J, the rest was made out of "
        "nothing",
        kinetic, given);
  else if (state.extrema.made > source + std::abs(ledger.motion_work) + floor)
    what = fmt::format("{:.2g} J were made out of nothing, bodies were given {:.2g} J",
                       state.extrema.made, given);
  else
    return;
  throw SimulationError(
      fmt::format("the simulation cannot go on at t = {:.6g} s: {}{}{}; results are valid until "
                  "shortly before",
                  state.t, what, deepest_contact(model_, dynamics_->contacts()),
                  failure_diagnosis(model_, start_, dynamics_->now().configuration)));
}

/// Of a load step nothing has a speed: what is loose says more.
EquilibriumDiagnosis Stepper::why_no_equilibrium(const State& state, double h) {
  if (loose_)
    return {.cause = fmt::format("; {}: a support is missing, or contact is not made{}",
                                 loose_->words, what_gives_way(model_))};
  const std::string squeezed = failure_diagnosis(model_, start_, dynamics_->now().configuration);
  dynamics_->evaluate(y_.data(), state.t + h);
  find_contacts(dynamics_->now().configuration, state.next_margin);
  dynamics_->evaluate(y_.data(), state.t + h);
  const std::optional<SoftMotion> softest = find_softest_motion(model_, *dynamics_, *equilibrium_);
  EquilibriumDiagnosis diagnosis =
      diagnose_equilibrium(dynamics_->now(), softest, std::span(convergence_).subspan(first_row_));
  diagnosis.cause += diagnosis.is_nearly_free ? what_gives_way(model_) : squeezed;
  return diagnosis;
}

void Stepper::fail(const State& state, double h) {
  EquilibriumDiagnosis why;
  if (why_ == Rejection::Crossing)
    why.cause = "; " + words_for(model_, *crossing_);
  else if (equilibrium_)
    why = why_no_equilibrium(state, h);
  else
    why.cause = failure_diagnosis(model_, start_, dynamics_->now().configuration);
  // Back to the last state, for what the summary says of it.
  find_contacts(start_, state.next_margin);
  dynamics_->evaluate(state.y.data(), state.t, {.step_start = state.t});
  throw SimulationError(
      fmt::format("the simulation cannot go on at t = {:.6g} s: {} of {:.3g} s{}; results are "
                  "valid until then{}",
                  state.t, words_for(why_), h, why.cause, why.details));
}

/// Several ask for that of one moment.
const StoredEnergy& Stepper::stored_energy() const {
  const Moment& now = dynamics_->now();
  if (std::exchange(stored_moment_, now.number) == now.number) return stored_;
  stored_ = {};
  stored_.kinetic = kinetic_energy(now);
  stored_.elastic = elastic_energy(now);
  stored_.gravity = gravity_energy(now);
  stored_.contact = now.contact.stored_energy();
  for (const LineState& line : now.lines) stored_.lines += line.stored;
  return stored_;
}

std::vector<Positions> Stepper::contact_forces() const {
  if (!search_) return std::vector<Positions>(model_.bodies.size());
  return nodal_contact_forces(model_, dynamics_->contact());
}

PhaseTimes Stepper::times() {
  PhaseTimes times;
  if (search_) {
    times.collision_update = search_->counts().update_seconds;
    times.collision_traversal = search_->counts().traversal_seconds;
    times.collision_narrow = search_->counts().narrow_seconds;
    times.crossings = crossing_seconds_;
  }
  times.elastic_force = dynamics_->times().elastic_force;
  times.contact_force = dynamics_->times().contact_force;
  times.assembly = dynamics_->times().assembly;
  times.solve = integrator_ ? integrator_->solve_seconds() : equilibrium_->solve_seconds();
  return times;
}

}  // namespace articular::sim
