#include "sim/worst.hpp"

#include <algorithm>
#include <cmath>

#include "sim/contact_search.hpp"
#include "sim/tissue.hpp"

namespace articular::sim {
namespace {

/// What is deeper is not found by the usual search: half an element, or a bone's shell [m].
double followed_depth(const Model& model, const ContactModel& contact) {
  const Collider& a = *model.bodies[static_cast<std::size_t>(contact.a)].collider;
  const Collider& b = *model.bodies[static_cast<std::size_t>(contact.b)].collider;
  return std::max(depth_range(a, b, contact.averaged).reach,
                  depth_range(b, a, contact.averaged).reach);
}

double work_done(const EnergyLedger& l) {
  return std::abs(l.muscle_work) + std::abs(l.load_work) + std::abs(l.motion_work);
}

}  // namespace

void note_balance(double numerical_loss, State& state) {
  state.worst.made = std::max(state.worst.made, -numerical_loss);
}

void note_worst(const Model& model, const Dynamics& dynamics, State& state) {
  Worst& worst = state.worst;
  Positions x;
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    positions_of(dynamics.configuration(), model.tissues[t].nodes, x);
    Eigen::Index element = 0;
    const double least = model.tissues[t].elements.volume_ratio(x).minCoeff(&element);
    if (!(least < worst.volume_ratio)) continue;
    worst.volume_ratio = least;
    worst.tissue = static_cast<int>(t);
    worst.element = element;
    worst.squeezed_at = state.t;
  }
  for (const ContactSummary& contact : dynamics.contacts()) {
    if (!(contact.max_depth > 0)) continue;
    state.max_penetration = std::max(state.max_penetration, contact.max_depth);
    const ContactModel& pair = model.contacts[static_cast<std::size_t>(contact.contact)];
    const double overlap = contact.max_depth / followed_depth(model, pair);
    if (!(overlap > worst.overlap)) continue;
    worst.overlap = overlap;
    worst.contact = contact.contact;
    worst.overlap_at = state.t;
  }
  worst.kinetic = std::max(worst.kinetic, dynamics.kinetic_energy());
  worst.work = std::max(worst.work, work_done(state.energy));
  const double gravity = dynamics.gravity_energy();
  worst.gravity_low = std::min(worst.gravity_low, gravity);
  worst.gravity_high = std::max(worst.gravity_high, gravity);
}

double turned_over(const State& state) {
  return std::max({state.worst.kinetic, state.worst.gravity_high - state.worst.gravity_low,
                   state.worst.work, work_done(state.energy)});
}

double energy_of_tolerance(const Model& model) {
  double mass = 0;  // [kg]
  for (const Tissue& tissue : model.tissues) mass += tissue.lumped_mass.sum();
  for (const Bone& bone : model.bones)
    if (bone.unknown) mass += bone.mass.mass;
  constexpr double kNewtonFraction = 0.1;  // of the tolerance, at which the iteration ends
  const double speed =
      kNewtonFraction * model.position_tolerance / model.scenario.integrator.step;  // [m/s]
  return 0.5 * mass * speed * speed;
}

}  // namespace articular::sim
