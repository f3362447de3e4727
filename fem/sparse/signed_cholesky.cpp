#include "fem/sparse/signed_cholesky.hpp"

#include <cblas.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <utility>

#include "fem/sparse/blas.hpp"
#include "fem/sparse/supernodes.hpp"

namespace articular::fem {
namespace {

// Blocks up to this size are factored by plain loops, larger ones by halves with BLAS.
constexpr int kSmallBlock = 24;

// Supernodes up to this many columns are solved by plain loops: a call of BLAS would cost more.
constexpr int kFewColumns = 6;

// Columns and rows of a supernode that are one task.
constexpr int kPiece = 96;

/// The dense block A = L S Lᵀ in place (lower half, column-major, n columns of stride ld).
bool factorize_dense(int n, double* A, int ld, const double* sign, double* work) {
  if (n <= kSmallBlock) {
    for (int j = 0; j < n; ++j) {
      double* column = A + std::ptrdiff_t{j} * ld;
      for (int k = 0; k < j; ++k) {
        const double* other = A + std::ptrdiff_t{k} * ld;
        const double factor = sign[k] * other[j];
        for (int i = j; i < n; ++i) column[i] -= factor * other[i];
      }
      const double pivot = sign[j] * column[j];
      if (!(pivot > 0 && std::isfinite(pivot))) return false;
      column[j] = std::sqrt(pivot);
      const double scale = sign[j] / column[j];
      for (int i = j + 1; i < n; ++i) column[i] *= scale;
    }
    return true;
  }
  // [A11 ·; A21 A22] with A21 = L21 S1 L11ᵀ and A22 − L21 S1 L21ᵀ = L22 S2 L22ᵀ.
  const int n1 = n / 2, n2 = n - n1;
  double *A21 = A + n1, *A22 = A21 + std::ptrdiff_t{n1} * ld;
  if (!factorize_dense(n1, A, ld, sign, work)) return false;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, n2, n1, 1, A, ld,
              A21, ld);
  for (int j = 0; j < n1; ++j) {
    for (int i = 0; i < n2; ++i) {
      double& entry = A21[std::ptrdiff_t{j} * ld + i];
      work[std::ptrdiff_t{j} * n2 + i] = entry;  // L21 S1
      entry *= sign[j];
    }
  }
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n2, n2, n1, -1, A21, ld, work, n2, 1, A22,
              ld);
  return factorize_dense(n2, A22, ld, sign + n1, work);
}

/// The rows of L below its dense block L11, from those of A: A21 = L21 S1 L11ᵀ.
void factorize_below(int n, int num_rows, const double* L11, double* A21, int ld,
                     const double* sign) {
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, num_rows, n, 1, L11,
              ld, A21, ld);
  for (int j = 0; j < n; ++j) {
    if (sign[j] > 0) continue;
    double* column = A21 + std::ptrdiff_t{j} * ld;
    for (int i = 0; i < num_rows; ++i) column[i] = -column[i];
  }
}

/// Rows of a supernode that lie next to each other in another.
struct Run {
  int begin, end;  // rows of the one
  int place;       // row of the other that `begin` is
};

/// Of one thread.
struct Scratch {
  std::vector<int> local_row;           // of the ordered rows in the supernode at hand
  std::vector<double> product, scaled;  // of a descendant
  std::vector<Run> runs;
  Eigen::VectorXd below;
};

int pieces_of(int size) { return (size + kPiece - 1) / kPiece; }

}  // namespace

struct SignedCholesky::Factor {
  Supernodes nodes;
  std::vector<double> value, sign;        // sign: ordered
  std::vector<char> is_positive;          // all signs of a supernode are +
  std::vector<int> head, next, progress;  // descendants that wait for their next supernode
  mutable std::vector<Scratch> scratch;   // by worker
  mutable Eigen::VectorXd ordered;        // work of solve(): the unknowns, the rows above subtrees

