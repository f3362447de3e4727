#include "fem/solver/incomplete_cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cstddef>

#include "fem/sparse/block_rows.hpp"

namespace articular::fem {
namespace {

constexpr std::array kShifts{0.0, 1.0 / 256, 1.0 / 64, 1.0 / 16, 1.0 / 4, 1.0};

}  // namespace

bool IncompleteCholesky::factorize(const LowerBlocks& A) {
  row_begin_ = A.row_begin;
  column_ = A.column;
  for (std::size_t k = level_ > 0 ? level_ - 1 : 0; k < kShifts.size(); ++k) {
    if (!factorize(A, kShifts[k])) continue;
    level_ = k;
    return true;
  }
  return false;
}

double IncompleteCholesky::shift() const { return kShifts[level_]; }

bool IncompleteCholesky::factorize(const LowerBlocks& A, double shift) {
  const auto n = static_cast<std::size_t>(A.num_blocks());
  scaled_.resize(A.below.size());
  lower_.resize(A.below.size());
  inverse_.resize(n);
  slot_of_column_.assign(n, -1);
  for (int i = 0; i < A.num_blocks(); ++i) {
    const int begin = row_begin_[i], end = row_begin_[i + 1];
    for (int k = begin; k < end; ++k) slot_of_column_[column_[k]] = k;
    Mat3 pivot = (1 + shift) * A.diagonal[i];
    for (int k = begin; k < end; ++k) {
      const int j = column_[k];
      Mat3 rest = A.below[k];  // (L D)_ij = A_ij − Σ (L D)_im L_jmᵀ
      for (int m = row_begin_[j]; m < row_begin_[j + 1]; ++m)
        if (const int slot = slot_of_column_[column_[m]]; slot >= 0)
          rest.noalias() -= scaled_[slot] * lower_[m].transpose();
      scaled_[k] = rest;
      lower_[k].noalias() = rest * inverse_[j];
      pivot.noalias() -= rest * lower_[k].transpose();
    }
    for (int k = begin; k < end; ++k) slot_of_column_[column_[k]] = -1;
    const Eigen::LLT<Mat3> factor(pivot);
    if (factor.info() != Eigen::Success || !pivot.allFinite()) return false;
    inverse_[i] = factor.solve(Mat3::Identity());
  }
  below_ = padded(9 * lower_.size());
  inverse_pivot_.resize(n);
  for (std::size_t k = 0; k < lower_.size(); ++k)
    Eigen::Map<Mat3f>(below_.data() + 9 * k) = lower_[k].cast<float>();
  for (std::size_t i = 0; i < n; ++i) inverse_pivot_[i] = inverse_[i].cast<float>();
  return true;
}

void IncompleteCholesky::solve(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  assert(r.size() == 3 * static_cast<Eigen::Index>(inverse_pivot_.size()));
  const double size = r.cwiseAbs().maxCoeff();  // keeps the numbers within single precision
  if (size == 0) {
    z.setZero(r.size());
    return;
  }
  work_ = (r / size).cast<float>();
  solve_lower();
  const int n = static_cast<int>(inverse_pivot_.size());
  for (int i = 0; i < n; ++i) {
    auto part = work_.segment<3>(3 * Eigen::Index{i});
    part = (inverse_pivot_[i] * part).eval();
  }
  solve_upper();
  z = size * work_.cast<double>();
}

void IncompleteCholesky::solve_lower() {
  float* x = work_.data();
  const float* b = below_.data();
  for (int i = 0; i + 1 < static_cast<int>(row_begin_.size()); ++i) {
    Float4 sum{};  // the fourth entry is of no meaning
    for (int k = row_begin_[i]; k < row_begin_[i + 1]; ++k, b += 9) {
      const float* x_j = x + std::ptrdiff_t{3} * column_[k];
      sum += load4(b) * x_j[0] + load4(b + 3) * x_j[1] + load4(b + 6) * x_j[2];
    }
    for (int c = 0; c < 3; ++c) x[3 * i + c] -= sum[c];
  }
}

void IncompleteCholesky::solve_upper() {
  float* x = work_.data();
  for (int i = static_cast<int>(row_begin_.size()) - 2; i >= 0; --i) {
    const float x_0 = x[3 * i], x_1 = x[3 * i + 1], x_2 = x[3 * i + 2];
    for (int k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
      const float* b = below_.data() + std::ptrdiff_t{9} * k;
      float* x_j = x + std::ptrdiff_t{3} * column_[k];
      for (int c = 0; c < 3; ++c)
        x_j[c] -= b[3 * c] * x_0 + b[3 * c + 1] * x_1 + b[3 * c + 2] * x_2;
    }
  }
}

}  // namespace articular::fem
