#include "fem/element/dashpots.hpp"

#include <Eigen/LU>
#include <cassert>
#include <utility>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/mesh/rest_shape.hpp"

namespace articular::fem {
namespace {

/// One point an element.
StencilBatches stencils_of(const Positions& X, const Tetrahedra& tets) {
  std::vector<double> volume;
  std::vector<Mat3> inverse_edges;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    volume.push_back(checked_volume(X, tets, e));
    inverse_edges.emplace_back(edge_matrix(gather(X, tets, e)).inverse());
  }
  EdgeDomains none;
  none.node_begin = {0};
  none.material_begin = {0, 0};
  return {X, tets, none, inverse_edges, volume, std::vector<int>(volume.size(), 0)};
}

}  // namespace

/// Eight dashpots that move on.
struct Dashpots::Octet {
  int index;  // among the batches of stencils_
  StencilBatch batch;
  EightMotions motions;
};

Dashpots::Dashpots(StencilBatches stencils, double element_share, const KelvinVoigt& law)
    : law_(law), element_share_(element_share), stencils_(std::move(stencils)) {}

Dashpots::Dashpots(const Positions& X, const Tetrahedra& tets, const KelvinVoigt& law,
                   const BlockMatrix& matrix)
    : Dashpots(stencils_of(X, tets), 1, law) {
  pairs_ = {stencils_, StencilPairs::Part::All, matrix};
}

Dashpots::Dashpots(const SmoothedElasticity& smoothed, const KelvinVoigt& law)
    : Dashpots(smoothed.stencils(), smoothed.smoothing().plain_share, law) {
  assert(smoothed.domains().material_begin.size() == 2);
  pairs_ = {stencils_, StencilPairs::Part::All, smoothed.make_matrix()};
  plain_pairs_ = {stencils_, StencilPairs::Part::Elements, smoothed.make_plain_matrix()};
}

template <class Function>
void Dashpots::for_each_octet(int begin, int end, double share, const Positions& x,
                              const Positions& v, Function function) const {
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  for (int i = begin; i < end; ++i) {
    const StencilBatch batch = stencils_.batch(i);
    Eight F[9], rate[9];
    kernels.deformation_gradient(batch, x.data(), F);
    kernels.deformation_gradient(batch, v.data(), rate);
    function(Octet{i, batch, {F, rate, share * law_.eta(), share * law_.lambda()}});
  }
}

template <class Function>
void Dashpots::for_each_octet(const StencilBatches::Chunk& chunk, const Positions& x,
                              const Positions& v, Function function) const {
  for_each_octet(chunk.begin, chunk.elements, 1 - element_share_, x, v, function);
  for_each_octet(chunk.elements, chunk.end, element_share_, x, v, function);
}

void Dashpots::add_force(const Positions& x, const Positions& v, Positions& f) const {
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  const ViscosityKernels& law = viscosity_kernels(instruction_set_);
  for (const StencilBatches::Chunk& chunk : stencils_.chunks())
    for_each_octet(chunk, x, v, [&](const Octet& octet) {
      Eight P[9];
      law.first_piola(octet.motions, P);
      kernels.add_force(octet.batch, P, f.data());
    });
}

template <class Visit>
void Dashpots::add_tangents(double damping, double stiffness, const StencilPairs& pairs,
                            BlockMatrix& K, Visit visit) const {
  assert(K.pattern_id() == pairs.pattern_id());
  const StencilKernels& kernels = stencil_kernels(instruction_set_);
  const ViscosityKernels& law = viscosity_kernels(instruction_set_);
  int number = 0;
  for (const StencilBatches::Chunk& chunk : stencils_.chunks()) {
    const PairSums sums = pairs.zero_sums(number, kernels);
    visit(chunk, [&](const Octet& octet) {
      Eight C[81];
      law.tangent(octet.motions, damping, stiffness, C);
      kernels.add_stiffness(octet.batch, C, 1, pairs.of_batch(octet.index), sums);
    });
    pairs.add_sums(number++, kernels, K);
  }
}

void Dashpots::add_tangent(const Positions& x, const Positions& v, double damping, double stiffness,
                           BlockMatrix& K) const {
  add_tangents(damping, stiffness, pairs_, K,
               [&](const StencilBatches::Chunk& chunk, const auto& add) {
                 for_each_octet(chunk, x, v, add);
               });
}

void Dashpots::add_plain_damping(const Positions& x, double damping, BlockMatrix& K) const {
  add_tangents(damping, 0, plain_pairs_, K,
               [&](const StencilBatches::Chunk& chunk, const auto& add) {
                 for_each_octet(chunk.elements, chunk.end, 1, x, x, add);
               });
}

double Dashpots::power(const Positions& x, const Positions& v) const {
  const ViscosityKernels& law = viscosity_kernels(instruction_set_);
  double sum = 0;
  const auto add = [&](const Octet& octet) {
    Eight P[9];
    law.first_piola(octet.motions, P);
    for (int lane = 0; lane < octet.batch.count; ++lane) {
      double density = 0;
      for (int k = 0; k < 9; ++k) density += P[k].lane[lane] * octet.motions.rate[k].lane[lane];
      sum += octet.batch.volume->lane[lane] * density;
    }
  };
  for (const StencilBatches::Chunk& chunk : stencils_.chunks()) for_each_octet(chunk, x, v, add);
  return sum;
}

}  // namespace articular::fem
