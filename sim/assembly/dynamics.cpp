#include "sim/assembly/dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/assembly/side_by_side.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/loads/gravity.hpp"
#include "sim/loads/surface_load.hpp"
#include "sim/model/driven_supports.hpp"
#include "sim/model/held_blocks.hpp"
#include "sim/model/newton_weights.hpp"
#include "sim/model/tissue.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {

Dynamics::Dynamics(const Model& model)
    : model_(model),
      contact_(model),
      matrix_(model),
      moment_(model, contact_),
      wraps_(initial_wraps(model)) {
  moment_.forces.resize(3 * model.num_blocks);
  moment_.rigid_forces.resize(static_cast<std::size_t>(model.layout.num_rigid));
  moment_.held_forces.resize(3, static_cast<Eigen::Index>(model.held_blocks.size()));
  moment_.tissues.resize(model.tissues.size());
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    moment_.tissues[t].x.resize(3, model.tissues[t].X.cols());
    moment_.tissues[t].force.resize(3, model.tissues[t].X.cols());
  }
}

void Dynamics::set_candidates(std::span<const CandidateList> candidates) {
  assembled_.reset();
  candidates_ = candidates;
  matrix_.set_candidates(candidates);
}

void Dynamics::forget() {
  assembled_.reset();
  matrix_.forget();
  contact_.forget();
}

void Dynamics::find_pressure(std::size_t t, const PredictedPressures& pressures) {
  const TissueElements& elements = model_.tissues[t].elements;
  TissueMoment& now = moment_.tissues[t];
  if (pressures.prediction != nullptr && elements.smoothed() != nullptr)
    now.pressure = pressures.prediction->at(t, pressures.part);
  else
    elements.pressure(now.x, now.pressure);
}

/// In a static analysis all stress has relaxed.
void Dynamics::read_internal_variables(std::size_t t, const double* y) {
  const Tissue& tissue = model_.tissues[t];
  TissueMoment& now = moment_.tissues[t];
  tissue.relaxation->stress(now.x, activation_of(tissue, moment_.configuration), now.stress);
  if (!model_.is_static) {
    now.internal_variables = Eigen::Map<const Eigen::VectorXd>(
        y + model_.layout.internal_variables() + tissue.first_internal_variable,
        tissue.relaxation->num_internal_variables());
    return;
  }
  tissue.relaxation->settle(now.stress, now.internal_variables);
}

void Dynamics::note_force(double force) {
  if (!std::isfinite(force)) force = std::numeric_limits<double>::infinity();  // max skips NaN
  moment_.largest_force = std::max(moment_.largest_force, force);
}

void Dynamics::place(const DrivenPlaces& driven) {
  Configuration& configuration = moment_.configuration;
  for (std::size_t b = 0; b < driven.poses.size(); ++b)
    if (model_.rigid_bodies[b].motion) configuration.poses[b] = driven.poses[b];
  std::vector<Vec3> way = driven.shifts;
  const std::vector<Vec3> from = support_shifts(model_, configuration.t);
  for (std::size_t s = 0; s < way.size(); ++s) way[s] -= from[s];
  add_to_nodes(model_, way, configuration.x);
}

const Moment& Dynamics::evaluate(const double* y, double t, const Conditions& conditions) {
  assembled_.reset();
  ++moment_.number;
  Configuration& configuration = moment_.configuration;
  read_state(model_, y, t, configuration);
  if (conditions.driven != nullptr) place(*conditions.driven);
  moment_.step_start = conditions.step_start;
  moment_.begins_step = t == conditions.step_start;
  moment_.forces.setZero();
  moment_.largest_force = 0;
  find_elastic_forces(y, conditions);
  moment_.lines.assign(model_.lines.size(), {});
  find_paths();
  if (!conditions.unloaded) {
    add_loads();
    add_lines();
  }
  {
    const Stopwatch watch(times_.contact_force);
    contact_.evaluate(configuration, candidates_, conditions.contact);
    contact_.add_force(configuration, moment_.forces);
    note_force(contact_.largest_force());
  }
  for (std::size_t r = 0; r < moment_.rigid_forces.size(); ++r)
    moment_.rigid_forces[r] = moment_.forces.segment<6>(3 * model_.rigid_bodies[r].block);
  for (std::size_t k = 0; k < model_.held_blocks.size(); ++k) {
    const auto& [block, free] = model_.held_blocks[k];
    const Vec3 force = moment_.forces.segment<3>(3 * block);
    moment_.held_forces.col(static_cast<Eigen::Index>(k)) = force - free * force;
  }
  keep_free_part(model_, moment_.forces);
  return moment_;
}

