#include "fem/sparse/signed_cholesky.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "fem/sparse/blas.hpp"
#include "fem/sparse/dense_blas.hpp"
#include "fem/sparse/supernodes.hpp"

namespace articular::fem {
namespace {

// Blocks up to this size are factored by plain loops, larger ones by halves with BLAS.
constexpr int kSmallBlock = 24;

// Supernodes up to this many columns are solved by plain loops: a call of BLAS would cost more.
constexpr int kFewColumns = 6;

// Columns and rows of a supernode that are one task.
constexpr int kPiece = 96;

/// What round-off may make of a pivot in single precision, where the diagonal was about 1. A knee
/// under load has pivots from 1e-3, with round-off of 2e-7.
constexpr double kUnclear = 1e-5;

/// @param pivot  with its sign
template <class Real>
Pivots judge(Real pivot) {
  if constexpr (std::is_same_v<Real, float>) {
    if (std::abs(pivot) <= kUnclear || !std::isfinite(pivot)) return Pivots::Unclear;
  }
  return pivot > 0 && std::isfinite(pivot) ? Pivots::Right : Pivots::Wrong;
}

/// The worst that the tasks find. Only a wrong sign stops those that have not begun: with any
/// number of threads it is found if there is one.
/// @param task  (index, worker) -> Pivots
template <class Task>
Pivots worst_of(int num_tasks, ThreadPool& pool, const Task& task) {
  std::atomic<bool> is_wrong = false, is_unclear = false;
  pool.run(num_tasks, [&](int k, int worker) {
    if (is_wrong) return;
    const Pivots verdict = task(k, worker);
    if (verdict == Pivots::Wrong) is_wrong = true;
    if (verdict == Pivots::Unclear) is_unclear = true;
  });
  if (is_wrong) return Pivots::Wrong;
  return is_unclear ? Pivots::Unclear : Pivots::Right;
}

/// The dense block A = L S Lᵀ in place (lower half, column-major, n columns of stride ld).
template <class Real>
Pivots factorize_dense(int n, Real* A, int ld, const Real* sign, Real* work, ThreadPool& pool) {
  if (n <= kSmallBlock) {
    for (int j = 0; j < n; ++j) {
      Real* column = A + std::ptrdiff_t{j} * ld;
      for (int k = 0; k < j; ++k) {
        const Real* other = A + std::ptrdiff_t{k} * ld;
        const Real factor = sign[k] * other[j];
        for (int i = j; i < n; ++i) column[i] -= factor * other[i];
      }
      const Real pivot = sign[j] * column[j];
      if (const Pivots verdict = judge(pivot); verdict != Pivots::Right) return verdict;
      column[j] = std::sqrt(pivot);
      const Real scale = sign[j] / column[j];
      for (int i = j + 1; i < n; ++i) column[i] *= scale;
    }
    return Pivots::Right;
  }
  // [A11 ·; A21 A22] with A21 = L21 S1 L11ᵀ and A22 − L21 S1 L21ᵀ = L22 S2 L22ᵀ.
  const int n1 = n / 2, n2 = n - n1;
  Real *A21 = A + n1, *A22 = A21 + std::ptrdiff_t{n1} * ld;
  const Pivots verdict = factorize_dense(n1, A, ld, sign, work, pool);
  if (verdict != Pivots::Right) return verdict;
  pool.run_pieces(n2, kPiece, [&](int begin, int end, int) {
    dense::solve_from_right(end - begin, n1, A, ld, A21 + begin, ld);
    for (int j = 0; j < n1; ++j) {
      for (int i = begin; i < end; ++i) {
        Real& entry = A21[std::ptrdiff_t{j} * ld + i];
        work[std::ptrdiff_t{j} * n2 + i] = entry;  // L21 S1
        entry *= sign[j];
      }
    }
  });
  pool.run_pieces(n2, kPiece, [&](int begin, int end, int) {  // of columns, from the diagonal down
    dense::add_product(n2 - begin, end - begin, n1, -1, A21 + begin, ld, work + begin, n2, 1,
                       A22 + std::ptrdiff_t{begin} * ld + begin, ld);
  });
  return factorize_dense(n2, A22, ld, sign + n1, work, pool);
}

/// The rows of L below its dense block L11, from those of A: A21 = L21 S1 L11ᵀ.
template <class Real>
void factorize_below(int n, int num_rows, const Real* L11, Real* A21, int ld, const Real* sign) {
  dense::solve_from_right(num_rows, n, L11, ld, A21, ld);
  for (int j = 0; j < n; ++j) {
    if (sign[j] > 0) continue;
    Real* column = A21 + std::ptrdiff_t{j} * ld;
    for (int i = 0; i < num_rows; ++i) column[i] = -column[i];
  }
}

/// The power of two p for which |x| p² is 1/2 to 2; 1 where x is 0 or no number.
double power_for_unit(double x) {
  if (std::abs(x) < std::numeric_limits<double>::min() || !std::isfinite(x)) return 1;
  return std::ldexp(1.0, -static_cast<int>(std::floor(0.5 * (std::ilogb(x) + 1))));
}

/// Rows of a supernode that lie next to each other in another.
struct Run {
  int begin, end;  // rows of the one
  int place;       // row of the other that `begin` is
};

template <class Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Of one thread.
template <class Real>
struct Scratch {
  std::vector<int> local_row;         // of the ordered rows in the supernode at hand
  std::vector<Real> product, scaled;  // of a descendant
  std::vector<Run> runs;
  Vector<Real> below;
};

}  // namespace

template <class Real>
struct SignedCholesky<Real>::Factor {
  using Work = Scratch<Real>;

