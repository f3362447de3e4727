#include "fem/element/smoothed_elasticity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "fem/material/projected_tangent.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

void check(const Smoothing& smoothing, const Tetrahedra& tets,
           const std::vector<AnyMaterial>& materials, const std::vector<int>& of_element) {
  std::ostringstream message;
  if (!(smoothing.plain_share >= 0 && smoothing.plain_share <= 1)) {
    message << "plain_share is " << smoothing.plain_share << ", must lie in [0, 1]";
  } else if (!(smoothing.tau > 0) || !std::isfinite(smoothing.tau)) {
    message << "tau is " << smoothing.tau << ", must be positive and finite";
  } else if (!(smoothing.active_bulk >= 0) || !std::isfinite(smoothing.active_bulk)) {
    message << "active_bulk is " << smoothing.active_bulk << ", must be finite and not negative";
  } else if (of_element.size() != static_cast<std::size_t>(tets.cols())) {
    message << of_element.size() << " indices of materials for " << tets.cols() << " elements";
  } else {
    for (std::size_t e = 0; e < of_element.size(); ++e) {
      if (of_element[e] >= 0 && of_element[e] < static_cast<int>(materials.size())) continue;
      message << "tetrahedron " << e << " has material " << of_element[e] << ": there are "
              << materials.size() << " materials";
      break;
    }
  }
  if (!message.str().empty()) throw std::invalid_argument(message.str());
}

/// Where the tetrahedra's blocks go in G: slot of (a, c) for node a of a batch and pressure c of
/// its corners, 4a + c.
std::vector<EightIndices> slots_in(const PressureGradient& G, const StencilBatches& stencils,
                                   const Tetrahedra& of_corner) {
  std::vector<EightIndices> slots;
  for (const StencilBatches::Chunk& chunk : stencils.chunks()) {
    for (int i = chunk.elements; i < chunk.end; ++i) {
      const StencilBatch batch = stencils.batch(i);
      for (int a = 0; a < 4; ++a) {
        for (int c = 0; c < 4; ++c) {
          EightIndices& slot = slots.emplace_back();
          for (int lane = 0; lane < kBatchSize; ++lane) {
            slot.lane[lane] =
                G.slot(batch.node[a].lane[lane], of_corner(c, stencils.index(i).lane[lane]));
          }
        }
      }
    }
  }
  return slots;
}

/// What for_each_element_octet() asks for.
const Eight* no_pressure(int, Eight&) { return nullptr; }
const Eight* unit_pressure(int, Eight& ones) {
  std::fill(std::begin(ones.lane), std::end(ones.lane), 1.0);
  return &ones;
}

Eigen::Vector<double, 6> components(const Mat3& s) {
  return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
}

std::vector<int> offsets_by_four(std::size_t num_elements) {
  std::vector<int> offsets(num_elements + 1);
  for (std::size_t e = 0; e < offsets.size(); ++e) offsets[e] = static_cast<int>(4 * e);
  return offsets;
}

}  // namespace

SmoothedElasticity::SmoothedElasticity(const Positions& X, const Tetrahedra& tets,
                                       const AnyMaterial& material, const Smoothing& smoothing,
                                       FibreDirections fibres, InstructionSet instruction_set)
    : SmoothedElasticity(X, tets, std::vector{material},
                         std::vector<int>(static_cast<std::size_t>(tets.cols()), 0), smoothing,
                         std::move(fibres), instruction_set) {}