/// Of one tissue, in its own part of the moment.
void Dynamics::find_elastic_force(std::size_t k, const double* y, const Conditions& conditions) {
  const Configuration& configuration = moment_.configuration;
  const Tissue& tissue = model_.tissues[k];
  TissueMoment& now = moment_.tissues[k];
  const double activation = activation_of(tissue, configuration);
  positions_of(configuration, tissue.nodes, now.x);
  find_pressure(k, conditions.pressures);
  now.force.setZero();
  tissue.elements.add_internal_force(now.x, now.pressure, activation, now.force);
  for (const SheetModel& sheet : tissue.sheets) sheet.fibres.add_force(now.x, now.force);
  if (tissue.dashpots || tissue.fibre_drag)
    velocities_of(configuration, tissue.nodes, now.velocity);
  if (tissue.dashpots) tissue.dashpots->add_force(now.x, now.velocity, now.force);
  if (tissue.fibre_drag) tissue.fibre_drag->add_force(now.x, now.velocity, activation, now.force);
  if (tissue.relaxation) {
    read_internal_variables(k, y);
    tissue.relaxation->add_force(now.x, now.internal_variables, 1, now.force);
  }
}

/// With the weights of tissue nodes.
void Dynamics::find_elastic_forces(const double* y, const Conditions& conditions) {
  const bool weighs = !conditions.unloaded && !model_.gravity.empty();
  const Vec3 acceleration = gravity_at(model_, moment_.configuration.t);
  if (weighs) ++evaluations_[Term::Gravity];
  const Stopwatch watch(times_.elastic_force);
  const Configuration& configuration = moment_.configuration;
  for_each_tissue(model_, [&](std::size_t k) { find_elastic_force(k, y, conditions); });
  for (std::size_t k = 0; k < moment_.tissues.size(); ++k) {
    const Tissue& tissue = model_.tissues[k];
    const Positions& f = moment_.tissues[k].force;
    ++evaluations_[Term::ElasticForce];
    if (tissue.muscle >= 0) ++evaluations_[Term::FibreMuscle];
    if (tissue.dashpots || tissue.fibre_drag || tissue.mass_damping > 0)
      ++evaluations_[Term::TissueDamping];
    if (tissue.relaxation) ++evaluations_[Term::Relaxation];
    evaluations_[Term::Sheet] += static_cast<std::int64_t>(tissue.sheets.size());
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      Vec3 force = -f.col(column);
      note_force(force.norm());
      if (weighs && carries_own_weight(model_, tissue.nodes[i])) {
        const Vec3 weight = tissue.lumped_mass[column] * acceleration;
        note_force(weight.norm());
        force += weight;
      }
      if (tissue.mass_damping > 0 && tissue.nodes[i].rigid < 0)
        force -= tissue.mass_damping * tissue.lumped_mass[column] *
                 configuration.velocity(tissue.nodes[i]);
      add_force(configuration, tissue.nodes[i], force, moment_.forces);
    }
  }
}

