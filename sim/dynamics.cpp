#include "sim/dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "sim/stopwatch.hpp"

namespace articular::sim {

Dynamics::Dynamics(const Model& model) : model_(model) {
  f_.resize(3 * model.num_blocks);
  mass_nodes_.resize(static_cast<std::size_t>(model.layout.num_free_nodes));
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    const Tissue& tissue = model.tissues[t];
    tissues_.push_back({Positions(3, tissue.X.cols()),
                        Positions(3, tissue.X.cols()),
                        tissue.elements.make_matrix(),
                        {},
                        {},
                        {}});
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].bone < 0)
        mass_nodes_[static_cast<std::size_t>(tissue.nodes[i].block)] = {static_cast<int>(t),
                                                                        static_cast<int>(i)};
    const Tetrahedra& tets = tissue.elements.tets();
    double volume = 0;
    for (const double element : tissue.elements.rest_volume()) volume += element;
    // Edge of the cube that six mean tetrahedra fill.
    trusted_motion_ =
        std::min(trusted_motion_, std::cbrt(6 * volume / static_cast<double>(tets.cols())));
    append_stencils(tissue);
    if (tissue.elements.smoothed() != nullptr) make_pressure_gradient(t);
  }
  for (int r = 0; r < model.layout.num_rigid; ++r) {
    const int block = model.bones[static_cast<std::size_t>(r)].block;
    base_.blocks.insert(base_.blocks.end(), {block, block + 1});
    base_.close();
  }
  for (const BodyModel& body : model.bodies)
    if (body.collider) trusted_motion_ = std::min(trusted_motion_, body.collider->reach);
  for (const Line& line : model.lines) append_stencil(model, line, base_);
  build_pattern();
}

/// The couplings of a tissue's elements, or of its smoothing domains.
void Dynamics::append_stencils(const Tissue& tissue) {
  const auto append = [&](int node) {
    append_blocks(model_, tissue.nodes[static_cast<std::size_t>(node)], base_.blocks);
  };
  if (const fem::SmoothedElasticity* smoothed = tissue.elements.smoothed()) {
    const fem::EdgeDomains& domains = smoothed->domains();
    for (int k = 0; k < domains.size(); ++k) {
      for (int i = domains.node_begin[static_cast<std::size_t>(k)];
           i < domains.node_begin[static_cast<std::size_t>(k) + 1]; ++i)
        append(domains.node[static_cast<std::size_t>(i)]);
      base_.close();
    }
    return;
  }
  for (const auto& element : tissue.elements.tets().colwise()) {
    for (const int node : element) append(node);
    base_.close();
  }
}

/// The pattern of a tissue's pressure gradient by blocks of unknowns.
void Dynamics::make_pressure_gradient(std::size_t t) {
  const Tissue& tissue = model_.tissues[t];
  const fem::SmoothedElasticity& smoothed = *tissue.elements.smoothed();
  const Tetrahedra& corners = smoothed.nodal_pressure().of_corner();
  Stencils blocks;
  std::vector<int> offsets{0};
  for (Eigen::Index e = 0; e < corners.cols(); ++e) {
    for (const int node : tissue.elements.tets().col(e))
      append_blocks(model_, tissue.nodes[static_cast<std::size_t>(node)], blocks.blocks);
    blocks.close();
    offsets.push_back(static_cast<int>(4 * (e + 1)));
  }
  TissueWork& work = tissues_[t];
  work.node_G = smoothed.make_pressure_gradient();
  work.G = fem::PressureGradient(
      model_.layout.num_unknown_blocks(), smoothed.num_pressures(), blocks.blocks, blocks.offsets,
      {corners.data(), static_cast<std::size_t>(corners.size())}, offsets);
}

/// A node that is tied to a bone pushes the bone, and turns it by its lever.
void Dynamics::set_pressure_gradient(std::size_t t) {
  const Tissue& tissue = model_.tissues[t];
  TissueWork& work = tissues_[t];
  tissue.elements.smoothed()->set_pressure_gradient(work.x, work.node_G);
  work.G.set_zero();
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const NodeRef& node = tissue.nodes[i];
    if (node.bone >= model_.layout.num_rigid) continue;
    for (int s = work.node_G.row_begin()[i]; s < work.node_G.row_begin()[i + 1]; ++s) {
      const int c = work.node_G.column()[static_cast<std::size_t>(s)];
      const Vec3& g = work.node_G.block(s);
      work.G.block(work.G.slot(node.block, c)) += g;
      if (node.bone >= 0)
        work.G.block(work.G.slot(node.block + 1, c)) += configuration_.lever(node).cross(g);
    }
  }
}