  void allocate_work(int num_threads);
  void start(const SymmetricMatrix& A, int s, int from, int to);
  void locate_rows(int s, Scratch& work) const;
  void subtract(int d, int first, int last, int s, Scratch& work);
  int rows_before(int d, int first, int column) const;
  void enqueue(int d, int end);
  bool factorize_subtree(const SymmetricMatrix& A, const Supernodes::Subtree& subtree,
                         Scratch& work);
  bool factorize_top(const SymmetricMatrix& A, int s, ThreadPool& pool);
  void solve_forward(int s, std::span<const int> rows, Eigen::VectorXd& y, Scratch& work) const;
  void solve_backward(int s, Eigen::VectorXd& y, Scratch& work) const;
};

SignedCholesky::SignedCholesky(std::shared_ptr<ThreadPool> pool) : pool_(std::move(pool)) {
  set_up_blas();
}
SignedCholesky::~SignedCholesky() = default;
SignedCholesky::SignedCholesky(SignedCholesky&&) noexcept = default;
SignedCholesky& SignedCholesky::operator=(SignedCholesky&&) noexcept = default;

void SignedCholesky::Factor::allocate_work(int num_threads) {
  value.resize(static_cast<std::size_t>(nodes.value_begin.back()));
  head.resize(static_cast<std::size_t>(nodes.count()));
  next.resize(head.size());
  progress.resize(head.size());
  std::size_t largest_product = 0, largest_scaled = 0;
  int most_rows = 0;
  for (int s = 0; s < nodes.count(); ++s) {
    const auto rows = static_cast<std::size_t>(nodes.num_rows(s)),
               columns = static_cast<std::size_t>(nodes.num_columns(s));
    // Rows that one ancestor takes at a time are its columns.
    std::size_t group = 0;
    for (int k = nodes.row_begin[s] + nodes.num_columns(s); k < nodes.row_begin[s + 1]; ++k) {
      group = nodes.of_column[nodes.row[k]] == nodes.of_column[nodes.row[k - 1]] ? group + 1 : 1;
      largest_product = std::max(largest_product, group * rows);
      largest_scaled = std::max(largest_scaled, group * columns);
    }
    largest_scaled = std::max(largest_scaled, columns * columns);  // of factorize_dense
    most_rows = std::max(most_rows, nodes.num_rows(s));
  }
  scratch.resize(static_cast<std::size_t>(num_threads));
  for (Scratch& work : scratch) {
    work.local_row.resize(nodes.order.size());
    work.product.resize(largest_product);
    work.scaled.resize(largest_scaled);
    work.below.resize(most_rows);
  }
  ordered.resize(nodes.size() + nodes.num_above);
}

void SignedCholesky::analyze(const SymmetricMatrix& A, std::span<const int> signs,
                             std::span<const int> group) {
  assert(signs.size() == static_cast<std::size_t>(A.size()));
  factor_ = std::make_unique<Factor>();
  Factor& L = *factor_;
  L.nodes = find_supernodes(A, group);
  L.allocate_work(pool_->num_threads());
  for (const int given : L.nodes.order) L.sign.push_back(signs[given]);
  for (int s = 0; s < L.nodes.count(); ++s)
    L.is_positive.push_back(std::all_of(L.sign.begin() + L.nodes.first_column[s],
                                        L.sign.begin() + L.nodes.first_column[s + 1],
                                        [](double sign) { return sign > 0; }));
}

/// Columns from .. to of a supernode become those of A.
void SignedCholesky::Factor::start(const SymmetricMatrix& A, int s, int from, int to) {
  const int ld = nodes.num_rows(s);
  double* block = value.data() + nodes.value_begin[s];
  std::fill(block + std::ptrdiff_t{from} * ld, block + std::ptrdiff_t{to} * ld, 0.0);
  const auto entries =
      std::span(nodes.entry)
          .subspan(static_cast<std::size_t>(nodes.entry_begin[s]),
                   static_cast<std::size_t>(nodes.entry_begin[s + 1] - nodes.entry_begin[s]));
  auto entry = std::lower_bound(entries.begin(), entries.end(), from * ld,
                                [](const auto& e, int place) { return e.place < place; });
  for (; entry != entries.end() && entry->place < to * ld; ++entry)
    block[entry->place] += A.value[entry->k];
}