  Supernodes nodes;
  std::vector<Real> value, sign;          // sign: ordered
  std::vector<double> scale;              // of the unknowns, ordered: that of A is scale A scale
  std::vector<char> is_positive;          // all signs of a supernode are +
  std::vector<int> head, next, progress;  // descendants that wait for their next supernode
  mutable std::vector<Work> scratch;      // by worker
  struct Piece {
    int s, begin, end;
  };
  std::vector<Piece> pieces;     // of supernodes of a level: columns, or rows below
  mutable ThreadPool alone{1};   // of whoever factors a subtree
  mutable Vector<Real> ordered;  // work of solve(): the unknowns, the rows above subtrees

  void take_memory(std::vector<Real> memory);
  void allocate_work(int num_threads);
  void start(const SymmetricMatrix& A, int s, int from, int to);
  void locate_rows(int s, Work& work) const;
  void subtract(int d, int first, int last, int s, Work& work);
  int rows_before(int d, int first, int column) const;
  void enqueue(int d, int end);
  void set_scale(const SymmetricMatrix& A);
  Pivots factorize_subtree(const SymmetricMatrix& A, const Supernodes::Subtree& subtree,
                           Work& work);
  template <class SizeOf>
  void find_pieces(std::span<const int> level, const SizeOf& size_of);
  void collect(const SymmetricMatrix& A, std::span<const int> level, ThreadPool& pool);
  Pivots factorize_blocks(std::span<const int> level, ThreadPool& pool);
  Pivots factorize_level(const SymmetricMatrix& A, std::span<const int> level, ThreadPool& pool);
  void solve_forward(int s, std::span<const int> rows, Vector<Real>& y, Work& work) const;
  void solve_backward(int s, Vector<Real>& y, Work& work) const;
};

template <class Real>
SignedCholesky<Real>::SignedCholesky(std::shared_ptr<ThreadPool> pool, std::size_t fewest_to_share)
    : pool_(std::move(pool)), fewest_to_share_(fewest_to_share) {
  set_up_blas();
}
template <class Real>
SignedCholesky<Real>::~SignedCholesky() = default;
template <class Real>
SignedCholesky<Real>::SignedCholesky(SignedCholesky&&) noexcept = default;
template <class Real>
SignedCholesky<Real>& SignedCholesky<Real>::operator=(SignedCholesky&&) noexcept = default;

/// That of the factor before: what stood there is overwritten. Patterns in which contact changes
/// get a little larger each time: to ask for new pages then took half as long as to find the order.
template <class Real>
void SignedCholesky<Real>::Factor::take_memory(std::vector<Real> memory) {
  const auto size = static_cast<std::size_t>(nodes.value_begin.back());
  if (memory.capacity() < size) {
    memory = {};
    memory.reserve(size + size / 16);
  }
  memory.resize(size);
  value = std::move(memory);
}

template <class Real>
void SignedCholesky<Real>::Factor::allocate_work(int num_threads) {
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
  for (Work& work : scratch) {
    work.local_row.resize(nodes.order.size());
    work.product.resize(largest_product);
    work.scaled.resize(largest_scaled);
    work.below.resize(most_rows);
  }
  ordered.resize(nodes.size() + nodes.num_above);
  scale.resize(nodes.order.size());
}

template <class Real>
void SignedCholesky<Real>::analyze(const SymmetricMatrix& A, std::span<const int> signs,
                                   std::span<const int> group) {
  assert(signs.size() == static_cast<std::size_t>(A.size()));
  std::vector<Real> memory;
  if (factor_) memory = std::move(factor_->value);
  factor_ = std::make_unique<Factor>();
  Factor& L = *factor_;
  L.nodes = find_supernodes(A, group);
  L.take_memory(std::move(memory));
  L.allocate_work(pool_->num_threads());
  for (const int given : L.nodes.order) L.sign.push_back(static_cast<Real>(signs[given]));
  for (int s = 0; s < L.nodes.count(); ++s)
    L.is_positive.push_back(std::all_of(L.sign.begin() + L.nodes.first_column[s],
                                        L.sign.begin() + L.nodes.first_column[s + 1],
                                        [](Real sign) { return sign > 0; }));
}

template <class Real>
void SignedCholesky<Real>::Factor::set_scale(const SymmetricMatrix& A) {
  for (int i = 0; i < nodes.size(); ++i) {
    const int last = A.begin[nodes.order[i] + 1] - 1;  // of its column: the diagonal, if any
    const bool has_diagonal = last >= A.begin[nodes.order[i]] && A.row[last] == nodes.order[i];
    scale[i] = has_diagonal ? power_for_unit(A.value[last]) : 1;
  }
}

/// Columns from .. to of a supernode become those of A, scaled.
template <class Real>
void SignedCholesky<Real>::Factor::start(const SymmetricMatrix& A, int s, int from, int to) {
  const int ld = nodes.num_rows(s);
  const int* rows = nodes.row.data() + nodes.row_begin[s];
  Real* block = value.data() + nodes.value_begin[s];
  std::fill(block + std::ptrdiff_t{from} * ld, block + std::ptrdiff_t{to} * ld, Real{0});
  const auto entries =
      std::span(nodes.entry)
          .subspan(static_cast<std::size_t>(nodes.entry_begin[s]),
                   static_cast<std::size_t>(nodes.entry_begin[s + 1] - nodes.entry_begin[s]));
  auto entry = std::lower_bound(entries.begin(), entries.end(), from * ld,
                                [](const auto& e, int place) { return e.place < place; });
  for (int column = from; column < to; ++column) {
    const double scale_column = scale[nodes.first_column[s] + column];
    for (; entry != entries.end() && entry->place < (column + 1) * ld; ++entry) {
      const double scale_row = scale[rows[entry->place - column * ld]];
      block[entry->place] += static_cast<Real>(scale_row * A.value[entry->k] * scale_column);
    }
  }
}

template <class Real>
void SignedCholesky<Real>::Factor::locate_rows(int s, Work& work) const {
  for (int i = 0; i < nodes.num_rows(s); ++i) work.local_row[nodes.row[nodes.row_begin[s] + i]] = i;
}

/// The first row of d, from `first` on, that is not before a column.
template <class Real>
int SignedCholesky<Real>::Factor::rows_before(int d, int first, int column) const {
  const int* rows = nodes.row.data() + nodes.row_begin[d];
  return static_cast<int>(std::lower_bound(rows + first, rows + nodes.num_rows(d), column) - rows);
}

/// Block of s −= L_d S_d L_dᵀ, columns that are the rows first .. last of d.
template <class Real>
void SignedCholesky<Real>::Factor::subtract(int d, int first, int last, int s, Work& work) {
  if (first == last) return;
  const int columns = nodes.num_columns(d), ld = nodes.num_rows(d), ld_s = nodes.num_rows(s);
  const int* rows = nodes.row.data() + nodes.row_begin[d];
  const int m = ld - first, n = last - first;
  const Real* L = value.data() + nodes.value_begin[d] + first;
  const Real* right = L;
  int ld_right = ld;
  if (is_positive[d] == 0) {
    const Real* signs = sign.data() + nodes.first_column[d];
    for (int k = 0; k < columns; ++k)
      for (int j = 0; j < n; ++j)
        work.scaled[static_cast<std::size_t>(k) * n + j] = signs[k] * L[std::ptrdiff_t{k} * ld + j];
    right = work.scaled.data();
    ld_right = n;
  }
  Real* block = value.data() + nodes.value_begin[s];
  const auto column_of = [&](int row) {
    return block + std::ptrdiff_t{row - nodes.first_column[s]} * ld_s;
  };
  const int place = work.local_row[rows[first]];
  if (work.local_row[rows[ld - 1]] - place == m - 1) {  // rows and columns lie next to each other
    dense::add_product(m, n, columns, -1, L, ld, right, ld_right, 1, column_of(rows[first]) + place,
                       ld_s);
    return;
  }
  dense::add_product(m, n, columns, 1, L, ld, right, ld_right, 0, work.product.data(), m);
  work.runs.clear();
  for (int i = 0; i < m; ++i) {
    const int at = work.local_row[rows[first + i]];
    if (i == 0 || at != work.runs.back().place + i - work.runs.back().begin)
      work.runs.push_back({i, i, at});
    work.runs.back().end = i + 1;
  }
  for (int j = 0; j < n; ++j) {
    Real* column = column_of(rows[first + j]);
    const Real* from = work.product.data() + std::ptrdiff_t{j} * m;
    for (const Run& run : work.runs) {
      Real* to = column + run.place;
      const Real* part = from + run.begin;
      for (int i = 0; i < run.end - run.begin; ++i) to[i] -= part[i];
    }
  }
}

/// A supernode waits in the list of the one that holds its next row, if that is before `end`.
template <class Real>
void SignedCholesky<Real>::Factor::enqueue(int d, int end) {
  if (progress[d] == nodes.num_rows(d)) return;
  const int target = nodes.of_column[nodes.row[nodes.row_begin[d] + progress[d]]];
  if (target >= end) return;
  next[d] = head[target];
  head[target] = d;
}

template <class Real>
Pivots SignedCholesky<Real>::Factor::factorize_subtree(const SymmetricMatrix& A,
                                                       const Supernodes::Subtree& subtree,
                                                       Work& work) {
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
    Real* block = value.data() + nodes.value_begin[s];
    const Real* signs = sign.data() + nodes.first_column[s];
    const Pivots verdict = factorize_dense(n, block, ld, signs, work.scaled.data(), alone);
    if (verdict != Pivots::Right) return verdict;
    if (ld > n) factorize_below(n, ld - n, block, block + n, ld, signs);
    progress[s] = n;
    enqueue(s, subtree.end);
  }
  return Pivots::Right;
}