double Dynamics::activation_of(std::size_t tissue) const {
  const int muscle = model_.tissues[tissue].muscle;
  return muscle < 0 ? 0 : configuration_.activation[muscle];
}

void Dynamics::forget() {
  if (contact_couplings_.blocks.empty()) return;
  contact_couplings_ = {};
  build_pattern();
}

void Dynamics::set_candidates(const std::vector<CandidateList>& candidates) {
  candidates_ = &candidates;
  const std::size_t known = contact_couplings_.blocks.size();
  append_missing_stencils(model_, candidates, A_, contact_couplings_);
  if (contact_couplings_.blocks.size() > known) build_pattern();
}

void Dynamics::build_pattern() {
  Stencils all = base_;
  for (std::size_t s = 0; s + 1 < contact_couplings_.offsets.size(); ++s) {
    all.blocks.insert(all.blocks.end(),
                      contact_couplings_.blocks.begin() + contact_couplings_.offsets[s],
                      contact_couplings_.blocks.begin() + contact_couplings_.offsets[s + 1]);
    all.close();
  }
  A_ = fem::BlockMatrix(model_.layout.num_unknown_blocks(), all.blocks, all.offsets);
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    TissueWork& work = tissues_[t];
    const auto& nodes = model_.tissues[t].nodes;
    work.slot.assign(static_cast<std::size_t>(work.K.num_nonzero_blocks()), -1);
    for (int i = 0; i < work.K.num_blocks(); ++i)
      for (int s = work.K.row_begin()[static_cast<std::size_t>(i)];
           s < work.K.row_begin()[static_cast<std::size_t>(i) + 1]; ++s) {
        const int j = work.K.column()[static_cast<std::size_t>(s)];
        const NodeRef &p = nodes[static_cast<std::size_t>(i)],
                      &q = nodes[static_cast<std::size_t>(j)];
        if (p.bone < 0 && q.bone < 0)
          work.slot[static_cast<std::size_t>(s)] = A_.slot(p.block, q.block);
      }
  }
}

bool Dynamics::carries_own_weight(const NodeRef& node) const {
  return node.bone < 0 || node.bone >= model_.layout.num_rigid;
}

void Dynamics::evaluate(const double* y, double t) {
  read_state(model_, y, t, configuration_);
  f_.setZero();
  largest_force_ = 0;
  const auto enters = [this](double force) { largest_force_ = std::max(largest_force_, force); };
  {
    const Stopwatch watch(times_.elastic_force);
    for (std::size_t k = 0; k < tissues_.size(); ++k) {
      const Tissue& tissue = model_.tissues[k];
      TissueWork& work = tissues_[k];
      positions_of(configuration_, tissue.nodes, work.x);
      work.f.setZero();
      tissue.elements.add_internal_force(work.x, activation_of(k), work.f);
      if (tissue.dashpots) {
        velocities_of(configuration_, tissue.nodes, v_);
        tissue.dashpots->add_force(work.x, v_, work.f);
      }
      for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        Vec3 force = -work.f.col(column);
        enters(force.norm());
        if (carries_own_weight(tissue.nodes[i])) {
          const Vec3 weight = tissue.lumped_mass[column] * model_.gravity;
          enters(weight.norm());
          force += weight;
        }
        if (tissue.mass_damping > 0 && tissue.nodes[i].bone < 0)
          force -= tissue.mass_damping * tissue.lumped_mass[column] *
                   configuration_.velocity(tissue.nodes[i]);
        add_force(configuration_, tissue.nodes[i], force, f_);
      }
    }
  }
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const Bone& bone = model_.bones[static_cast<std::size_t>(r)];
    f_.segment<3>(3 * bone.block) += bone.mass.mass * model_.gravity;
    enters(bone.mass.mass * model_.gravity.norm());
  }
  for (const ForceModel& force : model_.forces) {
    const Vec3 now = value_at(force.profile, t) * force.force;
    add_force(configuration_, force.point, now, f_);
    enters(now.norm());
  }
  lines_.resize(model_.lines.size());
  for (std::size_t l = 0; l < model_.lines.size(); ++l) {
    lines_[l] = line_state(model_, model_.lines[l], configuration_);
    add_line_force(model_.lines[l], configuration_, lines_[l].tension, f_);
    enters(lines_[l].tension);
  }
  if (candidates_ != nullptr) {
    const Stopwatch watch(times_.contact_force);
    add_contact_force(model_, configuration_, *candidates_, f_, contacts_);
    for (const ContactSummary& contact : contacts_) enters(contact.force.norm());
  }
}