void SignedCholesky::Factor::locate_rows(int s, Scratch& work) const {
  for (int i = 0; i < nodes.num_rows(s); ++i) work.local_row[nodes.row[nodes.row_begin[s] + i]] = i;
}

/// The first row of d, from `first` on, that is not before a column.
int SignedCholesky::Factor::rows_before(int d, int first, int column) const {
  const int* rows = nodes.row.data() + nodes.row_begin[d];
  return static_cast<int>(std::lower_bound(rows + first, rows + nodes.num_rows(d), column) - rows);
}

/// Block of s −= L_d S_d L_dᵀ, columns that are the rows first .. last of d.
void SignedCholesky::Factor::subtract(int d, int first, int last, int s, Scratch& work) {
  if (first == last) return;
  const int columns = nodes.num_columns(d), ld = nodes.num_rows(d), ld_s = nodes.num_rows(s);
  const int* rows = nodes.row.data() + nodes.row_begin[d];
  const int m = ld - first, n = last - first;
  const double* L = value.data() + nodes.value_begin[d] + first;
  const double* right = L;
  int ld_right = ld;
  if (is_positive[d] == 0) {
    const double* signs = sign.data() + nodes.first_column[d];
    for (int k = 0; k < columns; ++k)
      for (int j = 0; j < n; ++j)
        work.scaled[static_cast<std::size_t>(k) * n + j] = signs[k] * L[std::ptrdiff_t{k} * ld + j];
    right = work.scaled.data();
    ld_right = n;
  }
  double* block = value.data() + nodes.value_begin[s];
  const auto column_of = [&](int row) {
    return block + std::ptrdiff_t{row - nodes.first_column[s]} * ld_s;
  };
  const int place = work.local_row[rows[first]];
  if (work.local_row[rows[ld - 1]] - place == m - 1) {  // rows and columns lie next to each other
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, columns, -1, L, ld, right, ld_right,
                1, column_of(rows[first]) + place, ld_s);
    return;
  }
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, columns, 1, L, ld, right, ld_right, 0,
              work.product.data(), m);
  work.runs.clear();
  for (int i = 0; i < m; ++i) {
    const int at = work.local_row[rows[first + i]];
    if (i == 0 || at != work.runs.back().place + i - work.runs.back().begin)
      work.runs.push_back({i, i, at});
    work.runs.back().end = i + 1;
  }
  for (int j = 0; j < n; ++j) {
    double* column = column_of(rows[first + j]);
    const double* from = work.product.data() + std::ptrdiff_t{j} * m;
    for (const Run& run : work.runs) {
      double* to = column + run.place;
      const double* part = from + run.begin;
      for (int i = 0; i < run.end - run.begin; ++i) to[i] -= part[i];
    }
  }
}

/// A supernode waits in the list of the one that holds its next row, if that is before `end`.
void SignedCholesky::Factor::enqueue(int d, int end) {
  if (progress[d] == nodes.num_rows(d)) return;
  const int target = nodes.of_column[nodes.row[nodes.row_begin[d] + progress[d]]];
  if (target >= end) return;
  next[d] = head[target];
  head[target] = d;
}