/// Of each supernode of a level what those before it leave of its columns, piece by piece.
template <class Real>
void SignedCholesky<Real>::Factor::collect(const SymmetricMatrix& A, std::span<const int> level,
                                           ThreadPool& pool) {
  find_pieces(level, [this](int s) { return nodes.num_columns(s); });
  pool.run(static_cast<int>(pieces.size()), [&](int k, int worker) {
    const auto [s, from, to] = pieces[static_cast<std::size_t>(k)];
    Work& work = scratch[static_cast<std::size_t>(worker)];
    start(A, s, from, to);
    locate_rows(s, work);
    const int column = nodes.first_column[s];
    for (int d = head[s]; d >= 0; d = next[d])
      subtract(d, rows_before(d, progress[d], column + from),
               rows_before(d, progress[d], column + to), s, work);
  });
  for (const int s : level)
    for (int d = std::exchange(head[s], -1), following; d >= 0; d = following) {
      following = next[d];
      progress[d] = rows_before(d, progress[d], nodes.first_column[s + 1]);
      enqueue(d, nodes.count());
    }
}

/// The dense blocks of a level side by side, but for those that would keep a thread from sharing:
/// all threads work on each of these.
template <class Real>
Pivots SignedCholesky<Real>::Factor::factorize_blocks(std::span<const int> level,
                                                      ThreadPool& pool) {
  const auto work_of = [this](int s) { return std::pow(nodes.num_columns(s), 3); };
  double total = 0;
  for (const int s : level) total += work_of(s);
  const auto is_large = [&](int s) { return work_of(s) * pool.num_threads() > total; };
  const auto factorize = [&](int s, ThreadPool& by, int worker) {
    return factorize_dense(nodes.num_columns(s), value.data() + nodes.value_begin[s],
                           nodes.num_rows(s), sign.data() + nodes.first_column[s],
                           scratch[static_cast<std::size_t>(worker)].scaled.data(), by);
  };
  Pivots verdict = Pivots::Right;
  for (const int s : level)
    if (verdict == Pivots::Right && is_large(s)) verdict = factorize(s, pool, 0);
  if (verdict != Pivots::Right) return verdict;
  return worst_of(static_cast<int>(level.size()), pool, [&](int k, int worker) {
    const int s = level[static_cast<std::size_t>(k)];
    return is_large(s) ? Pivots::Right : factorize(s, alone, worker);
  });
}