Mat3 Dynamics::world_inertia(int bone) const {
  const Mat3& R = configuration_.poses[static_cast<std::size_t>(bone)].R;
  return R * model_.bones[static_cast<std::size_t>(bone)].mass.inertia * R.transpose();
}

double Dynamics::activation_time(const double* y, double t, int muscle) const {
  const Muscle& m = model_.muscles[static_cast<std::size_t>(muscle)].given;
  const double u = steady_activation(model_.muscles[static_cast<std::size_t>(muscle)], t);
  return u >= y[model_.layout.activations() + muscle] ? m.activation_time : m.deactivation_time;
}

void Dynamics::rate(const double* y, double* y_dot) const {
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
    const Bone& bone = model_.bones[static_cast<std::size_t>(r)];
    const Vec3 omega = velocity(bone.block + 1);
    Eigen::Map<Vec3>(y_dot + layout.bone_p(r)) = velocity(bone.block);
    // q̇ = ½ ω ⊗ q, q = (w, x, y, z).
    const double* q = y + layout.bone_q(r);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z()) *
                                      Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    double* q_dot = y_dot + layout.bone_q(r);
    q_dot[0] = 0.5 * turned.w();
    q_dot[1] = 0.5 * turned.x();
    q_dot[2] = 0.5 * turned.y();
    q_dot[3] = 0.5 * turned.z();
    const Mat3 inertia = world_inertia(r);
    acceleration(bone.block) = f_.segment<3>(3 * bone.block) / bone.mass.mass;
    acceleration(bone.block + 1) =
        inertia.llt().solve(f_.segment<3>(3 * bone.block + 3) - omega.cross(inertia * omega));
  }
  for (int m = 0; m < layout.num_muscles; ++m) {
    const double u =
        steady_activation(model_.muscles[static_cast<std::size_t>(m)], configuration_.t);
    const int i = layout.activations() + m;
    y_dot[i] = (u - y[i]) / activation_time(y, configuration_.t, m);
  }
}

std::pair<Vec3, Vec3> Dynamics::attachment_force(int tissue, int bone) const {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const auto& nodes = model_.tissues[static_cast<std::size_t>(tissue)].nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].bone != bone) continue;
    const Vec3 pull =
        -tissues_[static_cast<std::size_t>(tissue)].f.col(static_cast<Eigen::Index>(i));
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
  r.resize(b.size());
  for (int block = 0; block < model_.layout.num_free_nodes; ++block) {
    r.segment<3>(3 * block) = mass_of(block) * b.segment<3>(3 * block);
  }
  for (int k = 0; k < model_.layout.num_rigid; ++k) {
    const Bone& bone = model_.bones[static_cast<std::size_t>(k)];
    r.segment<3>(3 * bone.block) = bone.mass.mass * b.segment<3>(3 * bone.block);
    r.segment<3>(3 * bone.block + 3) = world_inertia(k) * b.segment<3>(3 * bone.block + 3);
  }
}

void Dynamics::add_tissue_stiffness(std::size_t t, const SystemScale& scale, fem::Tangent tangent) {
  const Tissue& tissue = model_.tissues[t];
  TissueWork& work = tissues_[t];
  work.K.set_zero();
  tissue.elements.add_stiffness(work.x, activation_of(t), tangent, scale.stiffness, work.K);
  if (tissue.dashpots) tissue.dashpots->add_damping(work.x, scale.damping, work.K);
  if (const fem::SmoothedElasticity* smoothed = tissue.elements.smoothed()) {
    set_pressure_gradient(t);
    pressure_terms_.push_back({&work.G, &smoothed->nodal_pressure(), scale.stiffness});
  }
  for (int i = 0; i < work.K.num_blocks(); ++i)
    for (int s = work.K.row_begin()[static_cast<std::size_t>(i)];
         s < work.K.row_begin()[static_cast<std::size_t>(i) + 1]; ++s) {
      const int slot = work.slot[static_cast<std::size_t>(s)];
      if (slot >= 0) {
        A_.block(slot) += work.K.block(s);
        continue;
      }
      const int j = work.K.column()[static_cast<std::size_t>(s)];
      add_stiffness(model_, configuration_, tissue.nodes[static_cast<std::size_t>(i)],
                    tissue.nodes[static_cast<std::size_t>(j)], work.K.block(s), A_);
    }
}

