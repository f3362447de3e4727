#include "sim/assembly/dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "fem/element/smoothed_elasticity.hpp"
#include "sim/base/stopwatch.hpp"
#include "sim/model/tissue.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {

Dynamics::Dynamics(const Model& model) : model_(model), contact_(model), matrix_(model) {
  f_.resize(3 * model.num_blocks);
  all_force_.resize(static_cast<std::size_t>(model.layout.num_rigid));
  tissues_.resize(model.tissues.size());
  predicted_.resize(model.tissues.size());
  mass_nodes_.resize(static_cast<std::size_t>(model.layout.num_free_nodes));
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    const Tissue& tissue = model.tissues[t];
    tissues_[t].x.resize(3, tissue.X.cols());
    tissue_force_.emplace_back(3, tissue.X.cols());
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].rigid < 0)
        mass_nodes_[static_cast<std::size_t>(tissue.nodes[i].block)] = {static_cast<int>(t),
                                                                        static_cast<int>(i)};
    trusted_motion_ = std::min(trusted_motion_, element_size(tissue));
  }
  for (const BodyModel& body : model.bodies)
    if (body.collider) trusted_motion_ = std::min(trusted_motion_, body.collider->reach);
}

double Dynamics::activation_of(std::size_t tissue) const {
  return sim::activation_of(model_.tissues[tissue], configuration_);
}

void Dynamics::set_candidates(std::span<const CandidateList> candidates) {
  candidates_ = candidates;
  matrix_.couple(candidates);
}

void Dynamics::displacements_of(std::size_t t, const Eigen::VectorXd& dx, Positions& u) const {
  const Tissue& tissue = model_.tissues[t];
  u.setZero(3, static_cast<Eigen::Index>(tissue.nodes.size()));
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const NodeRef& node = tissue.nodes[i];
    if (node.rigid >= model_.layout.num_rigid) continue;
    const auto column = static_cast<Eigen::Index>(i);
    u.col(column) = dx.segment<3>(3 * node.block);
    if (node.rigid >= 0)
      u.col(column) += dx.segment<3>(3 * node.block + 3).cross(configuration_.lever(node));
  }
}

void Dynamics::predict_pressures(const Eigen::VectorXd& dx) {
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const fem::SmoothedElasticity* smoothed = model_.tissues[t].elements.smoothed();
    if (smoothed == nullptr) continue;
    displacements_of(t, dx, v_);
    predicted_[t].before = tissues_[t].pressure;
    smoothed->predicted_pressure(tissues_[t].x, matrix_.pressure_gradient(t), v_,
                                 predicted_[t].after);
  }
}

void Dynamics::predict_for_matrix(double part) {
  for (std::size_t t = 0; t < tissues_.size(); ++t)
    if (model_.tissues[t].elements.smoothed() != nullptr) tissues_[t].pressure = predicted(t, part);
}

Eigen::VectorXd Dynamics::predicted(std::size_t t, double part) const {
  return predicted_[t].before + part * (predicted_[t].after - predicted_[t].before);
}

void Dynamics::find_pressure(std::size_t t) {
  if (prediction_part_ && model_.tissues[t].elements.smoothed() != nullptr) {
    tissues_[t].pressure = predicted(t, *prediction_part_);
    return;
  }
  model_.tissues[t].elements.pressure(tissues_[t].x, tissues_[t].pressure);
}

/// In a static analysis all stress has relaxed.
void Dynamics::read_internal_variables(std::size_t t, const double* y) {
  const Tissue& tissue = model_.tissues[t];
  TissueMoment& now = tissues_[t];
  tissue.relaxation->stress(now.x, activation_of(t), now.stress);
  if (!model_.is_static) {
    now.internal_variables = Eigen::Map<const Eigen::VectorXd>(
        y + model_.layout.internal_variables() + tissue.first_internal_variable,
        tissue.relaxation->num_internal_variables());
    return;
  }
  tissue.relaxation->settle(now.stress, now.internal_variables);
}