/// Supernodes of one level of the top.
template <class Real>
Pivots SignedCholesky<Real>::Factor::factorize_level(const SymmetricMatrix& A,
                                                     std::span<const int> level, ThreadPool& pool) {
  collect(A, level, pool);
  if (const Pivots verdict = factorize_blocks(level, pool); verdict != Pivots::Right)
    return verdict;
  find_pieces(level, [this](int s) { return nodes.num_rows(s) - nodes.num_columns(s); });
  pool.run(static_cast<int>(pieces.size()), [&](int k, int) {
    const auto [s, begin, end] = pieces[static_cast<std::size_t>(k)];
    const int n = nodes.num_columns(s), ld = nodes.num_rows(s);
    Real* block = value.data() + nodes.value_begin[s];
    factorize_below(n, end - begin, block, block + n + begin, ld,
                    sign.data() + nodes.first_column[s]);
  });
  for (const int s : level) {
    progress[s] = nodes.num_columns(s);
    enqueue(s, nodes.count());
  }
  return Pivots::Right;
}

/// What a level shares among threads.
/// @param size_of  columns or rows of a supernode
template <class Real>
template <class SizeOf>
void SignedCholesky<Real>::Factor::find_pieces(std::span<const int> level, const SizeOf& size_of) {
  pieces.clear();
  for (const int s : level)
    for (int begin = 0, size = size_of(s); begin < size; begin += kPiece)
      pieces.push_back({s, begin, std::min(size, begin + kPiece)});
}

