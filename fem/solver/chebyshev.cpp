#include "fem/solver/chebyshev.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

// The loops that take the time, once for each instruction set; clang can't do that to templates,
// and with the thread sanitizer what chooses among them would run before the sanitizer is there.
#if defined(__clang__) || defined(__SANITIZE_THREAD__)
#define CLONES
#else
#define CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#endif

namespace articular::fem {
namespace {

constexpr int kLanczosSteps = 10;

constexpr int kMostStages = 8;  // of a sweep: one more than the degree of the polynomial

/// Of one step of the recurrence d ← previous d + residual r, x ← x + d.
struct Coefficients {
  float previous = 0, residual = 0;
  bool add_d = false;  // the d before is not in x yet
};

std::array<Coefficients, kMostStages> coefficients(const ChebyshevSmoother& s) {
  assert(s.degree < kMostStages);
  const float center = 0.5F * (s.high + s.low), radius = 0.5F * (s.high - s.low);
  std::array<Coefficients, kMostStages> c;
  float rho = radius / center;
  c[0].residual = 1 / center;
  for (std::size_t k = 1; k < c.size(); ++k) {
    const float next = 1 / (2 * center / radius - rho);
    c[k].previous = next * rho;
    c[k].residual = 2 * next / radius;
    rho = next;
  }
  return c;
}

/// Rows [begin, end) of r ← r − A d; d_next = previous d + residual r; x ← x + d_next, and where d
/// was not in x yet, + d.
template <int N>
CLONES void step(const BlockRows<N>& A, int begin, int end, const Coefficients& c, LevelVectors& v,
                 const std::vector<float>& from, std::vector<float>& to) {
  const float keep = c.add_d ? 1.0F : 0.0F;
  float* r = v.r.data() + std::ptrdiff_t{N} * begin;
  const float* d = from.data() + std::ptrdiff_t{N} * begin;
  float* d_next = to.data() + std::ptrdiff_t{N} * begin;
  float* x = v.x.data() + std::ptrdiff_t{N} * begin;
  std::array<float, 8> sum;
  for (int i = begin; i < end; ++i, r += N, d += N, d_next += N, x += N) {
    row_product(A, i, from.data(), sum.data());
    for (int k = 0; k < N; ++k) {
      r[k] -= d[k] + sum[k];
      d_next[k] = c.previous * d[k] + c.residual * r[k];
      x[k] += d_next[k] + keep * d[k];
    }
  }
}

/// Rows [begin, end) of r ← r − A d.
template <int N>
CLONES void subtract_product(const BlockRows<N>& A, int begin, int end, const std::vector<float>& d,
                             std::vector<float>& r) {
  std::array<float, 8> sum;
  for (int i = begin; i < end; ++i) {
    row_product(A, i, d.data(), sum.data());
    const std::ptrdiff_t first = std::ptrdiff_t{N} * i;
    for (int k = 0; k < N; ++k) r[first + k] -= d[first + k] + sum[k];
  }
}

/// stage(s, begin, end) for s = 0 .. num_stages - 1 and all pieces of rows, where stage s of a
/// piece follows stage s − 1 of all pieces that it is coupled to. By one thread, stages follow each
/// other from piece to piece; by several, one stage ends before the next begins.
template <int N, class Stage>
void run_stages(int num_rows, const std::vector<int>& reach, int num_stages, ThreadPool& pool,
                const Stage& stage) {
  constexpr int kPiece = kRowsPerPiece<N>;
  if (pool.num_threads() > 1) {
    for (int s = 0; s < num_stages; ++s) {
      pool.run_pieces(num_rows, kPiece, [&](int begin, int end, int) { stage(s, begin, end); });
    }
    return;
  }
  const auto num_pieces = static_cast<int>(reach.size());
  const auto run = [&](int s, int piece) {
    stage(s, piece * kPiece, std::min(num_rows, (piece + 1) * kPiece));
  };
  std::array<int, kMostStages> done{};  // pieces, of each stage
  while (done[0] < num_pieces) {
    run(0, done[0]++);
    for (std::size_t s = 1; s < static_cast<std::size_t>(num_stages); ++s) {
      while (done[s] < num_pieces && reach[static_cast<std::size_t>(done[s])] < done[s - 1]) {
        run(static_cast<int>(s), done[s]++);
      }
    }
  }
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
std::vector<int> reach_of_pieces(const BlockRows<N>& A) {
  constexpr int kPiece = kRowsPerPiece<N>;
  std::vector<int> reach;
  for (int begin = 0; begin < A.num_rows(); begin += kPiece) {
    int last = begin / kPiece;
    for (int i = begin; i < std::min(A.num_rows(), begin + kPiece); ++i) {
      if (A.row_begin[i] < A.row_begin[i + 1]) {
        last = std::max(last, A.column[A.row_begin[i + 1] - 1] / kPiece);
      }
    }
    reach.push_back(last);
  }
  return reach;
}

// Stage s of a sweep reads d from one vector and writes the next to the other. All readers of what
// it writes over are coupled to it, and have been there before it.

template <int N>
void smooth_before(const BlockRows<N>& A, const std::vector<int>& reach,
                   const ChebyshevSmoother& smoother, LevelVectors& v, ThreadPool& pool) {
  const std::array<Coefficients, kMostStages> c = coefficients(smoother);
  const std::array<std::vector<float>*, 2> d{&v.d, &v.d_next};
  const int last = smoother.degree;
  run_stages<N>(A.num_rows(), reach, last + 1, pool, [&](int s, int begin, int end) {
    if (s == 0) {
      for (std::ptrdiff_t k = std::ptrdiff_t{N} * begin; k < std::ptrdiff_t{N} * end; ++k) {
        v.x[k] = v.d[k] = c[0].residual * v.r[k];
      }
    } else if (s < last) {
      step(A, begin, end, c[s], v, *d[(s - 1) % 2], *d[s % 2]);
    } else {
      subtract_product(A, begin, end, *d[(s - 1) % 2], v.r);
    }
  });
}

template <int N>
void smooth_after(const BlockRows<N>& A, const std::vector<int>& reach,
                  const ChebyshevSmoother& smoother, LevelVectors& v, ThreadPool& pool) {
  std::array<Coefficients, kMostStages> c = coefficients(smoother);
  c[0].add_d = true;
  const std::array<std::vector<float>*, 2> d{&v.d, &v.d_next};
  run_stages<N>(A.num_rows(), reach, smoother.degree, pool, [&](int s, int begin, int end) {
    step(A, begin, end, c[s], v, *d[s % 2], *d[(s + 1) % 2]);
  });
}

template std::vector<int> reach_of_pieces(const BlockRows<3>&);
template std::vector<int> reach_of_pieces(const BlockRows<6>&);
template LargestEigenvalue largest_eigenvalue(const BlockRows<3>&, ThreadPool&);
template LargestEigenvalue largest_eigenvalue(const BlockRows<6>&, ThreadPool&);
template void smooth_before(const BlockRows<3>&, const std::vector<int>&, const ChebyshevSmoother&,
                            LevelVectors&, ThreadPool&);
template void smooth_before(const BlockRows<6>&, const std::vector<int>&, const ChebyshevSmoother&,
                            LevelVectors&, ThreadPool&);
template void smooth_after(const BlockRows<3>&, const std::vector<int>&, const ChebyshevSmoother&,
                           LevelVectors&, ThreadPool&);
template void smooth_after(const BlockRows<6>&, const std::vector<int>&, const ChebyshevSmoother&,
                           LevelVectors&, ThreadPool&);

}  // namespace articular::fem
