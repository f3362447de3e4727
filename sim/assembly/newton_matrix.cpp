#include "sim/assembly/newton_matrix.hpp"

#include <algorithm>
#include <span>

#include "fem/element/smoothed_elasticity.hpp"
#include "sim/assembly/side_by_side.hpp"
#include "sim/assembly/turning_stiffness.hpp"
#include "sim/lines/wrapped_stiffness.hpp"
#include "sim/loads/surface_load.hpp"
#include "sim/model/held_blocks.hpp"

namespace articular::sim {
namespace {

/// Free nodes have their block; fixed and driven ones are no unknowns.
std::vector<int> free_block_of_node(const Tissue& tissue) {
  std::vector<int> blocks;
  blocks.reserve(tissue.nodes.size());
  for (const NodeRef& node : tissue.nodes) blocks.push_back(node.rigid < 0 ? node.block : -1);
  return blocks;
}

/// Where the blocks of one matrix are in another whose pattern holds them all.
std::vector<int> slots_in(const fem::BlockMatrix& A, const fem::BlockMatrix& part) {
  std::vector<int> slots;
  slots.reserve(static_cast<std::size_t>(part.num_nonzero_blocks()));
  for (int i = 0; i < part.num_blocks(); ++i)
    for (int s = part.row_begin()[static_cast<std::size_t>(i)];
         s < part.row_begin()[static_cast<std::size_t>(i) + 1]; ++s)
      slots.push_back(A.slot(i, part.column()[static_cast<std::size_t>(s)]));
  return slots;
}

fem::BlockMatrix matrix_of(const Model& model, Stencils stencils, const Stencils& more) {
  for (std::size_t s = 0; s + 1 < more.offsets.size(); ++s) {
    stencils.blocks.insert(stencils.blocks.end(), more.blocks.begin() + more.offsets[s],
                           more.blocks.begin() + more.offsets[s + 1]);
    stencils.close();
  }
  return {model.layout.num_unknown_blocks(), stencils.blocks, stencils.offsets};
}

}  // namespace

NewtonMatrix::NewtonMatrix(const Model& model)
    : model_(model),
      for_multigrid_(model.linear_solver.kind == fem::SolverKind::Multigrid),
      tissues_(model.tissues.size()),
      contact_(model) {
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const Tissue& tissue = model.tissues[t];
    if (!adds_directly(tissue)) tissues_[t].own.K = tissue.elements.make_matrix();
    if (const fem::SmoothedElasticity* smoothed = tissue.elements.smoothed()) {
      smoothed_ = true;
      tissues_[t].plain.K = smoothed->make_plain_matrix();
      if (!tissue.sheets.empty()) tissues_[t].beside = tissues_[t].plain.K;
      make_pressure_gradient(t);
    }
  }
  base_ = base_stencils(true);
  if (smoothed_) plain_base_ = base_stencils(false);
  build_pattern();
}

/// Sheets, dashpots, fibres with a drag and relaxation need a matrix of the tissue, and so do nodes
/// whose rigid body is an unknown, which the tissue pushes by levers.
bool NewtonMatrix::adds_directly(const Tissue& tissue) const {
  if (is_smoothed(tissue) || !tissue.sheets.empty() || tissue.dashpots || tissue.fibre_drag ||
      tissue.relaxation)
    return false;
  return std::none_of(tissue.nodes.begin(), tissue.nodes.end(), [this](const NodeRef& node) {
    return node.rigid >= 0 && node.rigid < model_.layout.num_rigid;
  });
}

/// The couplings of all but contact. @param smoothing  of smoothing domains, not only of elements
Stencils NewtonMatrix::base_stencils(bool smoothing) const {
  Stencils base;
  for (const Tissue& tissue : model_.tissues) {
    const auto append = [&](int node) {
      append_blocks(model_, tissue.nodes[static_cast<std::size_t>(node)], base.blocks);
    };
    if (const fem::SmoothedElasticity* smoothed = tissue.elements.smoothed();
        smoothing && smoothed != nullptr) {
      const fem::EdgeDomains& domains = smoothed->domains();
      for (std::size_t k = 0; k + 1 < domains.node_begin.size(); ++k) {
        for (int i = domains.node_begin[k]; i < domains.node_begin[k + 1]; ++i)
          append(domains.node[static_cast<std::size_t>(i)]);
        base.close();
      }
      continue;
    }
    for (const auto& element : tissue.elements.tets().colwise()) {
      for (const int node : element) append(node);
      base.close();
    }
  }
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const int block = model_.rigid_bodies[static_cast<std::size_t>(r)].block;
    base.blocks.insert(base.blocks.end(), {block, block + 1});
    base.close();
  }
  for (const Line& line : model_.lines)
    if (line.wrap.strings.empty())
      append_stencil(model_, line, base);
    else
      append_wrapped_stencil(model_, line, base);
  return base;
}