bool Dynamics::carries_own_weight(const NodeRef& node) const {
  return node.rigid < 0 || node.rigid >= model_.layout.num_rigid;
}

void Dynamics::evaluate(const double* y, double t) {
  read_state(model_, y, t, configuration_);
  find_forces(y);
}

void Dynamics::evaluate(const double* y, double t, const std::vector<Pose>& driven) {
  read_state(model_, y, t, configuration_);
  for (std::size_t b = 0; b < driven.size(); ++b)
    if (model_.rigid_bodies[b].motion) configuration_.poses[b] = driven[b];
  find_forces(y);
}

void Dynamics::find_forces(const double* y) {
  f_.setZero();
  largest_force_ = 0;
  const auto enters = [this](double force) { largest_force_ = std::max(largest_force_, force); };
  const bool weighs = !unloaded_ && !model_.gravity.isZero(0);
  if (weighs) ++evaluations_[Term::Gravity];
  {
    const Stopwatch watch(times_.elastic_force);
    for (std::size_t k = 0; k < tissues_.size(); ++k) {
      const Tissue& tissue = model_.tissues[k];
      TissueMoment& moment = tissues_[k];
      Positions& f = tissue_force_[k];
      positions_of(configuration_, tissue.nodes, moment.x);
      find_pressure(k);
      f.setZero();
      tissue.elements.add_internal_force(moment.x, moment.pressure, activation_of(k), f);
      ++evaluations_[Term::ElasticForce];
      if (tissue.muscle >= 0) ++evaluations_[Term::FibreMuscle];
      if (tissue.dashpots || tissue.mass_damping > 0) ++evaluations_[Term::TissueDamping];
      if (tissue.dashpots) {
        velocities_of(configuration_, tissue.nodes, v_);
        tissue.dashpots->add_force(moment.x, v_, f);
      }
      if (tissue.relaxation) {
        ++evaluations_[Term::Relaxation];
        read_internal_variables(k, y);
        tissue.relaxation->add_force(moment.x, moment.internal_variables, 1, f);
      }
      for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        Vec3 force = -f.col(column);
        enters(force.norm());
        if (weighs && carries_own_weight(tissue.nodes[i])) {
          const Vec3 weight = tissue.lumped_mass[column] * model_.gravity;
          enters(weight.norm());
          force += weight;
        }
        if (tissue.mass_damping > 0 && tissue.nodes[i].rigid < 0)
          force -= tissue.mass_damping * tissue.lumped_mass[column] *
                   configuration_.velocity(tissue.nodes[i]);
        add_force(configuration_, tissue.nodes[i], force, f_);
      }
    }
  }
  lines_.assign(model_.lines.size(), {});
  if (!unloaded_) {
    add_loads(configuration_.t);
    add_lines();
  }
  {
    const Stopwatch watch(times_.contact_force);
    contact_.evaluate(configuration_, candidates_);
    contact_.add_force(configuration_, f_);
    enters(contact_.largest_force());
  }
  for (std::size_t r = 0; r < all_force_.size(); ++r)
    all_force_[r] = f_.segment<6>(3 * model_.rigid_bodies[r].block);
  keep_free_part(model_, f_);
}

Vec6 Dynamics::reaction(int rigid) const {
  const auto b = static_cast<std::size_t>(rigid);
  const RigidBody& held = model_.rigid_bodies[b];
  if (!held.unknown) return f_.segment<6>(3 * held.block);
  if (model_.is_static) return all_force_[b] - free_part(held, all_force_[b]);
  return force_on_hold(held, configuration_.poses[b], configuration_.velocities[b], instant(),
                       all_force_[b]);
}