SmoothedElasticity::SmoothedElasticity(const Positions& X, const Tetrahedra& tets,
                                       std::vector<AnyMaterial> materials,
                                       std::vector<int> material_of_element,
                                       const Smoothing& smoothing, FibreDirections fibres,
                                       InstructionSet instruction_set)
    : num_nodes_(static_cast<int>(X.cols())),
      tets_(tets),
      materials_(std::make_shared<const std::vector<AnyMaterial>>(std::move(materials))),
      material_of_element_(std::move(material_of_element)),
      smoothing_(smoothing),
      fibres_(std::move(fibres)),
      instruction_set_(instruction_set) {
  check(smoothing_, tets_, *materials_, material_of_element_);
  for (const AnyMaterial& material : *materials_) check_fibres(material, fibres_, tets_);
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    volume_.push_back(checked_volume(X, tets, e));
    inverse_edges_.push_back(edge_matrix(gather(X, tets, e)).inverse());
  }
  const int num_materials = static_cast<int>(materials_->size());
  element_begin_.push_back(0);
  for (int m = 0; m < num_materials; ++m) {
    for (int e = 0; e < num_elements(); ++e) {
      if (material_of_element_[e] == m) elements_.push_back(e);
    }
    element_begin_.push_back(static_cast<int>(elements_.size()));
  }
  std::vector<PressureModuli> moduli;
  for (const AnyMaterial& material : *materials_) {
    moduli.push_back({.kappa = bulk_modulus(material), .mu = shear_modulus(material)});
  }
  domains_ = make_edge_domains(tets_, inverse_edges_, volume_, material_of_element_, num_materials);
  if (fibres_.cols() > 0) domain_fibres_ = mean_fibres(domains_, volume_, fibres_);
  pressure_ =
      NodalPressure(num_nodes_, tets_, volume_, material_of_element_, moduli, smoothing_.tau);

  stencils_ = StencilBatches(X, tets_, domains_, inverse_edges_, volume_, material_of_element_);
  pairs_ = {stencils_, StencilPairs::Part::All, make_matrix()};
  plain_pairs_ = {stencils_, StencilPairs::Part::Elements, make_plain_matrix()};
  gradient_slots_ = slots_in(make_pressure_gradient(), stencils_, pressure_.of_corner());
  p_work_.resize(num_pressures());
  own_pressure_.setZero(num_elements());
  if (std::ranges::any_of(*materials_, [](const AnyMaterial& m) { return active_stress(m) > 0; }))
    means_.emplace(tets_, domains_, make_matrix());
}

/// Calls function(law, k, F_k) for the domains in their order.
template <class Function>
void SmoothedElasticity::for_each_domain(const Positions& x, double activation,
                                         Function function) const {
  assert(x.cols() == num_nodes_);
  for (std::size_t m = 0; m < materials_->size(); ++m) {
    for (int k = domains_.material_begin[m]; k < domains_.material_begin[m + 1]; ++k) {
      function(PointLaw((*materials_)[m], domain_fibres_, k, activation), k,
               gradient_of_domain(x, k));
    }
  }
}

/// Calls function(law, e, F_e) for the elements of one material after the other.
template <class Function>
void SmoothedElasticity::for_each_element(const Positions& x, double activation,
                                          Function function) const {
  assert(x.cols() == num_nodes_);
  for (std::size_t m = 0; m < materials_->size(); ++m) {
    for (int i = element_begin_[m]; i < element_begin_[m + 1]; ++i) {
      const int e = elements_[i];
      function(PointLaw((*materials_)[m], fibres_, e, activation), e,
               deformation_gradient(gather(x, tets_, e), inverse_edges_[e]));
    }
  }
}

/// F_k, written with edges so that a translation cancels first.
Mat3 SmoothedElasticity::gradient_of_domain(const Positions& x, int k) const {
  const int begin = domains_.node_begin[k], end = domains_.node_begin[k + 1];
  const Vec3 origin = x.col(domains_.node[begin]);
  Mat3 F = Mat3::Zero();
  for (int i = begin + 1; i < end; ++i) {
    F += (x.col(domains_.node[i]) - origin) * domains_.gradient[i].transpose();
  }
  return F;
}