const fem::BlockMatrix& Dynamics::matrix(const SystemScale& scale, fem::Tangent tangent) {
  const Stopwatch watch(times_.assembly);
  A_.set_zero();
  pressure_terms_.clear();
  for (std::size_t t = 0; t < tissues_.size(); ++t) add_tissue_stiffness(t, scale, tangent);
  for (int block = 0; block < model_.layout.num_free_nodes; ++block) {
    const auto tissue =
        static_cast<std::size_t>(mass_nodes_[static_cast<std::size_t>(block)].first);
    const double share = scale.mass + scale.damping * model_.tissues[tissue].mass_damping;
    A_.block(A_.slot(block, block)).diagonal().array() += share * mass_of(block);
  }
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const Bone& bone = model_.bones[static_cast<std::size_t>(r)];
    A_.block(A_.slot(bone.block, bone.block)).diagonal().array() += scale.mass * bone.mass.mass;
    A_.block(A_.slot(bone.block + 1, bone.block + 1)) += scale.mass * world_inertia(r);
  }
  for (std::size_t l = 0; l < model_.lines.size(); ++l)
    add_line_stiffness(model_, model_.lines[l], configuration_, lines_[l], scale, A_);
  if (candidates_ != nullptr)
    add_contact_stiffness(model_, configuration_, *candidates_, tangent, scale.stiffness, A_);
  return A_;
}

double Dynamics::kinetic_energy() const {
  double energy = 0;
  for (int block = 0; block < model_.layout.num_free_nodes; ++block) {
    energy += 0.5 * mass_of(block) * configuration_.v.col(block).squaredNorm();
  }
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const auto& velocity = configuration_.velocities[static_cast<std::size_t>(r)];
    energy +=
        0.5 * model_.bones[static_cast<std::size_t>(r)].mass.mass * velocity.linear.squaredNorm();
    energy += 0.5 * velocity.angular.dot(world_inertia(r) * velocity.angular);
  }
  return energy;
}

double Dynamics::elastic_energy() const {
  double energy = 0;
  for (std::size_t t = 0; t < tissues_.size(); ++t)
    energy += model_.tissues[t].elements.energy(tissues_[t].x, activation_of(t));
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
    if (tissue.mass_damping == 0) continue;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].bone < 0)
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
    v_.resize(3, count);
    damping_.setZero(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const NodeRef& node = tissue.nodes[static_cast<std::size_t>(i)];
      v_.col(i) = u.segment<3>(3 * node.block);
      if (node.bone >= 0)
        v_.col(i) += u.segment<3>(3 * node.block + 3).cross(configuration_.lever(node));
      else
        damping_.col(i) = tissue.mass_damping * tissue.lumped_mass[i] * v_.col(i);
    }
    if (tissue.dashpots) tissue.dashpots->add_force(tissues_[t].x, v_, damping_);
    for (Eigen::Index i = 0; i < count; ++i)
      add_force(configuration_, tissue.nodes[static_cast<std::size_t>(i)], scale * damping_.col(i),
                f);
  }
}

double Dynamics::gravity_energy() const {
  double energy = 0;
  for (const Tissue& tissue : model_.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (carries_own_weight(tissue.nodes[i]))
        energy -= tissue.lumped_mass[static_cast<Eigen::Index>(i)] *
                  model_.gravity.dot(configuration_.position(tissue.nodes[i]));
  for (int r = 0; r < model_.layout.num_rigid; ++r)
    energy -= model_.bones[static_cast<std::size_t>(r)].mass.mass *
              model_.gravity.dot(configuration_.poses[static_cast<std::size_t>(r)].p);
  return energy;
}

}  // namespace articular::sim