/// Those of bones, and forces.
void Dynamics::add_loads(double t) {
  const int num_weights = model_.gravity.isZero(0) ? 0 : model_.layout.num_rigid;
  for (int r = 0; r < num_weights; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const Vec3 weight = rigid.mass.mass * model_.gravity;
    f_.segment<3>(3 * rigid.block) += weight;
    if (rigid.hold)
      f_.segment<3>(3 * rigid.block + 3) +=
          (configuration_.poses[static_cast<std::size_t>(r)].R * (rigid.mass.center - rigid.rest.p))
              .cross(weight);
    largest_force_ = std::max(largest_force_, weight.norm());
  }
  for (const ForceModel& force : model_.forces) {
    ++evaluations_[Term::Load];
    const Vec3 now = value_at(force.profile, t) * force.force;
    add_force(configuration_, force.point, now, f_);
    largest_force_ = std::max(largest_force_, now.norm());
  }
}

void Dynamics::add_lines() {
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    ++evaluations_[model_.lines[l].muscle >= 0 ? Term::LineMuscle : Term::Ligament];
    lines_[l] = line_state(model_, model_.lines[l], configuration_);
    add_line_force(model_.lines[l], configuration_, lines_[l].tension, f_);
    largest_force_ = std::max(largest_force_, lines_[l].tension);
  }
}

double Dynamics::activation_time(const double* y, double t, int muscle) const {
  const Muscle& m = model_.muscles[static_cast<std::size_t>(muscle)].given;
  const double u = steady_activation(model_.muscles[static_cast<std::size_t>(muscle)], t);
  return u >= y[model_.layout.activations() + muscle] ? m.activation_time : m.deactivation_time;
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
  const auto velocity = [&](int block) {
    return Eigen::Map<const Vec3>(y + layout.velocities() + 3 * block);
  };
  const auto acceleration = [&](int block) {
    return Eigen::Map<Vec3>(y_dot + layout.velocities() + 3 * block);
  };
  for (int block = 0; block < layout.num_free_nodes; ++block) {
    Eigen::Map<Vec3>(y_dot + layout.node_x(block)) = velocity(block);
    acceleration(block) = f_.segment<3>(3 * block) / mass_of(block);
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
      const Vec6 rate = rigid_acceleration(rigid, configuration_.poses[b],
                                           configuration_.velocities[b], instant(), all_force_[b]);
      acceleration(rigid.block) = rate.head<3>();
      acceleration(rigid.block + 1) = rate.tail<3>();
      continue;
    }
    const Mat3 inertia = world_inertia(model_, configuration_, r);
    acceleration(rigid.block) = f_.segment<3>(3 * rigid.block) / rigid.mass.mass;
    acceleration(rigid.block + 1) =
        inertia.llt().solve(f_.segment<3>(3 * rigid.block + 3) - omega.cross(inertia * omega));
  }
  for (std::size_t t = 0; t < tissues_.size(); ++t)
    if (const auto& relaxation = model_.tissues[t].relaxation)
      relaxation->rate(tissues_[t].stress, tissues_[t].internal_variables,
                       Eigen::Map<Eigen::VectorXd>(y_dot + layout.internal_variables() +
                                                       model_.tissues[t].first_internal_variable,
                                                   relaxation->num_internal_variables()));
  for (int m = 0; m < layout.num_muscles; ++m) {
    const double u =
        steady_activation(model_.muscles[static_cast<std::size_t>(m)], configuration_.t);
    const int i = layout.activations() + m;
    y_dot[i] = (u - y[i]) / activation_time(y, configuration_.t, m);
  }
}

std::pair<Vec3, Vec3> Dynamics::attachment_force(int tissue, int rigid) const {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const Tissue& given = model_.tissues[static_cast<std::size_t>(tissue)];
  const auto& nodes = given.nodes;
  // A collider of tissue has the nodes of its mesh, in their order.
  const Positions contact =
      std::move(nodal_contact_forces(model_, contact_)[static_cast<std::size_t>(given.body)]);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].rigid != rigid) continue;
    const auto column = static_cast<Eigen::Index>(i);
    Vec3 pull = -tissue_force_[static_cast<std::size_t>(tissue)].col(column);
    if (contact.cols() > 0) pull += contact.col(column);
    force += pull;
    moment += configuration_.lever(nodes[i]).cross(pull);
  }
  return {force, moment};
}