bool SignedCholesky::Factor::factorize_subtree(const SymmetricMatrix& A,
                                               const Supernodes::Subtree& subtree, Scratch& work) {
  for (int s = subtree.begin; s < subtree.end; ++s) {
    const int n = nodes.num_columns(s), ld = nodes.num_rows(s);
    start(A, s, 0, n);
    locate_rows(s, work);
    for (int d = std::exchange(head[s], -1), following; d >= 0; d = following) {
      following = next[d];
      const int first =
          std::exchange(progress[d], rows_before(d, progress[d], nodes.first_column[s + 1]));
      subtract(d, first, progress[d], s, work);
      enqueue(d, subtree.end);
    }
    double* block = value.data() + nodes.value_begin[s];
    const double* signs = sign.data() + nodes.first_column[s];
    if (!factorize_dense(n, block, ld, signs, work.scaled.data())) return false;
    if (ld > n) factorize_below(n, ld - n, block, block + n, ld, signs);
    progress[s] = n;
    enqueue(s, subtree.end);
  }
  return true;
}

/// The same by pieces of the columns, and of the rows below.
bool SignedCholesky::Factor::factorize_top(const SymmetricMatrix& A, int s, ThreadPool& pool) {
  const int n = nodes.num_columns(s), ld = nodes.num_rows(s), column = nodes.first_column[s];
  double* block = value.data() + nodes.value_begin[s];
  const double* signs = sign.data() + column;
  pool.run(pieces_of(n), [&](int piece, int worker) {
    Scratch& work = scratch[static_cast<std::size_t>(worker)];
    const int from = piece * kPiece, to = std::min(from + kPiece, n);
    start(A, s, from, to);
    locate_rows(s, work);
    for (int d = head[s]; d >= 0; d = next[d])
      subtract(d, rows_before(d, progress[d], column + from),
               rows_before(d, progress[d], column + to), s, work);
  });
  for (int d = std::exchange(head[s], -1), following; d >= 0; d = following) {
    following = next[d];
    progress[d] = rows_before(d, progress[d], nodes.first_column[s + 1]);
    enqueue(d, nodes.count());
  }
  if (!factorize_dense(n, block, ld, signs, scratch[0].scaled.data())) return false;
  pool.run(pieces_of(ld - n), [&](int piece, int) {
    const int from = n + piece * kPiece;
    factorize_below(n, std::min(kPiece, ld - from), block, block + from, ld, signs);
  });
  progress[s] = n;
  enqueue(s, nodes.count());
  return true;
}

// Left-looking over supernodes [Ng 1993]: each collects the products of those before it that reach
// its columns, then factors its dense block.
//
// [Ng 1993] Ng, Peyton. Block sparse Cholesky algorithms. SIAM J. Sci. Comput. 14:1034.
bool SignedCholesky::factorize(const SymmetricMatrix& A) {
  assert(factor_ && A.value.size() == factor_->nodes.entry.size());
  Factor& L = *factor_;
  const Supernodes& nodes = L.nodes;
  std::fill(L.head.begin(), L.head.end(), -1);
  std::atomic<bool> is_definite = true;
  pool_->run(static_cast<int>(nodes.subtrees.size()), [&](int k, int worker) {
    if (is_definite && !L.factorize_subtree(A, nodes.subtrees[static_cast<std::size_t>(k)],
                                            L.scratch[static_cast<std::size_t>(worker)]))
      is_definite = false;
  });
  if (!is_definite) return false;
  for (const Supernodes::Subtree& subtree : nodes.subtrees)
    for (int d = subtree.begin; d < subtree.end; ++d) L.enqueue(d, nodes.count());
  return std::all_of(nodes.top.begin(), nodes.top.end(),
                     [&](int s) { return L.factorize_top(A, s, *pool_); });
}

/// y ← L⁻¹ y in the columns of s, and what follows from it below.
/// @param rows  of s, as they are numbered in y
void SignedCholesky::Factor::solve_forward(int s, std::span<const int> rows, Eigen::VectorXd& y,
                                           Scratch& work) const {
  const int n = nodes.num_columns(s), ld = nodes.num_rows(s);
  const double* block = value.data() + nodes.value_begin[s];
  double* own = y.data() + nodes.first_column[s];
  if (n <= kFewColumns) {
    for (int j = 0; j < n; ++j, block += ld) {
      const double y_j = own[j] /= block[j];
      for (int i = j + 1; i < ld; ++i) y[rows[i]] -= block[i] * y_j;
    }
    return;
  }
  cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, block, ld, own, 1);
  if (ld == n) return;
  cblas_dgemv(CblasColMajor, CblasNoTrans, ld - n, n, 1, block + n, ld, own, 1, 0,
              work.below.data(), 1);
  for (int i = n; i < ld; ++i) y[rows[i]] -= work.below[i - n];
}