/// Calls function(octet) for the domains of a chunk, with their share of the distortion.
template <class Function>
void SmoothedElasticity::for_each_domain_octet(const StencilBatches::Chunk& chunk,
                                               const Positions& x, double activation,
                                               Function function) const {
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  const BatchedLaw law(instruction_set_, (*materials_)[chunk.material], activation);
  for (int i = chunk.begin; i < chunk.elements; ++i) {
    const StencilBatch batch = stencils_.batch(i);
    Eight F[9];
    kernels.deformation_gradient(batch, x.data(), F);
    function(Octet{law,
                   i,
                   batch,
                   {F, 1 - smoothing_.plain_share, nullptr},
                   {domain_fibres_, stencils_.index(i)}});
  }
}

/// The same for the elements of a chunk, with another share of the distortion and the dilatation.
/// @param pressure  pressure(i, memory): those of batch i, or null
template <class Pressure, class Function>
void SmoothedElasticity::for_each_element_octet(const StencilBatches::Chunk& chunk,
                                                const Positions& x, double share, Pressure pressure,
                                                double activation, Function function) const {
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  const BatchedLaw law(instruction_set_, (*materials_)[chunk.material], activation);
  for (int i = chunk.elements; i < chunk.end; ++i) {
    const StencilBatch batch = stencils_.batch(i);
    Eight F[9], p;
    kernels.deformation_gradient(batch, x.data(), F);
    function(Octet{law, i, batch, {F, share, pressure(i, p)}, {fibres_, stencils_.index(i)}});
  }
}

/// All domains and elements, chunk after chunk.
/// @param own_part  how much of their own pressure elements have besides that of the nodes
template <class Function>
void SmoothedElasticity::for_each_octet(const Positions& x, const Eigen::VectorXd& p,
                                        double own_part, double activation,
                                        Function function) const {
  assert(x.cols() == num_nodes_ && p.size() == num_pressures());
  set_own_pressures(x, activation);
  const auto pressure = [&](int i, Eight& memory) {
    return element_pressures(i, p, own_part, memory);
  };
  for (const StencilBatches::Chunk& chunk : stencils_.chunks()) {
    for_each_domain_octet(chunk, x, activation, function);
    for_each_element_octet(chunk, x, smoothing_.plain_share, pressure, activation, function);
  }
}

/// Calls function(e, Θ_e) for the elements in the order of their batches.
template <class Function>
void SmoothedElasticity::for_each_dilatation(const Positions& x, Function function) const {
  for (const StencilBatches::Chunk& chunk : stencils_.chunks()) {
    for_each_element_octet(chunk, x, 0, unit_pressure, 0, [&](const Octet& octet) {
      Eight theta;
      octet.law.energy_density(octet.points, octet.batch.count, octet.fibres, theta);
      for (int lane = 0; lane < octet.batch.count; ++lane)
        function(stencils_.index(octet.index).lane[lane], theta.lane[lane]);
    });
  }
}

/// κ' [Pa]
double SmoothedElasticity::own_bulk(int material, double activation) const {
  return smoothing_.active_bulk * activation *
         active_stress((*materials_)[static_cast<std::size_t>(material)]);
}

bool SmoothedElasticity::has_own_bulk(double activation) const {
  return means_ && activation > 0 && smoothing_.active_bulk > 0;
}

/// own_pressure_ = κ' (Θ_e − Σ_k Θ̄_k/6), k the domains of element e.
void SmoothedElasticity::set_own_pressures(const Positions& x, double activation) const {
  if (!means_) return;  // they stay 0
  if (!has_own_bulk(activation)) {
    own_pressure_.setZero();
    return;
  }
  for_each_dilatation(x, [&](int e, double dilatation) { own_pressure_[e] = dilatation; });
  means_->subtract(domains_, volume_, own_pressure_);
  for (int e = 0; e < num_elements(); ++e)
    own_pressure_[e] *= own_bulk(material_of_element_[e], activation);
}