void NewtonMatrix::couple_contacts(const Moment& now) {
  const fem::BlockMatrix& common = smoothed_ ? plain_ : A_;
  if (!lacks_stencils(model_, now.contact.pair_states(), common, blocks_of_groups_)) return;
  append_missing_stencils(model_, candidates_, common, contacts_);
  build_pattern();
}

void NewtonMatrix::forget_fibre_rates() {
  for (TissueWork& work : tissues_) work.fibre_lines.clear();
}

void NewtonMatrix::forget() {
  if (contacts_.blocks.empty()) return;
  contacts_ = {};
  build_pattern();
}

void NewtonMatrix::build_pattern() {
  A_ = matrix_of(model_, base_, contacts_);
  if (smoothed_) {
    plain_ = matrix_of(model_, plain_base_, contacts_);
    slot_of_plain_ = slots_in(A_, plain_);
  }
  for (std::size_t t = 0; t < tissues_.size(); ++t) {
    const Tissue& tissue = model_.tissues[t];
    TissueWork& work = tissues_[t];
    fem::BlockMatrix& common = smoothed_ ? plain_ : A_;
    if (adds_directly(tissue)) {
      work.direct = tissue.elements.slots_in(common, free_block_of_node(tissue));
    } else if (is_smoothed(tissue)) {
      find_slots(tissue, A_, work.own);
      find_slots(tissue, plain_, work.plain);
    } else {
      find_slots(tissue, common, work.own);
    }
  }
}

void NewtonMatrix::find_slots(const Tissue& tissue, const fem::BlockMatrix& A,
                              TissueMatrix& matrix) const {
  const fem::BlockMatrix& K = matrix.K;
  matrix.slot.assign(static_cast<std::size_t>(K.num_nonzero_blocks()), -1);
  matrix.carried.clear();
  for (int i = 0; i < K.num_blocks(); ++i) {
    const NodeRef& row = tissue.nodes[static_cast<std::size_t>(i)];
    for (int s = K.row_begin()[static_cast<std::size_t>(i)];
         s < K.row_begin()[static_cast<std::size_t>(i) + 1]; ++s) {
      const int j = K.column()[static_cast<std::size_t>(s)];
      const NodeRef& column = tissue.nodes[static_cast<std::size_t>(j)];
      const NodePairSlots to = slots_of(model_, row, column, A);
      if (row.rigid < 0 && column.rigid < 0)
        matrix.slot[static_cast<std::size_t>(s)] = to.own;
      else if (to.own >= 0)
        matrix.carried.push_back({s, i, j, to});
    }
  }
}

/// The pattern of a tissue's pressure gradient by blocks of unknowns.
void NewtonMatrix::make_pressure_gradient(std::size_t t) {
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

/// A node that is tied to a rigid body pushes the rigid body, and turns it by its lever.
void NewtonMatrix::set_pressure_gradient(std::size_t t, const Moment& now) {
  const Tissue& tissue = model_.tissues[t];
  TissueWork& work = tissues_[t];
  tissue.elements.smoothed()->set_pressure_gradient(now.tissues[t].x, work.node_G);
  work.G.set_zero();
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const NodeRef& node = tissue.nodes[i];
    if (node.rigid >= model_.layout.num_rigid) continue;
    for (int s = work.node_G.row_begin()[i]; s < work.node_G.row_begin()[i + 1]; ++s) {
      const int c = work.node_G.column()[static_cast<std::size_t>(s)];
      const Vec3& g = work.node_G.block(s);
      work.G.block(work.G.slot(node.block, c)) += g;
      if (node.rigid >= 0)
        work.G.block(work.G.slot(node.block + 1, c)) += now.configuration.lever(node).cross(g);
    }
  }
  keep_free_part(model_, work.G);
}