/// Weights of rigid bodies, forces, and loads on surfaces.
void Dynamics::add_loads() {
  const int num_weights = model_.gravity.empty() ? 0 : model_.layout.num_rigid;
  const Vec3 acceleration = gravity_at(model_, moment_.configuration.t);
  for (int r = 0; r < num_weights; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const Vec3 weight = rigid.mass.mass * acceleration;
    moment_.forces.segment<3>(3 * rigid.block) += weight;
    if (rigid.hold)
      moment_.forces.segment<3>(3 * rigid.block + 3) +=
          (moment_.configuration.poses[static_cast<std::size_t>(r)].R *
           (rigid.mass.center - rigid.rest.p))
              .cross(weight);
    note_force(weight.norm());
  }
  for (const ForceModel& force : model_.forces) {
    ++evaluations_[Term::Load];
    const Vec3 now = value_at(force.profile, moment_.configuration.t) * force.force;
    add_force(moment_.configuration, force.point, now, moment_.forces);
    note_force(now.norm());
  }
  for (const MomentModel& load : model_.moments) {
    ++evaluations_[Term::Load];
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(load.rigid)];
    const Vec3 now = value_at(load.profile, moment_.configuration.t) * load.moment;
    moment_.forces.segment<3>(3 * rigid.block + 3) += now;
    note_force(now.norm() / turning_radius(rigid));
  }
  for (const SurfaceLoadModel& load : model_.surface_loads) {
    ++evaluations_[Term::Load];
    note_force(add_surface_force(load, moment_.configuration, moment_.forces));
  }
}

void Dynamics::set_wraps(const WrapHistory& wraps) { wraps_ = wraps; }

void Dynamics::set_boluses(const std::vector<BolusState>& boluses) { boluses_ = boluses; }

void Dynamics::find_paths() {
  moment_.paths.resize(model_.lines.size());
  const std::span<const std::vector<EdgeCrossing>> history(wraps_);
  std::size_t k = 0;
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    const Line& line = model_.lines[l];
    const std::size_t count = line.wrap.strings.size();
    if (count > 0)
      find_path(model_, line, moment_.configuration, history.subspan(k, count), moment_.paths[l]);
    k += count;
  }
}

void Dynamics::add_lines() {
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    ++evaluations_[model_.lines[l].muscle >= 0 ? Term::LineMuscle : Term::Ligament];
    const std::span<const WeightedPoint> path = path_of(moment_, l);
    moment_.lines[l] = line_state(model_, model_.lines[l], path, moment_.configuration, boluses_);
    // No path was found: the step is to be shorter.
    if (!moment_.paths[l].found)
      moment_.lines[l].tension = std::numeric_limits<double>::quiet_NaN();
    add_line_force(path, moment_.configuration, moment_.lines[l].tension, moment_.forces);
    note_force(moment_.lines[l].tension);
  }
}

double activation_time(const Model& model, const double* y, double t, int muscle) {
  const MuscleModel& given = model.muscles[static_cast<std::size_t>(muscle)];
  const Muscle& m = given.given;
  const double u = steady_activation(given, t);
  return u >= y[model.layout.activations() + muscle] ? m.activation_time : m.deactivation_time;
}

EvaluationCounts Dynamics::evaluations() const {
  EvaluationCounts sum = evaluations_;
  sum += matrix_.evaluations();
  sum += contact_.evaluations();
  return sum;
}