const Eight* SmoothedElasticity::element_pressures(int i, const Eigen::VectorXd& p, double own_part,
                                                   Eight& memory) const {
  const EightIndices& elements = stencils_.index(i);
  for (int lane = 0; lane < kBatchSize; ++lane) {
    const int e = elements.lane[lane];
    memory.lane[lane] = mean_pressure(e, p) + own_part * own_pressure_[e];
  }
  return &memory;
}

double SmoothedElasticity::mean_pressure(int e, const Eigen::VectorXd& p) const {
  double sum = 0;
  for (const int c : pressure_.of_corner().col(e)) sum += p[c];
  return sum / 4;
}

void SmoothedElasticity::dilatation(const Positions& x, Eigen::VectorXd& b) const {
  assert(x.cols() == num_nodes_);
  b.setZero(num_pressures());
  for_each_dilatation(x, [&](int e, double theta) {
    for (const int c : pressure_.of_corner().col(e)) b[c] += volume_[e] / 4 * theta;
  });
}

void SmoothedElasticity::pressure(const Positions& x, Eigen::VectorXd& p) const {
  dilatation(x, p);
  pressure_.solve(p);
}

void SmoothedElasticity::predicted_pressure(const Positions& x, const PressureGradient& G,
                                            const Positions& dx, Eigen::VectorXd& p) const {
  G.multiply_transposed(dx.reshaped(), p);
  dilatation(x, p_work_);
  p += p_work_;
  pressure_.solve(p);
}

double SmoothedElasticity::energy(const Positions& x, const Eigen::VectorXd& p,
                                  double activation) const {
  double W = 0;
  for_each_octet(x, p, 0.5, activation, [&](const Octet& octet) {
    Eight density;
    octet.law.energy_density(octet.points, octet.batch.count, octet.fibres, density);
    for (int lane = 0; lane < octet.batch.count; ++lane) {
      W += octet.batch.volume->lane[lane] * density.lane[lane];
    }
  });
  return W;
}

double SmoothedElasticity::energy(const Positions& x, double activation) const {
  pressure(x, p_work_);
  p_work_ *= 0.5;  // ½ bᵀp instead of bᵀp: the latter is what energy(x, p) holds
  return energy(x, p_work_, activation);
}

void SmoothedElasticity::add_internal_force(const Positions& x, Positions& f,
                                            double activation) const {
  pressure(x, p_work_);
  add_internal_force(x, p_work_, f, activation);
}

void SmoothedElasticity::add_internal_force(const Positions& x, const Eigen::VectorXd& p,
                                            Positions& f, double activation) const {
  assert(f.cols() == num_nodes_);
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  for_each_octet(x, p, 1, activation, [&](const Octet& octet) {
    Eight P[9];
    octet.law.first_piola(octet.points, octet.batch.count, octet.fibres, P);
    kernels.add_force(octet.batch, P, f.data());
  });
}

BlockMatrix SmoothedElasticity::make_matrix() const {
  return {num_nodes_, domains_.node, domains_.node_begin};
}

BlockMatrix SmoothedElasticity::make_plain_matrix() const {
  return {num_nodes_, {tets_.data(), 4 * volume_.size()}, offsets_by_four(volume_.size())};
}

PressureGradient SmoothedElasticity::make_pressure_gradient() const {
  const std::vector<int> offsets = offsets_by_four(volume_.size());
  const std::size_t count = 4 * volume_.size();
  return {num_nodes_,
          num_pressures(),
          {tets_.data(), count},
          offsets,
          {pressure_.of_corner().data(), count},
          offsets};
}

/// C += bulk ∂Θ/∂F ⊗ ∂Θ/∂F
void SmoothedElasticity::add_bulk_tangent(const Octet& octet, double bulk, Eight* C) {
  Eight ones, gradient[9];
  EightPoints points = octet.points;
  points.share = 0;
  points.pressure = unit_pressure(octet.index, ones);
  octet.law.first_piola(points, octet.batch.count, octet.fibres, gradient);
  for (int n = 0; n < 9; ++n)
    for (int m = 0; m < 9; ++m)
      for (int lane = 0; lane < kBatchSize; ++lane)
        C[m + 9 * n].lane[lane] += bulk * gradient[m].lane[lane] * gradient[n].lane[lane];
}