void NewtonMatrix::add_relaxation(std::size_t t, const Moment& now, const SystemScale& scale,
                                  fem::Tangent tangent) {
  const Tissue& tissue = model_.tissues[t];
  if (!tissue.relaxation) return;
  const TissueMoment& moment = now.tissues[t];
  tissue.relaxation->add_stiffness(moment.x, activation_of(tissue, now.configuration), tangent,
                                   moment.stress, moment.internal_variables, scale.step,
                                   scale.stiffness, tissues_[t].own.K);
}

void NewtonMatrix::add_dashpots(std::size_t t, const Moment& now, const SystemScale& scale,
                                fem::Tangent tangent) {
  const Tissue& tissue = model_.tissues[t];
  if (!tissue.dashpots || scale.damping == 0) return;
  const TissueMoment& moment = now.tissues[t];
  tissue.dashpots->add_tangent(moment.x, moment.velocity, scale.damping,
                               tangent == fem::Tangent::Consistent ? scale.stiffness : 0,
                               tissues_[t].own.K);
  if (is_smoothed(tissue))
    tissue.dashpots->add_plain_damping(moment.x, scale.damping, tissues_[t].plain.K);
}

void NewtonMatrix::add_fibre_drag(std::size_t t, const Moment& now, const SystemScale& scale,
                                  fem::Tangent tangent) {
  const Tissue& tissue = model_.tissues[t];
  if (!tissue.fibre_drag) return;
  const TissueMoment& moment = now.tissues[t];
  const double activation = activation_of(tissue, now.configuration);
  TissueWork& work = tissues_[t];
  tissue.fibre_drag->add_tangent(moment.x, moment.velocity, activation, scale.damping,
                                 tangent == fem::Tangent::Consistent ? scale.stiffness : 0,
                                 work.fibre_lines, work.own.K);
  if (is_smoothed(tissue))
    tissue.fibre_drag->add_plain_damping(moment.x, moment.velocity, activation, scale.damping,
                                         work.fibre_lines, work.plain.K);
}

/// Sheets have the pattern of plain elements.
void NewtonMatrix::add_sheets(std::size_t t, const Moment& now, const SystemScale& scale,
                              fem::BlockMatrix& K) {
  for (const SheetModel& sheet : model_.tissues[t].sheets)
    sheet.fibres.add_stiffness(now.tissues[t].x, scale.stiffness, K);
}

/// The matrices of a tissue that has some of its own.
void NewtonMatrix::find_stiffness(std::size_t t, const Moment& now, const SystemScale& scale,
                                  fem::Tangent tangent) {
  const Tissue& tissue = model_.tissues[t];
  TissueWork& work = tissues_[t];
  if (work.direct) return;
  if (is_smoothed(tissue)) {
    find_smoothed_stiffness(t, now, scale, tangent);
    return;
  }
  work.own.K.set_zero();
  tissue.elements.add_stiffness(now.tissues[t].x, {}, activation_of(tissue, now.configuration),
                                tangent, scale.stiffness, work.own.K);
  add_sheets(t, now, scale, work.own.K);
  add_dashpots(t, now, scale, tangent);
  add_fibre_drag(t, now, scale, tangent);
  add_relaxation(t, now, scale, tangent);
}

void NewtonMatrix::find_smoothed_stiffness(std::size_t t, const Moment& now,
                                           const SystemScale& scale, fem::Tangent tangent) {
  const Tissue& tissue = model_.tissues[t];
  const fem::SmoothedElasticity& smoothed = *tissue.elements.smoothed();
  TissueWork& work = tissues_[t];
  const double activation = activation_of(tissue, now.configuration);
  const Positions& x = now.tissues[t].x;
  work.beside.set_zero();
  add_sheets(t, now, scale, work.beside);
  work.own.K.set_zero();
  smoothed.add_stiffness(x, now.tissues[t].pressure, tangent, scale.stiffness, work.own.K,
                         activation);
  add_relaxation(t, now, scale, tangent);
  // A preconditioner has to be positive definite, wherever the matrix is.
  work.plain.K.set_zero();
  smoothed.add_plain_stiffness(x, fem::Tangent::Projected, scale.stiffness, work.plain.K,
                               activation);
  if (for_multigrid_) smoothed.add_compressible_stiffness(x, scale.stiffness, work.plain.K);
  add_dashpots(t, now, scale, tangent);
  add_fibre_drag(t, now, scale, tangent);
  set_pressure_gradient(t, now);
}