// Left-looking over supernodes [Ng 1993]: each collects the products of those before it that reach
// its columns, then factors its dense block.
//
// [Ng 1993] Ng, Peyton. Block sparse Cholesky algorithms. SIAM J. Sci. Comput. 14:1034.
template <class Real>
Pivots SignedCholesky<Real>::factorize(const SymmetricMatrix& A) {
  assert(factor_ && A.value.size() == factor_->nodes.entry.size());
  Factor& L = *factor_;
  const Supernodes& nodes = L.nodes;
  std::fill(L.head.begin(), L.head.end(), -1);
  L.set_scale(A);
  const int num_subtrees = static_cast<int>(nodes.subtrees.size());
  Pivots verdict = worst_of(num_subtrees, *pool_, [&](int k, int worker) {
    return L.factorize_subtree(A, nodes.subtrees[static_cast<std::size_t>(k)],
                               L.scratch[static_cast<std::size_t>(worker)]);
  });
  if (verdict != Pivots::Right) return verdict;
  for (const Supernodes::Subtree& subtree : nodes.subtrees)
    for (int d = subtree.begin; d < subtree.end; ++d) L.enqueue(d, nodes.count());
  for (const std::vector<int>& level : nodes.levels) {
    verdict = L.factorize_level(A, level, *pool_);
    if (verdict != Pivots::Right) break;
  }
  return verdict;
}

