// The loops over batches of tetrahedra, compiled once for each instruction set by the
// element_kernels_*.cpp, which name it: ARTICULAR_INSTRUCTION_SET.

#include <cstddef>

#include "fem/corotated_lanes.inl.hpp"
#include "fem/neo_hookean_lanes.inl.hpp"

namespace articular::fem::ARTICULAR_INSTRUCTION_SET {
namespace {

/// kWidth elements of a batch.
struct Elements {
  Matrix edges;  // (x1 − x0, x2 − x0, x3 − x0)
  Matrix inverse_edges;
  Lanes volume;
  const int* node[4];  // of the first of them
};

inline Vector gather(const double* x, const int* node) {
  const auto component = [&](int i) {
    const auto at = [&](int lane) { return x[3 * static_cast<std::ptrdiff_t>(node[lane]) + i]; };
#if defined(__AVX512F__)
    return Lanes{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
#elif defined(__AVX2__)
    return Lanes{at(0), at(1), at(2), at(3)};
#else
    return Lanes{at(0), at(1)};
#endif
  };
  return {component(0), component(1), component(2)};
}

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

/// Blocks of the pairs of a chunk: eight entries, aligned, and the last one apart.
struct PairBlocks {
  alignas(64) double entries[10 * kChunkSize][8];
  double last[10 * kChunkSize];
};

/// Adds one block of each element to that of its pair.
inline void add_block(const Matrix& K_ab, const std::uint16_t* pair, int count,
                      PairBlocks& blocks) {
  constexpr int kGroups = 8 / kWidth;
  Lanes part[kGroups][kWidth];  // of each element: entries 0 to 7, kWidth at once
  for (int k = 0; k < 8; ++k) part[k / kWidth][k % kWidth] = K_ab[k / 3][k % 3];
  for (int group = 0; group < kGroups; ++group) transpose(part[group]);
  alignas(64) double last[kWidth];
  store(K_ab[2][2], last);
  for (int lane = 0; lane < kWidth; ++lane) {
    if (lane >= count) break;
    double* const entries = blocks.entries[pair[lane]];
    for (int group = 0; group < kGroups; ++group) {
      double* const place = entries + group * kWidth;
      store(load(place) + part[group][lane], place);
    }
    blocks.last[pair[lane]] += last[lane];
  }
}

inline void add_blocks(const Matrix (&inner)[6], const BatchPairs& pairs, int first, int count,
                       PairBlocks& sums) {
  // Translations are free: the blocks of node 0 are minus the sums over the other nodes.
  const Matrix &K11 = inner[0], &K21 = inner[1], &K31 = inner[2], &K22 = inner[3], &K32 = inner[4],
               &K33 = inner[5];
  const Matrix K10 = -(K11 + transposed(K21) + transposed(K31)),
               K20 = -(K21 + K22 + transposed(K32)), K30 = -(K31 + K32 + K33);
  const Matrix K00 = -(K10 + K20 + K30);
  const Matrix* const blocks[10] = {&K00, &K10, &K20, &K30, &K11, &K21, &K31, &K22, &K32, &K33};
  for (int k = 0; k < 10; ++k) add_block(*blocks[k], pairs.pair[k] + first, count, sums);
}

/// Entries 0 to 7 of a block += those of a pair, or of its transpose.
inline void add_entries(const double* entries, double* block) {
  for (int k = 0; k < 8; k += kWidth) store(load(block + k) + load(entries + k), block + k);
}
inline void add_transposed_entries(const double* entries, double* block) {
#if defined(__AVX512F__)
  const Lanes a = load(entries);
  store(load(block) + __builtin_shufflevector(a, a, 0, 3, 6, 1, 4, 7, 2, 5), block);
#else
  for (int k = 0; k < 8; ++k) block[k] += entries[3 * (k % 3) + k / 3];
#endif
}

/// The sums of a chunk go to the matrix, to both halves.
inline void add_to_matrix(const PairBlocks& sums, const ChunkJob& job) {
  constexpr int kAhead = 12;  // pairs, of two or three lines each
  const auto fetch = [&job](int slot) {
    const double* const block = job.K + std::ptrdiff_t{9} * slot;
    __builtin_prefetch(block, 1);
    __builtin_prefetch(block + 8, 1);
  };
  for (int p = 0; p < job.num_coupled; ++p) {
    if (p + kAhead < job.num_coupled) {
      fetch(job.slots[p + kAhead].lower);
      fetch(job.slots[p + kAhead].upper);
    }
    double* const lower = job.K + std::ptrdiff_t{9} * job.slots[p].lower;
    add_entries(sums.entries[p], lower);
    lower[8] += sums.last[p];
    if (p < job.num_diagonal) continue;
    double* const upper = job.K + std::ptrdiff_t{9} * job.slots[p].upper;
    add_transposed_entries(sums.entries[p], upper);
    upper[8] += sums.last[p];
  }
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
  PairBlocks sums;
  if constexpr (kStiffness != Stiffness::None) {
    for (int p = 0; p < job.num_pairs; ++p) {
      for (int k = 0; k < 8; k += kWidth) store(Lanes{}, sums.entries[p] + k);
      sums.last[p] = 0;
    }
  }
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
  if constexpr (kStiffness != Stiffness::None) add_to_matrix(sums, job);
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

const ElementKernels kernels{kernels_of<CorotatedLanes>, kernels_of<NeoHookeanLanes>};

}  // namespace articular::fem::ARTICULAR_INSTRUCTION_SET