double Dynamics::mass_of(int block) const {
  const auto [t, node] = mass_nodes_[static_cast<std::size_t>(block)];
  return model_.tissues[static_cast<std::size_t>(t)].lumped_mass[node];
}

void Dynamics::multiply_mass(const Eigen::VectorXd& b, Eigen::VectorXd& r) const {
  ++evaluations_[Term::Inertia];
  r.resize(b.size());
  for (int block = 0; block < model_.layout.num_free_nodes; ++block) {
    r.segment<3>(3 * block) = mass_of(block) * b.segment<3>(3 * block);
  }
  for (int k = 0; k < model_.layout.num_rigid; ++k) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(k)];
    if (rigid.hold) {
      r.segment<6>(3 * rigid.block) =
          free_part(rigid, rigid_mass(rigid, configuration_.poses[static_cast<std::size_t>(k)]) *
                               b.segment<6>(3 * rigid.block));
      continue;
    }
    r.segment<3>(3 * rigid.block) = rigid.mass.mass * b.segment<3>(3 * rigid.block);
    r.segment<3>(3 * rigid.block + 3) =
        world_inertia(model_, configuration_, k) * b.segment<3>(3 * rigid.block + 3);
  }
}

const fem::BlockMatrix& Dynamics::matrix(const SystemScale& scale, fem::Tangent tangent) {
  const Stopwatch watch(times_.assembly);
  return matrix_.assemble({configuration_, lines_, tissues_, contact_}, scale, tangent);
}

double Dynamics::kinetic_energy() const {
  double energy = 0;
  for (int block = 0; block < model_.layout.num_free_nodes; ++block) {
    energy += 0.5 * mass_of(block) * configuration_.v.col(block).squaredNorm();
  }
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const auto& velocity = configuration_.velocities[static_cast<std::size_t>(r)];
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    if (rigid.hold) {
      Vec6 both;
      both << velocity.linear, velocity.angular;
      energy +=
          0.5 *
          both.dot(rigid_mass(rigid, configuration_.poses[static_cast<std::size_t>(r)]) * both);
      continue;
    }
    energy += 0.5 * model_.rigid_bodies[static_cast<std::size_t>(r)].mass.mass *
              velocity.linear.squaredNorm();
    energy +=
        0.5 * velocity.angular.dot(world_inertia(model_, configuration_, r) * velocity.angular);
  }
  return energy;
}

double Dynamics::elastic_energy() const {
  double energy = 0;
  for (std::size_t t = 0; t < tissues_.size(); ++t)
    energy += model_.tissues[t].elements.energy(tissues_[t].x, activation_of(t));
  if (model_.is_static)
    for (std::size_t t = 0; t < tissues_.size(); ++t)
      if (const auto& relaxation = model_.tissues[t].relaxation)
        energy += relaxation->settled_energy(tissues_[t].x, activation_of(t));
  return energy;
}

double Dynamics::energy_per_activation(std::size_t tissue) const {
  const TissueElements& elements = model_.tissues[tissue].elements;
  return elements.energy(tissues_[tissue].x, 1) - elements.energy(tissues_[tissue].x, 0);
}

double Dynamics::damping_power() const {
  double power = 0;
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const Tissue& tissue = model_.tissues[t];
    if (tissue.dashpots) {
      velocities_of(configuration_, tissue.nodes, v_);
      power += tissue.dashpots->power(tissues_[t].x, v_);
    }
    if (tissue.relaxation && !model_.is_static) {
      velocities_of(configuration_, tissue.nodes, v_);
      damping_.setZero(3, v_.cols());
      tissue.relaxation->add_force(tissues_[t].x, tissues_[t].internal_variables, 1, damping_);
      power += damping_.cwiseProduct(v_).sum();
    }
    if (tissue.mass_damping == 0) continue;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].rigid < 0)
        power += tissue.mass_damping * tissue.lumped_mass[static_cast<Eigen::Index>(i)] *
                 configuration_.velocity(tissue.nodes[i]).squaredNorm();
  }
  return power;
}

