#include "fem/solver/prolongation.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "fem/solver/chebyshev.hpp"

namespace articular::fem {
namespace {

// A mode of an aggregate counts as one that it does not have where less than this part of it is
// left beside the modes before: 1e-4 of rounding in single precision would be noise of 1e-3.
constexpr double kDependent = 1e-3;  // [-]

template <int N>
using Modes = Eigen::Matrix<double, N, kModes, Eigen::RowMajor>;
template <int N>
using ModesFloat = Eigen::Matrix<float, N, kModes, Eigen::RowMajor>;
using CoarseModes = Modes<kModes>;

/// The blocks by columns, from those by rows.
template <int N>
void fill_columns(int num_columns, Prolongation<N>& P) {
  P.column_begin.assign(static_cast<std::size_t>(num_columns) + 1, 0);
  for (const int c : P.column) ++P.column_begin[c + 1];
  for (int c = 0; c < num_columns; ++c) P.column_begin[c + 1] += P.column_begin[c];
  P.row.resize(P.column.size());
  P.slot.resize(P.column.size());
  std::vector<int> next(P.column_begin.begin(), P.column_begin.end() - 1);
  for (int i = 0; i < P.num_rows(); ++i) {
    for (int k = P.row_begin[i]; k < P.row_begin[i + 1]; ++k) {
      const int at = next[P.column[k]]++;
      P.row[at] = i;
      P.slot[at] = k;
    }
  }
}

/// Modes of block i, its rotations about another center: ω × (x − c) = ω × (c_i − c) + ω × (x −
/// c_i).
template <int N>
Modes<N> moved(const RigidModes& modes, int i, const Vec3& center) {
  Modes<N> B = Eigen::Map<const Modes<N>>(modes.values.data() + std::ptrdiff_t{N} * kModes * i);
  const Vec3 arm = modes.center[i] - center;
  for (int k = 0; k < 3; ++k) {
    B.col(3 + k) += B.template leftCols<3>() * Vec3::Unit(k).cross(arm);
  }
  return B;
}

/// Modified Gram-Schmidt over the rows of one aggregate, twice. B becomes Q.
/// @return R with Q R = B
template <int N>
CoarseModes orthonormalize(std::vector<Modes<N>>& B) {
  CoarseModes R = CoarseModes::Zero();
  for (int m = 0; m < kModes; ++m) {
    double before = 0, left = 0;
    for (const Modes<N>& block : B) before += block.col(m).squaredNorm();
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = 0; k < m; ++k) {
        double dot = 0;
        for (const Modes<N>& block : B) dot += block.col(k).dot(block.col(m));
        for (Modes<N>& block : B) block.col(m) -= dot * block.col(k);
        R(k, m) += dot;
      }
    }
    for (const Modes<N>& block : B) left += block.col(m).squaredNorm();
    const bool has_mode = left > kDependent * kDependent * before;
    R(m, m) = has_mode ? std::sqrt(left) : 0;
    for (Modes<N>& block : B) {
      if (has_mode) {
        block.col(m) /= R(m, m);
      } else {
        block.col(m).setZero();
      }
    }
  }
  return R;
}

float sum_of(Float4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }

}  // namespace

template <int N>
Prolongation<N> prolongation_pattern(const BlockRows<N>& A, const Aggregation& aggregation,
                                     const std::vector<char>& unsmoothed) {
  const std::vector<int>& aggregate = aggregation.aggregate;
  const auto fixed = [&](int i) { return !unsmoothed.empty() && unsmoothed[i] != 0; };
  Prolongation<N> P;
  P.row_begin.reserve(A.row_begin.size());
  for (int i = 0; i < A.num_rows(); ++i) {
    const auto row_start = static_cast<std::ptrdiff_t>(P.column.size());
    const auto add = [&](int a) {
      if (a < 0 || std::find(P.column.begin() + row_start, P.column.end(), a) != P.column.end()) {
        return;
      }
      P.column.push_back(a);
    };
    add(aggregate[i]);
    for (int k = A.row_begin[i]; !fixed(i) && k < A.row_begin[i + 1]; ++k) {
      add(aggregate[A.column[k]]);
    }
    std::sort(P.column.begin() + row_start, P.column.end());
    P.row_begin.push_back(static_cast<int>(P.column.size()));
  }
  P.values = padded(static_cast<std::size_t>(P.kBlock) * P.column.size());
  fill_columns(aggregation.num_aggregates, P);
  return P;
}

