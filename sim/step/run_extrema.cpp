#include "sim/step/run_extrema.hpp"

#include <algorithm>
#include <cmath>

#include "sim/assembly/energies.hpp"
#include "sim/contact/contact_search.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Of the energy that was turned over: speeds of a thirtieth of the largest.
constexpr double kRest = 1e-3;
constexpr double kRestedPart = 0.1;  // of the run

/// What is deeper is not found by the usual search: half an element, or a rigid body's shell [m].
double followed_depth(const Model& model, const ContactModel& contact) {
  const Collider& a = *model.bodies[static_cast<std::size_t>(contact.a)].collider;
  const Collider& b = *model.bodies[static_cast<std::size_t>(contact.b)].collider;
  return std::max(depth_range(a, b, contact.averaged).reach,
                  depth_range(b, a, contact.averaged).reach);
}

template <class Which>
void note(double value, Which of, double t, Worst<Which>& worst) {
  if (value > worst.value) worst = {value, of, t};
}

/// Whether the scenario says where it is, wholly or in part: it can't give way there.
bool is_given(const Model& model, const BodyModel& body) {
  if (body.rigid < 0 || body.tissue >= 0) return false;
  const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
  return !rigid.unknown || rigid.motion.has_value();
}

void note_contact(const Model& model, ContactId contact, double depth, double t,
                  RunExtrema& extrema) {
  const ContactModel pair = model.contacts[contact];
  const BodyModel &a = model.bodies[static_cast<std::size_t>(pair.a)],
                  &b = model.bodies[static_cast<std::size_t>(pair.b)];
  note(depth / followed_depth(model, pair), contact, t, extrema.overlap);
  const double layers = a.collider->layer_thickness + b.collider->layer_thickness;
  if (layers > 0)
    note(depth / layers, contact, t, extrema.layer);
  else if (is_given(model, a) && is_given(model, b))
    note(depth, contact, t, extrema.driven);
}

/// Linear ones may be springs, or elastic tissue that is drawn out to its double.
void note_strains(const Moment& now, double t, WorstLigament& worst) {
  for (std::size_t k = 0; k < now.model.ligaments.size(); ++k) {
    const LigamentModel& ligament = now.model.ligaments[k];
    if (ligament.given.law != Ligament::Law::Blankevoort) continue;
    const double length = now.lines[static_cast<std::size_t>(ligament.line)].length;
    note(length / ligament.slack_length - 1, static_cast<int>(k), t, worst);
  }
}

double work_done(const EnergyLedger& l) {
  return std::abs(l.muscle_work) + std::abs(l.load_work) + std::abs(l.motion_work);
}

void note_volumes(const Eigen::VectorXd& ratios, int tissue, double t, RunExtrema& extrema) {
  Eigen::Index e = 0;
  if (const double ratio = ratios.minCoeff(&e); ratio < extrema.least.ratio)
    extrema.least = {ratio, tissue, e, t};
  if (const double ratio = ratios.maxCoeff(&e); ratio > extrema.largest.ratio)
    extrema.largest = {ratio, tissue, e, t};
}

}  // namespace

void note_balance(double numerical_loss, State& state) {
  state.extrema.made = std::max(state.extrema.made, -numerical_loss);
}

void note_extrema(const Moment& now, State& state) {
  const Model& model = now.model;
  RunExtrema& extrema = state.extrema;
  Positions x;
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    positions_of(now.configuration, model.tissues[t].nodes, x);
    note_volumes(model.tissues[t].elements.volume_ratio(x), static_cast<int>(t), state.t, extrema);
  }
  note_strains(now, state.t, extrema.strain);
  const ContactDepths depths = now.contact.node_depths();
  for (const auto& [contact, depth] : depths.all()) {
    if (!(depth > 0)) continue;
    state.max_penetration = std::max(state.max_penetration, depth);
    note_contact(model, contact, depth, state.t, extrema);
  }
  const double kinetic = kinetic_energy(now);
  extrema.kinetic = std::max(extrema.kinetic, kinetic);
  extrema.work = std::max(extrema.work, work_done(state.energy));
  const double gravity = gravity_energy(now);
  extrema.gravity_low = std::min(extrema.gravity_low, gravity);
  extrema.gravity_high = std::max(extrema.gravity_high, gravity);
  if (kinetic > kRest * turned_over(state)) extrema.moved_at = state.t;
}

double turned_over(const State& state) {
  return std::max({state.extrema.kinetic, state.extrema.gravity_high - state.extrema.gravity_low,
                   state.extrema.work, work_done(state.energy)});
}

bool is_at_rest(const State& state) {
  return state.t - state.extrema.moved_at >= kRestedPart * state.t;
}

double energy_of_tolerance(const Model& model, double step) {
  double mass = 0;  // [kg]
  for (const Tissue& tissue : model.tissues) mass += tissue.lumped_mass.sum();
  for (const RigidBody& rigid : model.rigid_bodies)
    if (rigid.unknown) mass += rigid.mass.mass;
  constexpr double kNewtonFraction = 0.1;  // of the tolerance, at which the iteration ends
  const double speed = kNewtonFraction * model.position_tolerance / step;  // [m/s]
  return 0.5 * mass * speed * speed;
}

}  // namespace articular::sim