/// A += K between nodes that are free. Those of different tissues are different.
void NewtonMatrix::add_free(const fem::BlockMatrix& K, const TissueMatrix& places,
                            fem::BlockMatrix& A) {
  for (std::size_t s = 0; s < places.slot.size(); ++s)
    if (places.slot[s] >= 0) A.block(places.slot[s]) += K.block(static_cast<int>(s));
}

/// A += K where a node moves with a rigid body.
void NewtonMatrix::add_carried(const fem::BlockMatrix& K, const TissueMatrix& places,
                               const Tissue& tissue, const Configuration& now,
                               fem::BlockMatrix& A) {
  for (const CarriedBlock& block : places.carried)
    add_stiffness(now, tissue.nodes[static_cast<std::size_t>(block.i)],
                  tissue.nodes[static_cast<std::size_t>(block.j)], block.to, K.block(block.slot),
                  A);
}

/// All of a plain tissue; of a smoothed one, what both matrices have of it.
void NewtonMatrix::add_tissue(std::size_t t, const Moment& now, const SystemScale& scale,
                              fem::Tangent tangent, fem::BlockMatrix& A) {
  const Tissue& tissue = model_.tissues[t];
  const TissueWork& work = tissues_[t];
  ++evaluations_[Term::ElasticStiffness];
  if (work.direct) {
    tissue.elements.add_stiffness(now.tissues[t].x, activation_of(tissue, now.configuration),
                                  tangent, scale.stiffness, *work.direct, A);
    return;
  }
  const bool smoothed = is_smoothed(tissue);
  if (smoothed && tissue.sheets.empty()) return;
  const fem::BlockMatrix& K = smoothed ? work.beside : work.own.K;
  const TissueMatrix& places = smoothed ? work.plain : work.own;
  add_free(K, places, A);
  add_carried(K, places, tissue, now.configuration, A);
}

/// What the two matrices do not share: the stiffness of the domains, and that of the elements.
/// Then both keep their free part.
void NewtonMatrix::add_smoothed(const Moment& now, const SystemScale& scale) {
  for_each_smoothed(model_, [&](std::size_t t) {
    add_free(tissues_[t].own.K, tissues_[t].own, A_);
    add_free(tissues_[t].plain.K, tissues_[t].plain, plain_);
  });
  const auto add_all_carried = [&](TissueMatrix TissueWork::*part, fem::BlockMatrix& A) {
    for (std::size_t t = 0; t < tissues_.size(); ++t)
      if (const TissueMatrix& matrix = tissues_[t].*part; is_smoothed(model_.tissues[t]))
        add_carried(matrix.K, matrix, model_.tissues[t], now.configuration, A);
    keep_free_part(model_, A);
  };
  model_.pool->run(2, [&](int k, int) {
    if (k == 0)
      add_all_carried(&TissueWork::own, A_);
    else
      add_all_carried(&TissueWork::plain, plain_);
  });
  for (std::size_t t = 0; t < tissues_.size(); ++t)
    if (const fem::SmoothedElasticity* smoothed = model_.tissues[t].elements.smoothed())
      pressure_terms_.push_back({&tissues_[t].G, &smoothed->nodal_pressure(), scale.stiffness});
}