template <int N>
RigidModes smoothed_prolongation(const BlockRows<N>& A, const Aggregation& aggregation,
                                 const std::vector<char>& unsmoothed, const RigidModes& modes,
                                 float omega, Prolongation<N>& P, ThreadPool& pool) {
  const std::vector<int>& aggregate = aggregation.aggregate;
  const int n = A.num_rows(), num_aggregates = aggregation.num_aggregates;
  std::vector<int> begin(static_cast<std::size_t>(num_aggregates) + 1, 0), member(n);
  for (const int a : aggregate) {
    if (a >= 0) ++begin[a + 1];
  }
  for (int a = 0; a < num_aggregates; ++a) begin[a + 1] += begin[a];
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (int i = 0; i < n; ++i) {
    if (aggregate[i] >= 0) member[next[aggregate[i]]++] = i;
  }

  std::vector<float> Q = padded(static_cast<std::size_t>(P.kBlock) * static_cast<std::size_t>(n));
  RigidModes coarse_modes;
  coarse_modes.values.resize(std::size_t{kModes} * kModes *
                             static_cast<std::size_t>(num_aggregates));
  coarse_modes.center.assign(num_aggregates, Vec3::Zero());
  pool.run_pieces(num_aggregates, 64, [&](int first, int last, int) {
    std::vector<Modes<N>> B;
    for (int a = first; a < last; ++a) {
      B.clear();
      Vec3& center = coarse_modes.center[a];
      for (int k = begin[a]; k < begin[a + 1]; ++k) center += modes.center[member[k]];
      center /= std::max(1, begin[a + 1] - begin[a]);
      for (int k = begin[a]; k < begin[a + 1]; ++k) {
        B.push_back(moved<N>(modes, member[k], center));
      }
      Eigen::Map<CoarseModes>(coarse_modes.values.data() + std::ptrdiff_t{kModes} * kModes * a) =
          orthonormalize(B);
      for (int k = begin[a]; k < begin[a + 1]; ++k) {
        Eigen::Map<ModesFloat<N>>(Q.data() + std::ptrdiff_t{P.kBlock} * member[k]) =
            B[k - begin[a]].template cast<float>();
      }
    }
  });

  const auto fixed = [&](int i) { return !unsmoothed.empty() && unsmoothed[i] != 0; };
  pool.run_pieces(n, kRowsPerPiece<N>, [&](int first, int last, int) {
    for (int i = first; i < last; ++i) {
      const int* columns = P.column.data() + P.row_begin[i];
      const int* columns_end = P.column.data() + P.row_begin[i + 1];
      const auto block_of = [&](int a) {
        const int* found = std::find(columns, columns_end, a);
        return Eigen::Map<ModesFloat<N>>(
            P.block(P.row_begin[i] + static_cast<int>(found - columns)));
      };
      const auto q = [&](int j) {
        return Eigen::Map<const ModesFloat<N>>(Q.data() + std::ptrdiff_t{P.kBlock} * j);
      };
      for (int k = P.row_begin[i]; k < P.row_begin[i + 1]; ++k) {
        std::fill_n(P.block(k), P.kBlock, 0.0F);
      }
      // A node in no aggregate follows its neighbours, a bone say, to where its forces balance.
      const float weight = aggregate[i] >= 0 ? omega : 1;
      if (aggregate[i] >= 0) block_of(aggregate[i]) = (fixed(i) ? 1 : 1 - omega) * q(i);
      for (int k = A.row_begin[i]; !fixed(i) && k < A.row_begin[i + 1]; ++k) {
        const int j = A.column[k];
        if (aggregate[j] < 0) continue;
        const Eigen::Map<const Eigen::Matrix<float, N, N>> A_ij(A.block(k));
        block_of(aggregate[j]).noalias() -= (weight * A_ij).lazyProduct(q(j));
      }
    }
  });
  return coarse_modes;
}

template <int N>
void copy_values_by_columns(Prolongation<N>& P, ThreadPool& pool) {
  P.values_by_columns.resize(P.values.size());
  pool.run_pieces(static_cast<int>(P.slot.size()), 4096, [&](int first, int last, int) {
    float* to = P.values_by_columns.data() + std::ptrdiff_t{P.kBlock} * first;
    for (int k = first; k < last; ++k) to = std::copy_n(P.block(P.slot[k]), P.kBlock, to);
  });
}