void Dynamics::add_damping_product(const Eigen::VectorXd& u, double scale,
                                   Eigen::VectorXd& f) const {
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const Tissue& tissue = model_.tissues[t];
    if (!tissue.dashpots && tissue.mass_damping == 0) continue;
    const auto count = static_cast<Eigen::Index>(tissue.nodes.size());
    displacements_of(t, u, v_);
    damping_.setZero(3, count);
    for (Eigen::Index i = 0; i < count; ++i)
      if (tissue.nodes[static_cast<std::size_t>(i)].rigid < 0)
        damping_.col(i) = tissue.mass_damping * tissue.lumped_mass[i] * v_.col(i);
    if (tissue.dashpots) tissue.dashpots->add_force(tissues_[t].x, v_, damping_);
    for (Eigen::Index i = 0; i < count; ++i)
      add_force(configuration_, tissue.nodes[static_cast<std::size_t>(i)], scale * damping_.col(i),
                f);
  }
  contact_.add_damping_product(configuration_, u, scale, f);
}

void Dynamics::add_internal_variable_force(const double* b, double gamma,
                                           Eigen::VectorXd& f) const {
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const Tissue& tissue = model_.tissues[t];
    if (!tissue.relaxation) continue;
    internal_part_ = Eigen::Map<const Eigen::VectorXd>(
        b + model_.layout.internal_variables() + tissue.first_internal_variable,
        tissue.relaxation->num_internal_variables());
    const Eigen::Index n = internal_part_.size() / tissue.relaxation->num_terms();
    for (Eigen::Index i = 0; i < tissue.relaxation->num_terms(); ++i)
      internal_part_.segment(n * i, n) /=
          1 + gamma / tissue.relaxation->terms()[static_cast<std::size_t>(i)].time;
    damping_.setZero(3, static_cast<Eigen::Index>(tissue.nodes.size()));
    tissue.relaxation->add_force(tissues_[t].x, internal_part_, -1, damping_);
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      add_force(configuration_, tissue.nodes[i], damping_.col(static_cast<Eigen::Index>(i)), f);
  }
}

/// δS0 is that of the law, not of its tangent: it costs less, and the internal variables' rows are
/// met at once.
void Dynamics::correct_internal_variables(const double* b, double gamma, const Eigen::VectorXd& w,
                                          double* x) const {
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const Tissue& tissue = model_.tissues[t];
    if (!tissue.relaxation) continue;
    displacements_of(t, w, v_);
    v_ = tissues_[t].x + gamma * v_;
    tissue.relaxation->stress(v_, activation_of(t), stress_there_);
    stress_there_ -= tissues_[t].stress;
    const Eigen::Index n = stress_there_.size();
    for (Eigen::Index i = 0; i < tissue.relaxation->num_terms(); ++i) {
      const Eigen::Index at =
          model_.layout.internal_variables() + tissue.first_internal_variable + n * i;
      const double ratio = gamma / tissue.relaxation->terms()[static_cast<std::size_t>(i)].time;
      Eigen::Map<Eigen::VectorXd>(x + at, n) =
          (Eigen::Map<const Eigen::VectorXd>(b + at, n) + ratio * stress_there_) / (1 + ratio);
    }
  }
}

double Dynamics::gravity_energy() const {
  double energy = 0;
  for (const Tissue& tissue : model_.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (carries_own_weight(tissue.nodes[i]))
        energy -= tissue.lumped_mass[static_cast<Eigen::Index>(i)] *
                  model_.gravity.dot(configuration_.position(tissue.nodes[i]));
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const Pose& pose = configuration_.poses[static_cast<std::size_t>(r)];
    const Vec3 center = pose.p + pose.R * (rigid.mass.center - rigid.rest.p);
    energy -= rigid.mass.mass * model_.gravity.dot(center);
  }
  return energy;
}

}  // namespace articular::sim