void Dynamics::rate(const double* y, double* y_dot) const {
  ++evaluations_[Term::Inertia];
  const Layout& layout = model_.layout;
  const Configuration& configuration = moment_.configuration;
  const Eigen::VectorXd& f = moment_.forces;
  const auto velocity = [&](int block) {
    return Eigen::Map<const Vec3>(y + layout.velocities() + 3 * block);
  };
  const auto acceleration = [&](int block) {
    return Eigen::Map<Vec3>(y_dot + layout.velocities() + 3 * block);
  };
  for (int block = 0; block < layout.num_free_nodes; ++block) {
    Eigen::Map<Vec3>(y_dot + layout.node_x(block)) = velocity(block);
    acceleration(block) = f.segment<3>(3 * block) / model_.node_mass[block];
  }
  for (int r = 0; r < layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const Vec3 omega = velocity(rigid.block + 1);
    Eigen::Map<Vec3>(y_dot + layout.rigid_p(r)) = velocity(rigid.block);
    // q̇ = ½ ω ⊗ q, q = (w, x, y, z).
    const double* q = y + layout.rigid_q(r);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z()) *
                                      Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    double* q_dot = y_dot + layout.rigid_q(r);
    q_dot[0] = 0.5 * turned.w();
    q_dot[1] = 0.5 * turned.x();
    q_dot[2] = 0.5 * turned.y();
    q_dot[3] = 0.5 * turned.z();
    if (rigid.hold) {
      const auto b = static_cast<std::size_t>(r);
      const Vec6 rate =
          rigid_acceleration(rigid, configuration.poses[b], configuration.velocities[b],
                             {configuration.t, moment_.begins_step}, moment_.rigid_forces[b]);
      acceleration(rigid.block) = rate.head<3>();
      acceleration(rigid.block + 1) = rate.tail<3>();
      continue;
    }
    const Mat3 inertia = world_inertia(model_, configuration, r);
    acceleration(rigid.block) = f.segment<3>(3 * rigid.block) / rigid.mass.mass;
    acceleration(rigid.block + 1) =
        inertia.llt().solve(f.segment<3>(3 * rigid.block + 3) - omega.cross(inertia * omega));
  }
  for (std::size_t t = 0; t < moment_.tissues.size(); ++t)
    if (const auto& relaxation = model_.tissues[t].relaxation)
      relaxation->rate(moment_.tissues[t].stress, moment_.tissues[t].internal_variables,
                       Eigen::Map<Eigen::VectorXd>(y_dot + layout.internal_variables() +
                                                       model_.tissues[t].first_internal_variable,
                                                   relaxation->num_internal_variables()));
  for (int m = 0; m < layout.num_muscles; ++m) {
    const double u =
        steady_activation(model_.muscles[static_cast<std::size_t>(m)], configuration.t);
    const int i = layout.activations() + m;
    y_dot[i] = (u - y[i]) / activation_time(model_, y, configuration.t, m);
  }
}

void Dynamics::multiply_mass(const Eigen::VectorXd& b, Eigen::VectorXd& r) const {
  ++evaluations_[Term::Inertia];
  r.resize(b.size());
  const Configuration& configuration = moment_.configuration;
  for (int block = 0; block < model_.layout.num_free_nodes; ++block) {
    r.segment<3>(3 * block) = model_.node_mass[block] * b.segment<3>(3 * block);
  }
  for (int k = 0; k < model_.layout.num_rigid; ++k) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(k)];
    if (rigid.hold) {
      r.segment<6>(3 * rigid.block) =
          rigid_mass(rigid, configuration.poses[static_cast<std::size_t>(k)]) *
          b.segment<6>(3 * rigid.block);
      continue;
    }
    r.segment<3>(3 * rigid.block) = rigid.mass.mass * b.segment<3>(3 * rigid.block);
    r.segment<3>(3 * rigid.block + 3) =
        world_inertia(model_, configuration, k) * b.segment<3>(3 * rigid.block + 3);
  }
  keep_free_part(model_, r);
}

void Dynamics::take_pressures(const PredictedPressures& pressures) {
  if (pressures.prediction == nullptr) return;
  for (std::size_t t = 0; t < moment_.tissues.size(); ++t)
    if (is_smoothed(model_.tissues[t])) find_pressure(t, pressures);
}

NewtonEquations Dynamics::assemble(const SystemScale& scale, fem::Tangent tangent,
                                   const PredictedPressures& pressures) {
  const std::pair wanted(scale, tangent);
  if (pressures.prediction == nullptr && assembled_ == wanted) return matrix_.equations();
  const Stopwatch watch(times_.assembly);
  take_pressures(pressures);
  assembled_ = wanted;
  return matrix_.assemble(moment_, scale, tangent);
}

NewtonEquations Dynamics::assemble_again(const GroupChanges& changes, const SystemScale& scale,
                                         fem::Tangent tangent,
                                         const PredictedPressures& pressures) {
  const Stopwatch watch(times_.assembly);
  assembled_.reset();
  take_pressures(pressures);
  if (matrix_.add(changes, scale.stiffness)) return matrix_.equations();
  return matrix_.assemble(moment_, scale, tangent);
}

std::vector<ContactSummary> Dynamics::contacts() const {
  return contact_summaries(model_, contact_, moment_.configuration);
}

ContactSummary Dynamics::contact_summary(ContactId contact) const {
  return summary_through(model_, contact_, moment_.configuration, contact,
                         model_.contacts[contact].a, {});
}

}  // namespace articular::sim
