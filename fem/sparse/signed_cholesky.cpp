#include "fem/sparse/signed_cholesky.hpp"

#include <cblas.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fem/sparse/cholmod_handles.hpp"

namespace articular::fem {
namespace {

// Blocks up to this size are factored by plain loops, larger ones by halves with BLAS.
constexpr int kSmallBlock = 24;

// Supernodes up to this many columns are solved by plain loops: a call of BLAS would cost more.
constexpr int kFewColumns = 6;

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

}  // namespace

void SymmetricMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  assert(x.size() == size() && &x != &y);
  y.setZero(x.size());
  for (int j = 0; j < size(); ++j) {
    double sum = 0;
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      if (row[k] == j) {
        sum += value[k] * x[j];
      } else {
        sum += value[k] * x[row[k]];
        y[row[k]] += value[k] * x[j];
      }
    }
    y[j] += sum;
  }
}

/// Supernode s: columns [first_column[s], first_column[s+1]) of the ordered matrix, which have the
/// rows row[row_begin[s] .. row_begin[s+1]) in common, its own columns first. Its dense block
/// starts at value[value_begin[s]], column-major.
struct SignedCholesky::Factor {
  std::vector<int> order, inverse_order;  // ordered -> given, given -> ordered
  std::vector<int> first_column, row_begin, row;
  std::vector<int> supernode;  // of each column
  std::vector<std::ptrdiff_t> value_begin;
  std::vector<std::ptrdiff_t> target;  // of the entries of A among the values
  std::vector<double> value, sign;     // sign: ordered
  // Work of factorize(): descendants waiting for their next supernode, rows, products.
  std::vector<int> head, next, progress, local_row;
  std::vector<double> product, scaled;
  mutable Eigen::VectorXd ordered, below;  // work of solve()

  int num_supernodes() const { return static_cast<int>(first_column.size()) - 1; }
  int num_columns(int s) const { return first_column[s + 1] - first_column[s]; }
  int num_rows(int s) const { return row_begin[s + 1] - row_begin[s]; }

  void take_symbolic(const cholmod_factor& L);
  void find_targets(const SymmetricMatrix& A);
  void allocate_work();
  void subtract_descendant(int d, int s);
  bool factorize_supernode(int s);
  void solve_forward(int s, Eigen::VectorXd& y) const;
  void solve_backward(int s, Eigen::VectorXd& y) const;
};

SignedCholesky::SignedCholesky() { use_one_blas_thread(); }
SignedCholesky::~SignedCholesky() = default;
SignedCholesky::SignedCholesky(SignedCholesky&&) noexcept = default;
SignedCholesky& SignedCholesky::operator=(SignedCholesky&&) noexcept = default;

void SignedCholesky::Factor::take_symbolic(const cholmod_factor& L) {
  const auto ints = [](const void* data, std::size_t count) {
    return std::vector<int>(static_cast<const int*>(data), static_cast<const int*>(data) + count);
  };
  order = ints(L.Perm, L.n);
  inverse_order.resize(order.size());
  for (int i = 0; i < static_cast<int>(order.size()); ++i) inverse_order[order[i]] = i;
  first_column = ints(L.super, L.nsuper + 1);
  row_begin = ints(L.pi, L.nsuper + 1);
  row = ints(L.s, L.ssize);
  supernode.resize(order.size());
  value_begin.assign(1, 0);
  for (int s = 0; s < num_supernodes(); ++s) {
    std::fill(supernode.begin() + first_column[s], supernode.begin() + first_column[s + 1], s);
    value_begin.push_back(value_begin.back() + std::ptrdiff_t{num_columns(s)} * num_rows(s));
  }
}

void SignedCholesky::Factor::find_targets(const SymmetricMatrix& A) {
  target.clear();
  target.reserve(A.row.size());
  for (int j = 0; j < A.size(); ++j) {
    for (int k = A.begin[j]; k < A.begin[j + 1]; ++k) {
      const auto [low, high] = std::minmax({inverse_order[j], inverse_order[A.row[k]]});
      const int s = supernode[low];
      const auto begin = row.begin() + row_begin[s], end = row.begin() + row_begin[s + 1];
      const auto found = std::lower_bound(begin, end, high);
      assert(found != end && *found == high);
      target.push_back(value_begin[s] + std::ptrdiff_t{low - first_column[s]} * num_rows(s) +
                       (found - begin));
    }
  }
}

