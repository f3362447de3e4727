#pragma once

#include <array>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/solver/aggregation.hpp"
#include "fem/sparse/block_rows.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// Rigid motions of one aggregate: three translations, three rotations.
inline constexpr int kModes = 6;

/// How the blocks of a level move in rigid motions of their surroundings, each about a centre of
/// its own: N x 6 a block, row-major, three translations, then three rotations. Motions of groups
/// about their centres follow by a shift, so that far from the origin no digits are lost.
struct RigidModes {
  std::vector<double> values;
  std::vector<Vec3> center;  // [m]
};

/// From a coarse level to a fine one: blocks of N x 6, row-major, in compressed rows, and the same
/// blocks by columns.
template <int N>
struct Prolongation {
  static constexpr int kBlock = N * kModes;
  std::vector<int> row_begin{0}, column;  // columns sorted within a row
  std::vector<float> values;              // padded
  std::vector<int> column_begin{0};       // of the blocks by columns:
  std::vector<int> row, slot;             // rows sorted within a column
  std::vector<float> values_by_columns;   // a copy: restriction by slots takes five times as long

  int num_rows() const { return static_cast<int>(row_begin.size()) - 1; }
  int num_columns() const { return static_cast<int>(column_begin.size()) - 1; }
  const float* block(int k) const { return values.data() + std::ptrdiff_t{kBlock} * k; }
  float* block(int k) { return values.data() + std::ptrdiff_t{kBlock} * k; }
};

/// Where the smoothed prolongator has blocks: a row for each node, with the aggregates of itself
/// and of its neighbours, but that of itself only where the row is marked as not smoothed.
/// @param unsmoothed  1 for such a row; empty: none
template <int N>
Prolongation<N> prolongation_pattern(const BlockRows<N>& A, const Aggregation& aggregation,
                                     const std::vector<char>& unsmoothed);

/// Values of P = (I − ω A) Q, where Q has orthonormal columns for each aggregate and Q B_coarse = B
/// [Vanek 1996]. Modes that an aggregate does not have (a single node can't turn) are zero columns.
/// @param modes  B
/// @param omega  4/3 over the largest eigenvalue of A
/// @return B_coarse, about the means of the aggregates' centres
template <int N>
RigidModes smoothed_prolongation(const BlockRows<N>& A, const Aggregation& aggregation,
                                 const std::vector<char>& unsmoothed, const RigidModes& modes,
                                 float omega, Prolongation<N>& P, ThreadPool& pool);

/// After a change of P.values.
template <int N>
void copy_values_by_columns(Prolongation<N>& P, ThreadPool& pool);

/// coarse = Pᵀ fine
template <int N>
void restrict_to_coarse(const Prolongation<N>& P, const std::vector<float>& fine,
                        std::vector<float>& coarse, ThreadPool& pool);

/// fine = P coarse
template <int N>
void prolong(const Prolongation<N>& P, const std::vector<float>& coarse, std::vector<float>& fine,
             ThreadPool& pool);

}  // namespace articular::fem