/// Of one octet to the sums of its chunk.
/// @param bulk  see add_bulk_tangent()
void SmoothedElasticity::add_stiffness(const Octet& octet, double bulk, Tangent tangent,
                                       double scale, const StencilPairs& pairs,
                                       const PairSums& sums) const {
  Eight C[81];
  octet.law.tangent(octet.points, octet.batch.count, octet.fibres, tangent, C);
  if (bulk != 0) add_bulk_tangent(octet, bulk, C);
  stencil_kernels(instruction_set_)
      .add_stiffness(octet.batch, C, scale, pairs.of_batch(octet.index), sums);
}

void SmoothedElasticity::add_stiffness(const Positions& x, const Eigen::VectorXd& p,
                                       Tangent tangent, double scale, BlockMatrix& K,
                                       double activation) const {
  assert(x.cols() == num_nodes_ && p.size() == num_pressures());
  assert(K.pattern_id() == pairs_.pattern_id());
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  set_own_pressures(x, activation);
  const auto pressure = [&](int i, Eight& memory) { return element_pressures(i, p, 1, memory); };
  int chunk = 0;
  for (const StencilBatches::Chunk& batches : stencils_.chunks()) {
    const PairSums sums = pairs_.zero_sums(chunk, kernels);
    const auto adding = [&](double bulk) {
      return [&, bulk](const Octet& octet) {
        add_stiffness(octet, bulk, tangent, scale, pairs_, sums);
      };
    };
    for_each_domain_octet(batches, x, activation, adding(0));
    for_each_element_octet(batches, x, smoothing_.plain_share, pressure, activation,
                           adding(own_bulk(batches.material, activation)));
    pairs_.add_sums(chunk++, kernels, K);
  }
  // What the means take is negative: a projected tangent goes without.
  if (tangent == Tangent::Consistent && has_own_bulk(activation))
    add_stiffness_of_means(x, scale, K, activation);
}

void SmoothedElasticity::add_stiffness_of_means(const Positions& x, double scale, BlockMatrix& K,
                                                double activation) const {
  slope_.resize(volume_.size());
  for_each_element(x, 0, [&](const PointLaw& law, int e, const Mat3& F) {
    slope_[e] = volume_[e] * law.dilatation_gradient(F) * shape_gradients(inverse_edges_[e]);
  });
  factor_.resize(materials_->size());
  for (std::size_t m = 0; m < factor_.size(); ++m)
    factor_[m] = scale * own_bulk(static_cast<int>(m), activation);
  means_->subtract_stiffness(domains_, slope_, factor_, K);
}

void SmoothedElasticity::add_plain_stiffness(const Positions& x, Tangent tangent, double scale,
                                             BlockMatrix& K, double activation) const {
  assert(x.cols() == num_nodes_);
  assert(K.pattern_id() == plain_pairs_.pattern_id());
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  int chunk = 0;
  for (const StencilBatches::Chunk& batches : stencils_.chunks()) {
    const PairSums sums = plain_pairs_.zero_sums(chunk, kernels);
    for_each_element_octet(batches, x, 1, no_pressure, activation, [&](const Octet& octet) {
      add_stiffness(octet, 0, tangent, scale, plain_pairs_, sums);
    });
    plain_pairs_.add_sums(chunk++, kernels, K);
  }
}