void SignedCholesky::Factor::allocate_work() {
  value.resize(static_cast<std::size_t>(value_begin.back()));
  head.resize(static_cast<std::size_t>(num_supernodes()));
  next.resize(head.size());
  progress.resize(head.size());
  local_row.resize(order.size());
  std::size_t largest_product = 0, largest_scaled = 0;
  int most_rows = 0;
  for (int s = 0; s < num_supernodes(); ++s) {
    const auto rows = static_cast<std::size_t>(num_rows(s)),
               columns = static_cast<std::size_t>(num_columns(s));
    // Rows that one ancestor takes at a time are its columns.
    std::size_t group = 0;
    for (int k = row_begin[s] + num_columns(s); k < row_begin[s + 1]; ++k) {
      group = supernode[row[k]] == supernode[row[k - 1]] ? group + 1 : 1;
      largest_product = std::max(largest_product, group * rows);
      largest_scaled = std::max(largest_scaled, group * columns);
    }
    largest_scaled = std::max(largest_scaled, columns * columns);  // of factorize_dense
    most_rows = std::max(most_rows, num_rows(s));
  }
  product.resize(largest_product);
  scaled.resize(largest_scaled);
  ordered.resize(static_cast<Eigen::Index>(order.size()));
  below.resize(most_rows);
}

void SignedCholesky::analyze(const SymmetricMatrix& A, std::span<const int> signs) {
  assert(signs.size() == static_cast<std::size_t>(A.size()));
  factor_ = std::make_unique<Factor>();
  CholmodCommon common;
  const auto n = static_cast<std::size_t>(A.size());
  cholmod_sparse view{};
  view.nrow = view.ncol = n;
  view.nzmax = A.row.size();
  view.p = const_cast<int*>(A.begin.data());
  view.i = const_cast<int*>(A.row.data());
  view.stype = 1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_NESDIS;  // as in cholesky.cpp
  common->supernodal = CHOLMOD_SUPERNODAL;
  const OneThread one_thread;
  CholmodHandle<cholmod_factor> L(cholmod_analyze(&view, common.get()), CholmodFree{common.get()});
  common.check();
  factor_->take_symbolic(*L);
  factor_->find_targets(A);
  factor_->allocate_work();
  for (const int given : factor_->order) factor_->sign.push_back(signs[given]);
}

/// Block of s −= L_d S_d L_dᵀ, the rows of d from its progress on.
void SignedCholesky::Factor::subtract_descendant(int d, int s) {
  const int columns = num_columns(d), ld = num_rows(d), first = progress[d];
  const int* rows = row.data() + row_begin[d];
  int last = first;
  while (last < ld && rows[last] < first_column[s + 1]) ++last;
  const int m = ld - first, n = last - first;
  const double* L = value.data() + value_begin[d] + first;
  for (int k = 0; k < columns; ++k) {
    const double sign_k = sign[first_column[d] + k];
    for (int j = 0; j < n; ++j) {
      scaled[static_cast<std::size_t>(k) * n + j] = sign_k * L[std::ptrdiff_t{k} * ld + j];
    }
  }
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, columns, 1, L, ld, scaled.data(), n, 0,
              product.data(), m);
  double* block = value.data() + value_begin[s];
  for (int j = 0; j < n; ++j) {
    double* column = block + std::ptrdiff_t{rows[first + j] - first_column[s]} * num_rows(s);
    const double* from = product.data() + std::ptrdiff_t{j} * m;
    for (int i = j; i < m; ++i) column[local_row[rows[first + i]]] -= from[i];
  }
  progress[d] = last;
}

bool SignedCholesky::Factor::factorize_supernode(int s) {
  const int n = num_columns(s), ld = num_rows(s);
  double* block = value.data() + value_begin[s];
  const double* sign_s = sign.data() + first_column[s];
  if (!factorize_dense(n, block, ld, sign_s, scaled.data())) return false;
  if (ld == n) return true;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, ld - n, n, 1, block,
              ld, block + n, ld);
  for (int j = 0; j < n; ++j) {
    if (sign_s[j] > 0) continue;
    double* column = block + std::ptrdiff_t{j} * ld;
    for (int i = n; i < ld; ++i) column[i] = -column[i];
  }
  return true;
}