/// y ← L⁻¹ y in the columns of s, and what follows from it below.
/// @param rows  of s, as they are numbered in y
template <class Real>
void SignedCholesky<Real>::Factor::solve_forward(int s, std::span<const int> rows, Vector<Real>& y,
                                                 Work& work) const {
  const int n = nodes.num_columns(s), ld = nodes.num_rows(s);
  const Real* block = value.data() + nodes.value_begin[s];
  Real* own = y.data() + nodes.first_column[s];
  if (n <= kFewColumns) {
    for (int j = 0; j < n; ++j, block += ld) {
      const Real y_j = own[j] /= block[j];
      for (int i = j + 1; i < ld; ++i) y[rows[i]] -= block[i] * y_j;
    }
    return;
  }
  dense::solve_lower(n, block, ld, own);
  if (ld == n) return;
  dense::multiply(ld - n, n, block + n, ld, own, work.below.data());
  for (int i = n; i < ld; ++i) y[rows[i]] -= work.below[i - n];
}

/// y ← L⁻ᵀ y in the columns of s, from what is known below.
template <class Real>
void SignedCholesky<Real>::Factor::solve_backward(int s, Vector<Real>& y, Work& work) const {
  const int n = nodes.num_columns(s), ld = nodes.num_rows(s);
  const Real* block = value.data() + nodes.value_begin[s];
  Real* own = y.data() + nodes.first_column[s];
  const int* rows = nodes.row.data() + nodes.row_begin[s];
  if (n <= kFewColumns) {
    for (int j = n - 1; j >= 0; --j) {
      const Real* column = block + std::ptrdiff_t{j} * ld;
      Real sum = own[j];
      for (int i = j + 1; i < ld; ++i) sum -= column[i] * y[rows[i]];
      own[j] = sum / column[j];
    }
    return;
  }
  if (ld > n) {
    for (int i = n; i < ld; ++i) work.below[i - n] = y[rows[i]];
    dense::subtract_transposed(ld - n, n, block + n, ld, work.below.data(), own);
  }
  dense::solve_lower_transposed(n, block, ld, own);
}

template <class Real>
void SignedCholesky<Real>::solve(Eigen::VectorXd& x) const {
  assert(factor_ && x.size() == factor_->nodes.size());
  const Factor& L = *factor_;
  const Supernodes& nodes = L.nodes;
  const int n = nodes.size(), num_subtrees = static_cast<int>(nodes.subtrees.size());
  Vector<Real>& y = L.ordered;
  ThreadPool& pool = L.value.size() < fewest_to_share_ ? L.alone : *pool_;
  // Single precision has no room for very small numbers: the largest becomes about 1.
  const double power = power_for_unit(x.template lpNorm<Eigen::Infinity>());
  const double unit = power * power;
  for (int i = 0; i < n; ++i) y[i] = static_cast<Real>(L.scale[i] * (unit * x[nodes.order[i]]));
  y.tail(nodes.num_above).setZero();
  const auto rows = [&](const std::vector<int>& of, int s) {
    return std::span(of).subspan(static_cast<std::size_t>(nodes.row_begin[s]),
                                 static_cast<std::size_t>(nodes.num_rows(s)));
  };
  pool.run(num_subtrees, [&](int k, int worker) {
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
  pool.run(num_subtrees, [&](int k, int worker) {
    const auto [begin, end, above] = nodes.subtrees[static_cast<std::size_t>(k)];
    for (int s = end - 1; s >= begin; --s)
      L.solve_backward(s, y, L.scratch[static_cast<std::size_t>(worker)]);
  });
  for (int i = 0; i < n; ++i) x[nodes.order[i]] = L.scale[i] * static_cast<double>(y[i]) / unit;
}

template <class Real>
std::size_t SignedCholesky<Real>::num_nonzeros() const {
  return factor_ ? factor_->value.size() : 0;
}

template class SignedCholesky<float>;
template class SignedCholesky<double>;

}  // namespace articular::fem
