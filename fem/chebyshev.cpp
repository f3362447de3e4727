#include "fem/chebyshev.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace articular::fem {
namespace {

constexpr int kLanczosSteps = 10;

/// Coefficients of the recurrence d ← previous d + residual r, x ← x + d.
class Recurrence {
 public:
  explicit Recurrence(const ChebyshevSmoother& s)
      : center_(0.5F * (s.high + s.low)), radius_(0.5F * (s.high - s.low)) {
    rho_ = radius_ / center_;
    residual_ = 1 / center_;
  }
  void advance() {
    const float rho = 1 / (2 * center_ / radius_ - rho_);
    previous_ = rho * rho_;
    residual_ = 2 * rho / radius_;
    rho_ = rho;
  }
  float previous() const { return previous_; }
  float residual() const { return residual_; }

 private:
  float center_, radius_, rho_ = 0, previous_ = 0, residual_ = 0;
};

/// r ← r − A d; d_next = previous d + residual r; x ← x + d_next, and where d was not in x yet, +
/// d.
template <int N>
void step(const BlockRows<N>& A, float previous, float residual, bool add_d, LevelVectors& v,
          ThreadPool& pool) {
  const float keep = add_d ? 1.0F : 0.0F;
  pool.run_pieces(A.num_rows(), kRowsPerPiece<N>, [&](int begin, int end, int) {
    float* r = v.r.data() + std::ptrdiff_t{N} * begin;
    const float* d = v.d.data() + std::ptrdiff_t{N} * begin;
    float* d_next = v.d_next.data() + std::ptrdiff_t{N} * begin;
    float* x = v.x.data() + std::ptrdiff_t{N} * begin;
    std::array<float, 8> sum;
    for (int i = begin; i < end; ++i, r += N, d += N, d_next += N, x += N) {
      row_product(A, i, v.d.data(), sum.data());
      for (int c = 0; c < N; ++c) {
        r[c] -= d[c] + sum[c];
        d_next[c] = previous * d[c] + residual * r[c];
        x[c] += d_next[c] + keep * d[c];
      }
    }
  });
  std::swap(v.d, v.d_next);
}

/// Parts of sums over pieces, added in their order.
class PiecewiseSum {
 public:
  PiecewiseSum(int size, int piece) : parts_((size + piece - 1) / piece), piece_(piece) {}
  double& part(int begin) { return parts_[begin / piece_]; }
  double total() const {
    double sum = 0;
    for (const double part : parts_) sum += part;
    return sum;
  }

 private:
  std::vector<double> parts_;
  int piece_;
};

template <int N>
float gershgorin(const BlockRows<N>& A) {
  float largest = 0;
  for (int i = 0; i < A.num_rows(); ++i) {
    float sum = 0;
    for (int k = A.row_begin[i]; k < A.row_begin[i + 1]; ++k) {
      float squares = 0;  // of the block: its Frobenius norm is not below its largest factor
      for (int c = 0; c < N * N; ++c) squares += A.block(k)[c] * A.block(k)[c];
      sum += std::sqrt(squares);
    }
    largest = std::max(largest, sum);
  }
  return 1 + largest;
}

std::vector<float> random_vector(std::size_t size) {
  std::vector<float> v = padded(size);
  std::uint32_t state = 12345;
  for (std::size_t k = 0; k < size; ++k) {
    state = state * 1664525U + 1013904223U;  // Numerical Recipes' generator
    v[k] = static_cast<float>(state >> 8) / 8388608.0F - 1;
  }
  return v;
}

}  // namespace