void SmoothedElasticity::add_compressible_stiffness(const Positions& x, double scale,
                                                    BlockMatrix& K) const {
  assert(x.cols() == num_nodes_);
  assert(K.pattern_id() == plain_pairs_.pattern_id());
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  int chunk = 0;
  for (const StencilBatches::Chunk& batches : stencils_.chunks()) {
    const AnyMaterial& material = (*materials_)[static_cast<std::size_t>(batches.material)];
    const double kappa = std::min(bulk_modulus(material), 13.0 / 6 * shear_modulus(material));
    const PairSums sums = plain_pairs_.zero_sums(chunk, kernels);
    for_each_element_octet(batches, x, 0, no_pressure, 0, [&](const Octet& octet) {
      Eight C[81] = {};
      add_bulk_tangent(octet, kappa, C);
      kernels.add_stiffness(octet.batch, C, scale, plain_pairs_.of_batch(octet.index), sums);
    });
    plain_pairs_.add_sums(chunk++, kernels, K);
  }
}

void SmoothedElasticity::set_pressure_gradient(const Positions& x, PressureGradient& G) const {
  assert(x.cols() == num_nodes_);
  assert(G.num_nodes() == num_nodes_ && G.num_pressures() == num_pressures());
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  G.set_zero();
  const EightIndices* slots = gradient_slots_.data();
  for (const StencilBatches::Chunk& chunk : stencils_.chunks()) {
    for_each_element_octet(chunk, x, 0, unit_pressure, 0, [&](const Octet& octet) {
      Eight gradient[9];
      octet.law.first_piola(octet.points, octet.batch.count, octet.fibres, gradient);
      kernels.add_pressure_gradient(octet.batch, gradient, slots, G.values());
      slots += 16;
    });
  }
}

Eigen::MatrixXd SmoothedElasticity::cauchy_stress(const Positions& x, double activation) const {
  const double share = smoothing_.plain_share;
  Eigen::MatrixXd of_domain(6, domains_.size()), stress(6, num_elements());
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    of_domain.col(k) = components(law.distortion_cauchy_stress(F));
  });
  pressure(x, p_work_);
  set_own_pressures(x, activation);
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    const double p = mean_pressure(e, p_work_) + own_pressure_[e];
    stress.col(e) = components(share * law.distortion_cauchy_stress(F) +
                               p * law.dilatation_gradient(F) * F.transpose() / F.determinant());
    const int* k = &domains_.of_element[6 * static_cast<std::size_t>(e)];
    for (int i = 0; i < 6; ++i) stress.col(e) += (1 - share) / 6 * of_domain.col(k[i]);
  });
  return stress;
}

Eigen::VectorXd SmoothedElasticity::volume_ratio(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, 0,
                   [&](const PointLaw&, int e, const Mat3& F) { result[e] = F.determinant(); });
  return result;
}

Eigen::VectorXd SmoothedElasticity::fibre_stretch(const Positions& x) const {
  assert(fibres_.cols() == num_elements());
  Eigen::VectorXd result(num_elements());
  for_each_element(
      x, 0, [&](const PointLaw& law, int e, const Mat3& F) { result[e] = law.fibre_stretch(F); });
  return result;
}

Eigen::VectorXd SmoothedElasticity::strain_energy_density(const Positions& x,
                                                          double activation) const {
  const double share = smoothing_.plain_share;
  Eigen::VectorXd of_domain(domains_.size()), result(num_elements());
  for_each_domain(x, activation, [&](const PointLaw& law, int k, const Mat3& F) {
    of_domain[k] = law.distortion_energy_density(F);
  });
  pressure(x, p_work_);
  set_own_pressures(x, activation);
  for_each_element(x, activation, [&](const PointLaw& law, int e, const Mat3& F) {
    const double p = mean_pressure(e, p_work_) + own_pressure_[e];
    result[e] = share * law.distortion_energy_density(F) + 0.5 * p * law.dilatation(F);
    const int* k = &domains_.of_element[6 * static_cast<std::size_t>(e)];
    for (int i = 0; i < 6; ++i) result[e] += (1 - share) / 6 * of_domain[k[i]];
  });
  return result;
}

}  // namespace articular::fem