/// y ← L⁻ᵀ y in the columns of s, from what is known below.
void SignedCholesky::Factor::solve_backward(int s, Eigen::VectorXd& y, Scratch& work) const {
  const int n = nodes.num_columns(s), ld = nodes.num_rows(s);
  const double* block = value.data() + nodes.value_begin[s];
  double* own = y.data() + nodes.first_column[s];
  const int* rows = nodes.row.data() + nodes.row_begin[s];
  if (n <= kFewColumns) {
    for (int j = n - 1; j >= 0; --j) {
      const double* column = block + std::ptrdiff_t{j} * ld;
      double sum = own[j];
      for (int i = j + 1; i < ld; ++i) sum -= column[i] * y[rows[i]];
      own[j] = sum / column[j];
    }
    return;
  }
  if (ld > n) {
    for (int i = n; i < ld; ++i) work.below[i - n] = y[rows[i]];
    cblas_dgemv(CblasColMajor, CblasTrans, ld - n, n, -1, block + n, ld, work.below.data(), 1, 1,
                own, 1);
  }
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, block, ld, own, 1);
}

void SignedCholesky::solve(Eigen::VectorXd& x) const {
  assert(factor_ && x.size() == factor_->nodes.size());
  const Factor& L = *factor_;
  const Supernodes& nodes = L.nodes;
  const int n = nodes.size(), num_subtrees = static_cast<int>(nodes.subtrees.size());
  Eigen::VectorXd& y = L.ordered;
  for (int i = 0; i < n; ++i) y[i] = x[nodes.order[i]];
  y.tail(nodes.num_above).setZero();
  const auto rows = [&](const std::vector<int>& of, int s) {
    return std::span(of).subspan(static_cast<std::size_t>(nodes.row_begin[s]),
                                 static_cast<std::size_t>(nodes.num_rows(s)));
  };
  pool_->run(num_subtrees, [&](int k, int worker) {
    const auto [begin, end, above] = nodes.subtrees[static_cast<std::size_t>(k)];
    for (int s = begin; s < end; ++s)
      L.solve_forward(s, rows(nodes.forward_row, s), y,
                      L.scratch[static_cast<std::size_t>(worker)]);
  });
  for (const auto& [begin, end, above] : nodes.subtrees) {
    const auto of_root =
        rows(nodes.row, end - 1).subspan(static_cast<std::size_t>(nodes.num_columns(end - 1)));
    for (std::size_t i = 0; i < of_root.size(); ++i)
      y[of_root[i]] += y[n + above + static_cast<int>(i)];
  }
  for (const int s : nodes.top) L.solve_forward(s, rows(nodes.row, s), y, L.scratch[0]);
  for (int i = 0; i < n; ++i) y[i] *= L.sign[static_cast<std::size_t>(i)];
  for (auto s = nodes.top.rbegin(); s != nodes.top.rend(); ++s)
    L.solve_backward(*s, y, L.scratch[0]);
  pool_->run(num_subtrees, [&](int k, int worker) {
    const auto [begin, end, above] = nodes.subtrees[static_cast<std::size_t>(k)];
    for (int s = end - 1; s >= begin; --s)
      L.solve_backward(s, y, L.scratch[static_cast<std::size_t>(worker)]);
  });
  for (int i = 0; i < n; ++i) x[nodes.order[i]] = y[i];
}

std::size_t SignedCholesky::num_nonzeros() const { return factor_ ? factor_->value.size() : 0; }

}  // namespace articular::fem
