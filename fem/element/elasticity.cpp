#include "fem/element/elasticity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/element/parallel_parts.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

std::vector<double> checked_volumes(const Positions& X, const Tetrahedra& tets) {
  std::vector<double> volumes;
  volumes.reserve(static_cast<std::size_t>(tets.cols()));
  for (Eigen::Index e = 0; e < tets.cols(); ++e) volumes.push_back(checked_volume(X, tets, e));
  return volumes;
}

/// Each node has its own block row.
std::vector<int> every_node(int num_nodes) {
  std::vector<int> blocks(static_cast<std::size_t>(num_nodes));
  std::iota(blocks.begin(), blocks.end(), 0);
  return blocks;
}

std::optional<BatchLaw> batch_law(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const M& m) -> std::optional<BatchLaw> {
        if constexpr (Batched<M>) return m.batch_law();
        return std::nullopt;
      },
      material);
}

}  // namespace

Elasticity::Elasticity(const Positions& X, const Tetrahedra& tets, AnyMaterial material,
                       FibreDirections fibres, AssemblyOptions options)
    : num_nodes_(static_cast<int>(X.cols())),
      tets_(tets),
      material_(std::make_shared<const AnyMaterial>(std::move(material))),
      fibres_(std::move(fibres)),
      options_(std::move(options)),
      volume_(checked_volumes(X, tets)),
      elements_(X, tets_, volume_),
      slots_(elements_, make_matrix(), every_node(num_nodes_)) {
  check_fibres(*material_, fibres_, tets_);
}

/// Calls function(law, place, F) for the elements of a chunk in their order.
template <class Function>
void Elasticity::for_each_element(int chunk, const Positions& x, double activation,
                                  Function function) const {
  const Chunk& places = elements_.chunk(chunk);
  for (int place = places.begin; place < places.end; ++place) {
    const Mat34 x_e = gather(x, elements_.nodes(place));
    function(PointLaw(*material_, fibres_, elements_.element(place), activation), place,
             deformation_gradient(x_e, elements_.inverse_edges(place)));
  }
}

/// The same for all elements. What the function writes belongs to the element, or to its nodes.
template <class Function>
void Elasticity::for_each_element(const Positions& x, double activation, Function function) const {
  assert(x.cols() == num_nodes_);
  assert(activation >= 0 && activation <= 1);
  for_each_chunk(elements_, *options_.pool,
                 [&](int, int chunk) { for_each_element(chunk, x, activation, function); });
}

ChunkJob Elasticity::job(const BatchLaw& law, const Positions& x, int chunk) const {
  const Chunk& places = elements_.chunk(chunk);
  ChunkJob job{};
  job.batches = &elements_.batches()[static_cast<std::size_t>(places.begin / kBatchSize)];
  job.num_elements = places.end - places.begin;
  job.mu = law.mu;
  job.lambda = law.lambda;
  job.x = x.data();
  return job;
}

double Elasticity::energy(const Positions& x, double activation) const {
  assert(x.cols() == num_nodes_);
  const std::optional<BatchLaw> batched = batch_law(*material_);
  std::array<double, ElementBatches::kInnerParts + 1> W{};  // of each part
  for_each_chunk(elements_, *options_.pool, [&](int part, int chunk) {
    double& W_part = W[static_cast<std::size_t>(part)];
    if (batched) {
      const LawKernels& kernels = element_kernels(options_.instruction_set, batched->kind);
      W_part += kernels.energy(job(*batched, x, chunk));
    } else {
      for_each_element(chunk, x, activation, [&](const PointLaw& law, int place, const Mat3& F) {
        W_part += elements_.volume(place) * law.energy_density(F);
      });
    }
  });
  return std::accumulate(W.begin(), W.end(), 0.0);
}

void Elasticity::add_internal_force(const Positions& x, Positions& f, double activation) const {
  assert(x.cols() == num_nodes_);
  assert(f.cols() == num_nodes_);
  for_each_chunk(elements_, *options_.pool,
                 [&](int, int chunk) { add_force(chunk, x, activation, f); });
}

void Elasticity::add_force(int chunk, const Positions& x, double activation, Positions& f) const {
  if (const std::optional<BatchLaw> law = batch_law(*material_)) {
    ChunkJob work = job(*law, x, chunk);
    work.f = f.data();
    return element_kernels(options_.instruction_set, law->kind).force(work);
  }
  for_each_element(chunk, x, activation, [&](const PointLaw& law, int place, const Mat3& F) {
    const Mat34 dN_dX = shape_gradients(elements_.inverse_edges(place));
    const Mat34 f_e = nodal_force(law.first_piola(F), dN_dX, elements_.volume(place));
    const Eigen::Vector4i nodes = elements_.nodes(place);
    for (int a = 0; a < 4; ++a) f.col(nodes[a]) += f_e.col(a);
  });
}

