#include "fem/sparse/mirrored_matrix.hpp"

#include <atomic>
#include <cstring>

namespace articular::fem {
namespace {

using Double2 [[gnu::vector_size(16)]] = double;

Double2 load2(const double* p) {
  Double2 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

}  // namespace

void MirroredMatrix::take_pattern(const BlockMatrix& A) {
  pattern_id_ = A.pattern_id();
  row_begin_.assign(A.row_begin().begin(), A.row_begin().end());
  column_.assign(A.column().begin(), A.column().end());
  source_.resize(column_.size());
  diagonal_.resize(A.num_blocks());
  values_.resize(9 * column_.size());
  // Row by row, blocks below the diagonal meet their mirror images in the order of these.
  std::vector<int> next(A.num_blocks());
  for (int i = 0; i < A.num_blocks(); ++i) {
    int k = row_begin_[i];
    for (; column_[k] < i; ++k) {
      source_[k] = k;
      source_[next[column_[k]]++] = k;
    }
    source_[k] = diagonal_[i] = k;
    next[i] = k + 1;
  }
}

bool MirroredMatrix::take_values(const BlockMatrix& A, ThreadPool& pool) {
  std::atomic<bool> finite = true;
  pool.run_pieces(num_rows(), kRowsOfSums, [&](int begin, int end, int) {
    double zero = 0;  // stays so unless a value is not finite
    for (int i = begin; i < end; ++i) {
      for (int k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
        const double* from = A.block(source_[k]).data();
        double* to = values_.data() + std::ptrdiff_t{9} * k;
        const int j = column_[k];
        for (int c = 0; c < 3; ++c) {
          for (int r = 0; r < 3; ++r) {
            const bool mirror = j > i || (j == i && c > r);
            to[3 * c + r] = mirror ? from[3 * r + c] : from[3 * c + r];
            zero += 0 * to[3 * c + r];
          }
        }
      }
    }
    if (zero != 0) finite = false;  // true for NaN
  });
  return finite;
}

double MirroredMatrix::multiply_rows(Eigen::Index begin, Eigen::Index end, const double* x,
                                     double* y) const {
  double product = 0;
  for (Eigen::Index i = begin; i < end; ++i) {
    Double2 y01{};
    double y2 = 0;
    const double* a = block(row_begin_[i]);
    for (int k = row_begin_[i]; k < row_begin_[i + 1]; ++k, a += 9) {
      const double* x_j = x + std::ptrdiff_t{3} * column_[k];
      y01 += load2(a) * x_j[0] + load2(a + 3) * x_j[1] + load2(a + 6) * x_j[2];
      y2 += a[2] * x_j[0] + a[5] * x_j[1] + a[8] * x_j[2];
    }
    const double* x_i = x + 3 * i;
    double* y_i = y + 3 * i;
    y_i[0] = y01[0];
    y_i[1] = y01[1];
    y_i[2] = y2;
    product += x_i[0] * y01[0] + x_i[1] * y01[1] + x_i[2] * y2;
  }
  return product;
}

}  // namespace articular::fem