// Left-looking over supernodes [Ng 1993]: each collects the products of those before it that reach
// its columns, then factors its dense block.
//
// [Ng 1993] Ng, Peyton. Block sparse Cholesky algorithms. SIAM J. Sci. Comput. 14:1034.
bool SignedCholesky::factorize(const SymmetricMatrix& A) {
  assert(factor_ && A.value.size() == factor_->target.size());
  Factor& L = *factor_;
  const OneThread one_thread;
  std::fill(L.value.begin(), L.value.end(), 0.0);
  for (std::size_t k = 0; k < A.value.size(); ++k) L.value[L.target[k]] += A.value[k];
  std::fill(L.head.begin(), L.head.end(), -1);
  // A supernode waits in the list of the one that holds its next row.
  const auto enqueue = [&](int d) {
    if (L.progress[d] == L.num_rows(d)) return;
    int& head = L.head[L.supernode[L.row[L.row_begin[d] + L.progress[d]]]];
    L.next[d] = head;
    head = d;
  };
  for (int s = 0; s < L.num_supernodes(); ++s) {
    for (int i = 0; i < L.num_rows(s); ++i) L.local_row[L.row[L.row_begin[s] + i]] = i;
    for (int d = L.head[s], following; d >= 0; d = following) {
      following = L.next[d];
      L.subtract_descendant(d, s);
      enqueue(d);
    }
    if (!L.factorize_supernode(s)) return false;
    L.progress[s] = L.num_columns(s);
    enqueue(s);
  }
  return true;
}

/// y ← L⁻¹ y in the columns of s, and what follows from it below.
void SignedCholesky::Factor::solve_forward(int s, Eigen::VectorXd& y) const {
  const int n = num_columns(s), ld = num_rows(s);
  const double* block = value.data() + value_begin[s];
  double* own = y.data() + first_column[s];
  const int* rows = row.data() + row_begin[s];
  if (n <= kFewColumns) {
    for (int j = 0; j < n; ++j, block += ld) {
      const double y_j = own[j] /= block[j];
      for (int i = j + 1; i < ld; ++i) y[rows[i]] -= block[i] * y_j;
    }
    return;
  }
  cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, block, ld, own, 1);
  if (ld == n) return;
  cblas_dgemv(CblasColMajor, CblasNoTrans, ld - n, n, 1, block + n, ld, own, 1, 0, below.data(), 1);
  for (int i = n; i < ld; ++i) y[rows[i]] -= below[i - n];
}

/// y ← L⁻ᵀ y in the columns of s, from what is known below.
void SignedCholesky::Factor::solve_backward(int s, Eigen::VectorXd& y) const {
  const int n = num_columns(s), ld = num_rows(s);
  const double* block = value.data() + value_begin[s];
  double* own = y.data() + first_column[s];
  const int* rows = row.data() + row_begin[s];
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
    for (int i = n; i < ld; ++i) below[i - n] = y[rows[i]];
    cblas_dgemv(CblasColMajor, CblasTrans, ld - n, n, -1, block + n, ld, below.data(), 1, 1, own,
                1);
  }
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, block, ld, own, 1);
}

void SignedCholesky::solve(Eigen::VectorXd& x) const {
  assert(factor_ && x.size() == static_cast<Eigen::Index>(factor_->order.size()));
  const Factor& L = *factor_;
  const OneThread one_thread;
  Eigen::VectorXd& y = L.ordered;
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = x[L.order[i]];
  for (int s = 0; s < L.num_supernodes(); ++s) L.solve_forward(s, y);
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] *= L.sign[i];
  for (int s = L.num_supernodes() - 1; s >= 0; --s) L.solve_backward(s, y);
  for (Eigen::Index i = 0; i < y.size(); ++i) x[L.order[i]] = y[i];
}

std::size_t SignedCholesky::num_nonzeros() const { return factor_ ? factor_->value.size() : 0; }

}  // namespace articular::fem