template <int N>
void restrict_to_coarse(const Prolongation<N>& P, const std::vector<float>& fine,
                        std::vector<float>& coarse, ThreadPool& pool) {
  pool.run_pieces(P.num_columns(), 64, [&](int first, int last, int) {
    for (int a = first; a < last; ++a) {
      Float4 s0{}, s1{}, s2{};  // as in row_product(): pairs of rows of six
      for (int k = P.column_begin[a]; k < P.column_begin[a + 1]; ++k) {
        const float* p = P.values_by_columns.data() + std::ptrdiff_t{P.kBlock} * k;
        const float* r = fine.data() + std::ptrdiff_t{N} * P.row[k];
        for (int c = 0; c + 1 < N; c += 2, p += 12) {
          s0 += load4(p) * r[c];
          s1 += load4(p + 4) * pair_of(r[c], r[c + 1]);
          s2 += load4(p + 8) * r[c + 1];
        }
        if constexpr (N % 2 == 1) {
          s0 += load4(p) * r[N - 1];
          s1 += load4(p + 4) * pair_of(r[N - 1], 0);
        }
      }
      // The last row of a coarse vector has padding behind it: two numbers more may be written, but
      // not over the next aggregate's, which another thread may hold.
      std::array<float, 8> sum;
      store4(sum.data(), s0 + middle(s1, s2));
      store4(sum.data() + 4, s1 + middle(s2, s2));
      std::copy_n(sum.data(), kModes, coarse.data() + std::ptrdiff_t{kModes} * a);
    }
  });
}

template <int N>
void prolong(const Prolongation<N>& P, const std::vector<float>& coarse, std::vector<float>& fine,
             ThreadPool& pool) {
  pool.run_pieces(P.num_rows(), kRowsPerPiece<N>, [&](int first, int last, int) {
    for (int i = first; i < last; ++i) {
      constexpr int kPairs = (N + 1) / 2;
      std::array<Float4, 3 * kPairs> s{};
      for (int k = P.row_begin[i]; k < P.row_begin[i + 1]; ++k) {
        const float* e = coarse.data() + std::ptrdiff_t{kModes} * P.column[k];
        const Float4 front = load4(e), back = load4(e + 2), turned = middle(back, front);
        const float* p = P.block(k);
        for (int c = 0; c + 1 < N; c += 2, p += 12) {
          s[3 * (c / 2)] += load4(p) * front;
          s[3 * (c / 2) + 1] += load4(p + 4) * turned;
          s[3 * (c / 2) + 2] += load4(p + 8) * back;
        }
        if constexpr (N % 2 == 1) {
          s[3 * (kPairs - 1)] += load4(p) * front;
          s[3 * (kPairs - 1) + 1] += load4(p + 4) * turned;
        }
      }
      float* x = fine.data() + std::ptrdiff_t{N} * i;
      for (int c = 0; c < N; ++c) {
        const Float4* t = s.data() + 3 * (c / 2);
        x[c] = c % 2 == 0 ? sum_of(t[0]) + (t[1][0] + t[1][1]) : sum_of(t[2]) + (t[1][2] + t[1][3]);
      }
    }
  });
}

template Prolongation<3> prolongation_pattern(const BlockRows<3>&, const Aggregation&,
                                              const std::vector<char>&);
template Prolongation<6> prolongation_pattern(const BlockRows<6>&, const Aggregation&,
                                              const std::vector<char>&);
template RigidModes smoothed_prolongation(const BlockRows<3>&, const Aggregation&,
                                          const std::vector<char>&, const RigidModes&, float,
                                          Prolongation<3>&, ThreadPool&);
template RigidModes smoothed_prolongation(const BlockRows<6>&, const Aggregation&,
                                          const std::vector<char>&, const RigidModes&, float,
                                          Prolongation<6>&, ThreadPool&);
template void copy_values_by_columns(Prolongation<3>&, ThreadPool&);
template void copy_values_by_columns(Prolongation<6>&, ThreadPool&);
template void restrict_to_coarse(const Prolongation<3>&, const std::vector<float>&,
                                 std::vector<float>&, ThreadPool&);
template void restrict_to_coarse(const Prolongation<6>&, const std::vector<float>&,
                                 std::vector<float>&, ThreadPool&);
template void prolong(const Prolongation<3>&, const std::vector<float>&, std::vector<float>&,
                      ThreadPool&);
template void prolong(const Prolongation<6>&, const std::vector<float>&, std::vector<float>&,
                      ThreadPool&);

}  // namespace articular::fem