void NewtonMatrix::add_masses(const Configuration& now, const SystemScale& scale,
                              fem::BlockMatrix& A) {
  const bool any_damping =
      scale.damping != 0 && std::any_of(model_.tissues.begin(), model_.tissues.end(),
                                        [](const Tissue& t) { return t.mass_damping > 0; });
  if (scale.mass == 0 && !any_damping) return;  // equilibrium
  ++evaluations_[Term::Inertia];
  for (const Tissue& tissue : model_.tissues) {
    const double share = scale.mass + scale.damping * tissue.mass_damping;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (const NodeRef& node = tissue.nodes[i]; node.rigid < 0)
        A.block(A.slot(node.block, node.block)).diagonal().array() +=
            share * tissue.lumped_mass[static_cast<Eigen::Index>(i)];
  }
  for (int r = 0; r < model_.layout.num_rigid; ++r) {
    const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(r)];
    const Mat6 mass = rigid_mass(rigid, now.poses[static_cast<std::size_t>(r)]);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        A.block(A.slot(rigid.block + i, rigid.block + j)) +=
            scale.mass * mass.block<3, 3>(3 * i, 3 * j);
  }
}

/// Writes nothing that a tissue's own matrices need, and wakes no threads.
void NewtonMatrix::set_all_but_tissue(const Moment& now, const SystemScale& scale,
                                      fem::Tangent tangent, fem::BlockMatrix& common) {
  common.set_zero();
  add_masses(now.configuration, scale, common);
  for (std::size_t l = 0; l < model_.lines.size(); ++l)
    if (model_.lines[l].wrap.strings.empty())
      add_line_stiffness(model_, model_.lines[l], now.configuration, now.lines[l], scale, common);
    else
      add_wrapped_stiffness(model_, model_.lines[l], now.paths[l], now.configuration, now.lines[l],
                            scale, tangent == fem::Tangent::Projected, common);
  if (tangent == fem::Tangent::Consistent) {  // neither is positive semidefinite
    add_turning_stiffness(now, scale.stiffness, common);
    for (const SurfaceLoadModel& load : model_.surface_loads)
      add_surface_stiffness(model_, load, now.configuration, scale.stiffness, common);
  }
  friction_.clear();
  for (const ContactPairState* direction : now.contact.pair_states()) {
    if (direction->num_patches == 0) continue;
    ++evaluations_[Term::ContactStiffness];
    contact_.add(*direction, now.configuration, tangent, scale, common, friction_);
  }
}

NewtonEquations NewtonMatrix::assemble(const Moment& now, const SystemScale& scale,
                                       fem::Tangent tangent) {
  couple_contacts(now);
  fem::BlockMatrix& common = smoothed_ ? plain_ : A_;
  const auto stiffness = [&](std::size_t t) { find_stiffness(t, now, scale, tangent); };
  for_each_smoothed_beside(model_, stiffness,
                           [&] { set_all_but_tissue(now, scale, tangent, common); });
  for_each_plain(model_, stiffness);
  for (std::size_t t = 0; t < tissues_.size(); ++t) add_tissue(t, now, scale, tangent, common);
  pressure_terms_.clear();
  if (!smoothed_) {
    keep_free_part(model_, A_);
    return equations();
  }
  A_.set_zero();
  for (std::size_t s = 0; s < slot_of_plain_.size(); ++s)
    A_.block(slot_of_plain_[s]) = plain_.block(static_cast<int>(s));
  add_smoothed(now, scale);
  return equations();
}

bool NewtonMatrix::add(const GroupChanges& changes, double stiffness) {
  fem::BlockMatrix& common = smoothed_ ? plain_ : A_;
  const auto blocks = [&](std::size_t k) {
    const auto begin = static_cast<std::size_t>(changes.begin[k]);
    return std::span<const int>(changes.block)
        .subspan(begin, static_cast<std::size_t>(changes.begin[k + 1]) - begin);
  };
  for (std::size_t k = 0; k < changes.size(); ++k)
    for (const int i : blocks(k))
      for (const int j : blocks(k))
        if (common.slot(i, j) < 0) return false;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const Vec3* const gradient = changes.gradient.data() + changes.begin[k];
    const std::span<const int> around = blocks(k);
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = 0; j < around.size(); ++j) {
        const Mat3 K = stiffness * changes.stiffness[k] * gradient[i] * gradient[j].transpose();
        const int slot = common.slot(around[i], around[j]);
        common.block(slot) += K;
        if (smoothed_) A_.block(slot_of_plain_[static_cast<std::size_t>(slot)]) += K;
      }
  }
  return true;
}

NewtonEquations NewtonMatrix::equations() const {
  return {A_, {pressure_terms_, smoothed_ ? &plain_ : nullptr}, friction_};
}

}  // namespace articular::sim