template <int N>
LargestEigenvalue largest_eigenvalue(const BlockRows<N>& A, ThreadPool& pool) {
  const int n = A.num_rows(), piece = kRowsPerPiece<N>;
  const auto size = static_cast<std::size_t>(N) * static_cast<std::size_t>(n);
  std::vector<float> v = random_vector(size), before = padded(size), w = padded(size);
  double norm = 0;
  for (const float entry : v) norm += double{entry} * entry;
  norm = std::sqrt(norm);
  for (float& entry : v) entry = static_cast<float>(entry / norm);

  const int steps = std::min<int>(kLanczosSteps, N * n);
  Eigen::VectorXd alpha = Eigen::VectorXd::Zero(steps), beta = Eigen::VectorXd::Zero(steps);
  int done = 0;
  for (; done < steps; ++done) {
    const auto last_beta = static_cast<float>(done > 0 ? beta[done - 1] : 0.0);
    PiecewiseSum product(n, piece), squares(n, piece);
    pool.run_pieces(n, piece, [&](int begin, int end, int) {  // w = A v − β v₋₁, α = v·w
      std::array<float, 8> sum;
      double dot = 0;
      for (int i = begin; i < end; ++i) {
        row_product(A, i, v.data(), sum.data());
        for (int c = 0; c < N; ++c) {
          const std::ptrdiff_t k = std::ptrdiff_t{N} * i + c;
          w[k] = v[k] + sum[c] - last_beta * before[k];
          dot += double{v[k]} * w[k];
        }
      }
      product.part(begin) = dot;
    });
    alpha[done] = product.total();
    const auto a = static_cast<float>(alpha[done]);
    pool.run_pieces(n, piece, [&](int begin, int end, int) {
      double dot = 0;
      for (std::ptrdiff_t k = std::ptrdiff_t{N} * begin; k < std::ptrdiff_t{N} * end; ++k) {
        w[k] -= a * v[k];
        dot += double{w[k]} * w[k];
      }
      squares.part(begin) = dot;
    });
    beta[done] = std::sqrt(squares.total());
    if (!(beta[done] > 1e-5)) {  // [-] the space is exhausted: the Ritz value is an eigenvalue
      ++done;
      break;
    }
    const auto scale = static_cast<float>(1 / beta[done]);
    pool.run_pieces(n, piece, [&](int begin, int end, int) {
      for (std::ptrdiff_t k = std::ptrdiff_t{N} * begin; k < std::ptrdiff_t{N} * end; ++k) {
        before[k] = v[k];
        v[k] = scale * w[k];
      }
    });
  }
  LargestEigenvalue result;
  result.sure_bound = gershgorin(A);
  if (done == 0) return result;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(alpha.head(done), beta.head(done - 1));
  const Eigen::Index top = done - 1;
  const double residual = std::abs(beta[top] * ritz.eigenvectors()(top, top));
  const auto likely = static_cast<float>(ritz.eigenvalues()[top] + residual);
  result.likely_bound = std::min(likely, result.sure_bound);
  if (!(result.likely_bound >= 1)) result.likely_bound = result.sure_bound;  // NaN included
  return result;
}

template <int N>
void smooth_before(const BlockRows<N>& A, const ChebyshevSmoother& smoother, LevelVectors& v,
                   ThreadPool& pool) {
  Recurrence recurrence(smoother);
  const float first = recurrence.residual();
  pool.run_pieces(A.num_rows(), 4 * kRowsPerPiece<N>, [&](int begin, int end, int) {
    for (std::ptrdiff_t k = std::ptrdiff_t{N} * begin; k < std::ptrdiff_t{N} * end; ++k) {
      v.x[k] = v.d[k] = first * v.r[k];
    }
  });
  for (int k = 1; k < smoother.degree; ++k) {
    recurrence.advance();
    step(A, recurrence.previous(), recurrence.residual(), false, v, pool);
  }
  pool.run_pieces(A.num_rows(), kRowsPerPiece<N>, [&](int begin, int end, int) {
    std::array<float, 8> sum;
    for (int i = begin; i < end; ++i) {
      row_product(A, i, v.d.data(), sum.data());
      const std::ptrdiff_t first_k = std::ptrdiff_t{N} * i;
      for (int c = 0; c < N; ++c) v.r[first_k + c] -= v.d[first_k + c] + sum[c];
    }
  });
}

template <int N>
void smooth_after(const BlockRows<N>& A, const ChebyshevSmoother& smoother, LevelVectors& v,
                  ThreadPool& pool) {
  Recurrence recurrence(smoother);
  step(A, 0.0F, recurrence.residual(), true, v, pool);
  for (int k = 1; k < smoother.degree; ++k) {
    recurrence.advance();
    step(A, recurrence.previous(), recurrence.residual(), false, v, pool);
  }
}

template LargestEigenvalue largest_eigenvalue(const BlockRows<3>&, ThreadPool&);
template LargestEigenvalue largest_eigenvalue(const BlockRows<6>&, ThreadPool&);
template void smooth_before(const BlockRows<3>&, const ChebyshevSmoother&, LevelVectors&,
                            ThreadPool&);
template void smooth_before(const BlockRows<6>&, const ChebyshevSmoother&, LevelVectors&,
                            ThreadPool&);
template void smooth_after(const BlockRows<3>&, const ChebyshevSmoother&, LevelVectors&,
                           ThreadPool&);
template void smooth_after(const BlockRows<6>&, const ChebyshevSmoother&, LevelVectors&,
                           ThreadPool&);

}  // namespace articular::fem
