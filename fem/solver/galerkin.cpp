#include "fem/solver/galerkin.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>

#include "fem/solver/chebyshev.hpp"

namespace articular::fem {
namespace {

using Mat6 = Eigen::Matrix<double, kModes, kModes>;
using Block6 = Eigen::Matrix<float, kModes, kModes>;
constexpr int kCoarseBlock = kModes * kModes;
// A row of six in A P as two times four numbers, (0 1 2 3) and (2 3 4 5).
constexpr int kPaddedRow = 8;

void check_size(std::size_t num_blocks) {
  if (num_blocks > std::numeric_limits<int>::max()) {
    throw std::length_error("a coarse matrix holds at most 2^31 - 1 blocks");
  }
}

/// product += A_ij P_j, rows of the product padded.
template <int N>
void add_product(const float* A_ij, const float* P_j, float* product) {
  for (int c = 0; c < N; ++c) {
    const Float4 front = load4(P_j + kModes * c), back = load4(P_j + kModes * c + 2);
    for (int r = 0; r < N; ++r) {
      float* row = product + kPaddedRow * r;
      const float a = A_ij[c * N + r];
      store4(row, load4(row) + a * front);
      store4(row + 4, load4(row + 4) + a * back);
    }
  }
}

/// sum += P_iᵀ product, column-major 6 x 6.
template <int N>
void add_transposed_product(const float* P_i, const float* product, float* sum) {
  std::array<Float4, 9> s;
  for (int v = 0; v < 9; ++v) s[v] = load4(sum + 4 * v);
  for (int r = 0; r < N; ++r) {
    const Float4 front = load4(P_i + kModes * r), back = load4(P_i + kModes * r + 2),
                 turned = middle(back, front);
    const float* row = product + kPaddedRow * r;
    const std::array<float, kModes> a{row[0], row[1], row[2], row[3], row[6], row[7]};
    for (int c = 0; c < kModes; c += 2) {
      s[3 * (c / 2)] += front * a[c];
      s[3 * (c / 2) + 1] += turned * pair_of(a[c], a[c + 1]);
      s[3 * (c / 2) + 2] += back * a[c + 1];
    }
  }
  for (int v = 0; v < 9; ++v) store4(sum + 4 * v, s[v]);
}

/// The blocks of A P, diagonal of A included.
template <int N>
std::vector<float> multiply(const BlockRows<N>& A, const GalerkinPattern& pattern,
                            const Prolongation<N>& P, ThreadPool& pool) {
  constexpr int kBlock = N * kPaddedRow;
  std::vector<float> product(pattern.product_column.size() * kBlock, 0.0F);
  std::vector<std::vector<int>> slots_of_workers(pool.num_threads(),
                                                 std::vector<int>(P.num_columns()));
  pool.run_pieces(A.num_rows(), kRowsPerPiece<N>, [&](int first, int last, int worker) {
    std::vector<int>& slot = slots_of_workers[worker];  // of a coarse column in row i
    for (int i = first; i < last; ++i) {
      for (int k = pattern.product_begin[i]; k < pattern.product_begin[i + 1]; ++k) {
        slot[pattern.product_column[k]] = k;
      }
      for (int p = P.row_begin[i]; p < P.row_begin[i + 1]; ++p) {
        float* row = product.data() + std::ptrdiff_t{kBlock} * slot[P.column[p]];
        for (int r = 0; r < N; ++r) {
          store4(row + kPaddedRow * r, load4(P.block(p) + kModes * r));
          store4(row + kPaddedRow * r + 4, load4(P.block(p) + kModes * r + 2));
        }
      }
      for (int k = A.row_begin[i]; k < A.row_begin[i + 1]; ++k) {
        const int j = A.column[k];
        for (int p = P.row_begin[j]; p < P.row_begin[j + 1]; ++p) {
          add_product<N>(A.block(k), P.block(p),
                         product.data() + std::ptrdiff_t{kBlock} * slot[P.column[p]]);
        }
      }
    }
  });
  return product;
}

/// Pᵀ (A P), diagonal and above.
template <int N>
std::vector<float> multiply_transposed(const GalerkinPattern& pattern, const Prolongation<N>& P,
                                       const std::vector<float>& product, ThreadPool& pool) {
  constexpr int kBlock = N * kPaddedRow;
  std::vector<float> upper(pattern.upper_column.size() * kCoarseBlock, 0.0F);
  std::vector<std::vector<int>> slots_of_workers(pool.num_threads(),
                                                 std::vector<int>(P.num_columns()));
  pool.run_pieces(P.num_columns(), 32, [&](int first, int last, int worker) {
    std::vector<int>& slot = slots_of_workers[worker];  // of a coarse column in row a
    for (int a = first; a < last; ++a) {
      for (int k = pattern.upper_begin[a]; k < pattern.upper_begin[a + 1]; ++k) {
        slot[pattern.upper_column[k]] = k;
      }
      for (int p = P.column_begin[a]; p < P.column_begin[a + 1]; ++p) {
        const int i = P.row[p];
        const float* P_i = P.block(P.slot[p]);
        for (int k = pattern.product_begin[i + 1] - 1; k >= pattern.product_begin[i]; --k) {
          const int b = pattern.product_column[k];
          if (b < a) break;
          add_transposed_product<N>(P_i, product.data() + std::ptrdiff_t{kBlock} * k,
                                    upper.data() + std::ptrdiff_t{kCoarseBlock} * slot[b]);
        }
      }
    }
  });
  return upper;
}

}  // namespace

template <int N>
GalerkinPattern galerkin_pattern(const BlockRows<N>& A, const Prolongation<N>& P,
                                 BlockRows<kModes>& coarse) {
  GalerkinPattern pattern;
  const int num_coarse = P.num_columns();
  std::vector<int> last_row(num_coarse, -1);
  pattern.product_begin.reserve(A.row_begin.size());
  for (int i = 0; i < A.num_rows(); ++i) {
    const auto row_start = static_cast<std::ptrdiff_t>(pattern.product_column.size());
    const auto add_row = [&](int j) {
      for (int p = P.row_begin[j]; p < P.row_begin[j + 1]; ++p) {
        if (last_row[P.column[p]] == i) continue;
        last_row[P.column[p]] = i;
        pattern.product_column.push_back(P.column[p]);
      }
    };
    add_row(i);
    for (int k = A.row_begin[i]; k < A.row_begin[i + 1]; ++k) add_row(A.column[k]);
    std::sort(pattern.product_column.begin() + row_start, pattern.product_column.end());
    check_size(pattern.product_column.size());
    pattern.product_begin.push_back(static_cast<int>(pattern.product_column.size()));
  }

  std::fill(last_row.begin(), last_row.end(), -1);
  std::vector<int> count(static_cast<std::size_t>(num_coarse) + 1, 0);
  for (int a = 0; a < num_coarse; ++a) {
    const auto row_start = static_cast<std::ptrdiff_t>(pattern.upper_column.size());
    last_row[a] = a;
    pattern.upper_column.push_back(a);
    for (int p = P.column_begin[a]; p < P.column_begin[a + 1]; ++p) {
      const int i = P.row[p];
      for (int k = pattern.product_begin[i]; k < pattern.product_begin[i + 1]; ++k) {
        const int b = pattern.product_column[k];
        if (b <= a || last_row[b] == a) continue;
        last_row[b] = a;
        pattern.upper_column.push_back(b);
        ++count[a + 1];
        ++count[b + 1];
      }
    }
    std::sort(pattern.upper_column.begin() + row_start, pattern.upper_column.end());
    check_size(2 * pattern.upper_column.size());
    pattern.upper_begin.push_back(static_cast<int>(pattern.upper_column.size()));
  }

  for (int a = 0; a < num_coarse; ++a) count[a + 1] += count[a];
  coarse.row_begin = count;
  coarse.column.resize(count[num_coarse]);
  pattern.mirror.resize(coarse.column.size());
  // Row by row, each entry above the diagonal also gives the one below it: columns come sorted.
  for (int a = 0; a < num_coarse; ++a) {
    for (int k = pattern.upper_begin[a] + 1; k < pattern.upper_begin[a + 1]; ++k) {
      const int b = pattern.upper_column[k];
      coarse.column[count[b]] = a;
      pattern.mirror[count[b]++] = k;
    }
  }
  for (int a = 0; a < num_coarse; ++a) {
    for (int k = pattern.upper_begin[a] + 1; k < pattern.upper_begin[a + 1]; ++k) {
      coarse.column[count[a]] = pattern.upper_column[k];
      pattern.mirror[count[a]++] = k;
    }
  }
  coarse.values = padded(kCoarseBlock * coarse.column.size());
  return pattern;
}

template <int N>
bool galerkin_product(const BlockRows<N>& A, const GalerkinPattern& pattern, Prolongation<N>& P,
                      RigidModes& coarse_modes, BlockRows<kModes>& coarse, ThreadPool& pool) {
  const int num_coarse = P.num_columns();
  const std::vector<float> product = multiply(A, pattern, P, pool);
  const std::vector<float> upper = multiply_transposed(pattern, P, product, pool);
  const auto block = [&](int k) {
    return Eigen::Map<const Block6>(upper.data() + std::ptrdiff_t{kCoarseBlock} * k);
  };

  std::vector<float> inverse(kCoarseBlock * static_cast<std::size_t>(num_coarse));  // L⁻ᵀ
  const auto inverse_of = [&](int a) {
    return Eigen::Map<Block6>(inverse.data() + std::ptrdiff_t{kCoarseBlock} * a);
  };
  std::atomic<bool> positive = true;
  pool.run_pieces(num_coarse, 64, [&](int first, int last, int) {
    for (int a = first; a < last; ++a) {
      const Block6 diagonal = block(pattern.upper_begin[a]);
      Mat6 D = diagonal.cast<double>();
      for (int m = 0; m < kModes; ++m) {
        if (D(m, m) == 0) D(m, m) = 1;  // a mode that the aggregate does not have
      }
      const Eigen::LLT<Mat6> factor(D);
      if (factor.info() != Eigen::Success || !D.allFinite()) {
        positive = false;
        inverse_of(a).setIdentity();
        continue;
      }
      const Mat6 inverse_factor = factor.matrixU().solve(Mat6::Identity());
      inverse_of(a) = inverse_factor.cast<float>();
      Eigen::Map<Eigen::Matrix<double, kModes, kModes, Eigen::RowMajor>> modes(
          coarse_modes.values.data() + std::ptrdiff_t{kCoarseBlock} * a);
      modes = (factor.matrixU() * modes).eval();
    }
  });

  pool.run_pieces(num_coarse, 64, [&](int first, int last, int) {
    for (int a = first; a < last; ++a) {
      for (int k = coarse.row_begin[a]; k < coarse.row_begin[a + 1]; ++k) {
        const int b = coarse.column[k];
        const Block6 value =
            b > a ? Block6(block(pattern.mirror[k])) : Block6(block(pattern.mirror[k]).transpose());
        const Block6 half = inverse_of(a).transpose() * value;
        Eigen::Map<Block6>(coarse.block(k)).noalias() = half * inverse_of(b);
      }
    }
  });
  pool.run_pieces(P.num_rows(), kRowsPerPiece<N>, [&](int first, int last, int) {
    for (int k = P.row_begin[first]; k < P.row_begin[last]; ++k) {
      Eigen::Map<Eigen::Matrix<float, N, kModes, Eigen::RowMajor>> p(P.block(k));
      p = (p * inverse_of(P.column[k])).eval();
    }
  });
  copy_values_by_columns(P, pool);
  return positive;
}

template GalerkinPattern galerkin_pattern(const BlockRows<3>&, const Prolongation<3>&,
                                          BlockRows<kModes>&);
template GalerkinPattern galerkin_pattern(const BlockRows<6>&, const Prolongation<6>&,
                                          BlockRows<kModes>&);
template bool galerkin_product(const BlockRows<3>&, const GalerkinPattern&, Prolongation<3>&,
                               RigidModes&, BlockRows<kModes>&, ThreadPool&);
template bool galerkin_product(const BlockRows<6>&, const GalerkinPattern&, Prolongation<6>&,
                               RigidModes&, BlockRows<kModes>&, ThreadPool&);

}  // namespace articular::fem
