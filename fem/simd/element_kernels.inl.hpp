// The loops over batches of tetrahedra, compiled once for each instruction set by the
// element_kernels_*.cpp, which name it: ARTICULAR_INSTRUCTION_SET.

#include <cstddef>

#include "fem/simd/corotated_lanes.inl.hpp"
#include "fem/simd/gather_lanes.inl.hpp"
#include "fem/simd/neo_hookean_lanes.inl.hpp"
#include "fem/simd/pair_blocks.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// kWidth elements of a batch.
struct Elements {
  Matrix edges;  // (x1 − x0, x2 − x0, x3 − x0)
  Matrix inverse_edges;
  Lanes volume;
  const int* node[4];  // of the first of them
};

inline Elements load_elements(const ElementBatch& batch, int first, const double* x) {
  Elements e;
  for (int a = 0; a < 4; ++a) e.node[a] = batch.node[a] + first;
  const Vector x0 = gather(x, e.node[0]);
  for (int k = 0; k < 3; ++k) {
    e.edges[k] = gather(x, e.node[k + 1]) - x0;
    for (int i = 0; i < 3; ++i)
      e.inverse_edges[k][i] = load(batch.inverse_edges[3 * k + i] + first);
  }
  e.volume = load(batch.volume + first);
  return e;
}

/// f += V P ∂N_a/∂X, element after element
inline void add_force(const Matrix& P, const Elements& e, const Vector (&g)[3], int count,
                      double* f) {
  const Vector f1 = P * (e.volume * g[0]), f2 = P * (e.volume * g[1]), f3 = P * (e.volume * g[2]);
  const Vector nodal[4] = {-(f1 + f2 + f3), f1, f2, f3};
  for (int a = 0; a < 4; ++a) {
    alignas(64) double value[3][kWidth];
    for (int i = 0; i < 3; ++i) store(nodal[a][i], value[i]);
    for (int lane = 0; lane < count; ++lane) {
      double* const f_a = f + 3 * static_cast<std::ptrdiff_t>(e.node[a][lane]);
      for (int i = 0; i < 3; ++i) f_a[i] += value[i][lane];
    }
  }
}

/// Blocks of the pairs of a chunk.
struct PairBlocks {
  Eight entries[10 * kChunkSize];
  double last[10 * kChunkSize];
};

inline void add_blocks(const Matrix (&inner)[6], const BatchPairs& pairs, int first, int count,
                       const PairSums& sums) {
  // Translations are free: the blocks of node 0 are minus the sums over the other nodes.
  const Matrix &K11 = inner[0], &K21 = inner[1], &K31 = inner[2], &K22 = inner[3], &K32 = inner[4],
               &K33 = inner[5];
  const Matrix K10 = -(K11 + transposed(K21) + transposed(K31)),
               K20 = -(K21 + K22 + transposed(K32)), K30 = -(K31 + K32 + K33);
  const Matrix K00 = -(K10 + K20 + K30);
  const Matrix* const blocks[10] = {&K00, &K10, &K20, &K30, &K11, &K21, &K31, &K22, &K32, &K33};
  for (int k = 0; k < 10; ++k) add_block(*blocks[k], pairs.pair[k] + first, count, sums);
}

/// Batches are read once: the processor's own guess is late at each page. Beyond the end nothing
/// happens.
inline void fetch(const ElementBatch* batch) {
  const char* const bytes = reinterpret_cast<const char*>(batch);
  for (unsigned k = 0; k < sizeof(ElementBatch); k += 64) __builtin_prefetch(bytes + k);
}

enum class Stiffness { None, Consistent, Projected };

template <class Law, bool kForce, Stiffness kStiffness>
void assemble(const ChunkJob& job) {
  const Law law{job.mu, job.lambda};
  PairBlocks blocks;
  const PairSums sums{blocks.entries, blocks.last};
  if constexpr (kStiffness != Stiffness::None) set_zero(job.num_pairs, sums);
  for (int begin = 0; begin < job.num_elements; begin += kWidth) {
    const int batch = begin / kBatchSize, first = begin % kBatchSize;
    const int left = job.num_elements - begin, count = left < kWidth ? left : kWidth;
    if (first == 0) fetch(job.batches + batch + 2);
    const Elements e = load_elements(job.batches[batch], first, job.x);
    const Matrix F = e.edges * e.inverse_edges;
    const typename Law::State state = law.at(F);
    const Matrix gradients = transposed(e.inverse_edges);  // ∂N_a/∂X of nodes 1 to 3
    const Vector g[3] = {gradients[0], gradients[1], gradients[2]};
    if constexpr (kForce) add_force(law.first_piola(state), e, g, count, job.f);
    if constexpr (kStiffness != Stiffness::None) {
      Matrix K[6];
      if constexpr (kStiffness == Stiffness::Consistent) {
        law.stiffness(state, g, job.scale * e.volume, K);
      } else {
        law.projected_stiffness(state, g, job.scale * e.volume, K);
      }
      add_blocks(K, job.pairs[batch], first, count, sums);
    }
  }
  if constexpr (kStiffness != Stiffness::None) {
    add_to_matrix(sums, job.slots, job.num_diagonal, job.num_coupled, job.K);
  }
}

template <class Law>
double energy(const ChunkJob& job) {
  const Law law{job.mu, job.lambda};
  double W = 0;
  for (int begin = 0; begin < job.num_elements; begin += kWidth) {
    const Elements e = load_elements(job.batches[begin / kBatchSize], begin % kBatchSize, job.x);
    W += sum(e.volume * law.energy_density(law.at(e.edges * e.inverse_edges)));
  }
  return W;
}

template <class Law>
constexpr LawKernels kernels_of{energy<Law>,
                                assemble<Law, true, Stiffness::None>,
                                assemble<Law, false, Stiffness::Consistent>,
                                assemble<Law, false, Stiffness::Projected>,
                                assemble<Law, true, Stiffness::Consistent>,
                                assemble<Law, true, Stiffness::Projected>};

}  // namespace

const ElementKernels kernels{kernels_of<CorotatedLanes>, kernels_of<NeoHookeanLanes<StableVolume>>,
                             kernels_of<NeoHookeanLanes<LogarithmicVolume>>};

}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