BlockMatrix Elasticity::make_matrix() const {
  std::vector<int> offsets(volume_.size() + 1);
  for (std::size_t e = 0; e < offsets.size(); ++e) offsets[e] = static_cast<int>(4 * e);
  return {num_nodes_, {tets_.data(), 4 * volume_.size()}, offsets};
}

StiffnessSlots Elasticity::slots_in(const BlockMatrix& A,
                                    std::span<const int> block_of_node) const {
  assert(static_cast<int>(block_of_node.size()) == num_nodes_);
  return {elements_, A, block_of_node};
}

void Elasticity::add_stiffness(const Positions& x, Tangent tangent, double scale, BlockMatrix& K,
                               double activation) const {
  add(x, tangent, scale, slots_, activation, nullptr, K);
}

void Elasticity::add_stiffness(const Positions& x, Tangent tangent, double scale,
                               const StiffnessSlots& slots, BlockMatrix& A,
                               double activation) const {
  add(x, tangent, scale, slots, activation, nullptr, A);
}

void Elasticity::add_force_and_stiffness(const Positions& x, Tangent tangent, double scale,
                                         const StiffnessSlots& slots, Positions& f, BlockMatrix& A,
                                         double activation) const {
  assert(f.cols() == num_nodes_);
  add(x, tangent, scale, slots, activation, &f, A);
}

/// The stiffness, and the force where f is not null.
void Elasticity::add(const Positions& x, Tangent tangent, double scale, const StiffnessSlots& slots,
                     double activation, Positions* f, BlockMatrix& A) const {
  assert(x.cols() == num_nodes_);
  assert(A.pattern_id() == slots.pattern_id());
  const bool projected = tangent == Tangent::Projected;
  if (const std::optional<BatchLaw> law = batch_law(*material_)) {
    const LawKernels& kernels = element_kernels(options_.instruction_set, law->kind);
    const auto stiffness = projected ? kernels.projected_stiffness : kernels.stiffness;
    const auto both =
        projected ? kernels.force_and_projected_stiffness : kernels.force_and_stiffness;
    for_each_chunk(elements_, *options_.pool, [&](int, int chunk) {
      ChunkJob work = job(*law, x, chunk);
      slots.describe(chunk, work);
      work.f = f == nullptr ? nullptr : f->data();
      work.scale = scale;
      work.K = A.values();
      (f == nullptr ? stiffness : both)(work);
    });
    return;
  }
  for_each_chunk(elements_, *options_.pool, [&](int, int chunk) {
    if (f != nullptr) add_force(chunk, x, activation, *f);
    for_each_element(chunk, x, activation, [&](const PointLaw& law, int place, const Mat3& F) {
      const Mat9 C = law.tangent(F, tangent);
      const Mat12 K_e = stiffness(C, shape_gradients(elements_.inverse_edges(place)),
                                  scale * elements_.volume(place));
      slots.add(chunk, place, K_e, A);
    });
  });
}

Eigen::MatrixXd Elasticity::cauchy_stress(const Positions& x, double activation) const {
  Eigen::MatrixXd stress(6, num_elements());
  for_each_element(x, activation, [&](const PointLaw& law, int place, const Mat3& F) {
    const Mat3 s = law.cauchy_stress(F);
    stress.col(elements_.element(place)) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  });
  return stress;
}

Eigen::VectorXd Elasticity::volume_ratio(const Positions& x) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, 0, [&](const PointLaw&, int place, const Mat3& F) {
    result[elements_.element(place)] = F.determinant();
  });
  return result;
}

Eigen::VectorXd Elasticity::strain_energy_density(const Positions& x, double activation) const {
  Eigen::VectorXd result(num_elements());
  for_each_element(x, activation, [&](const PointLaw& law, int place, const Mat3& F) {
    result[elements_.element(place)] = law.energy_density(F);
  });
  return result;
}

Eigen::VectorXd Elasticity::fibre_stretch(const Positions& x) const {
  assert(fibres_.cols() == num_elements());
  Eigen::VectorXd result(num_elements());
  for_each_element(x, 0, [&](const PointLaw& law, int place, const Mat3& F) {
    result[elements_.element(place)] = law.fibre_stretch(F);
  });
  return result;
}

Eigen::VectorXd lumped_mass(const Positions& X, const Tetrahedra& tets, double density) {
  if (!(density > 0) || !std::isfinite(density)) {
    std::ostringstream message;
    message << "density is " << density << " kg/m^3, must be positive and finite";
    throw std::invalid_argument(message.str());
  }
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(X.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const double quarter = density * checked_volume(X, tets, e) / 4;
    for (int a = 0; a < 4; ++a) mass[tets(a, e)] += quarter;
  }
  return mass;
}

}  // namespace articular::fem
