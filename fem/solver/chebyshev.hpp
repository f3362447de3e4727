#pragma once

#include <vector>

#include "fem/sparse/block_rows.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// Rows of a piece that a thread takes at once: about as much work for both sizes of blocks.
template <int N>
inline constexpr int kRowsPerPiece = N == 3 ? 512 : 64;

/// Largest eigenvalue of A: an estimate that is not below it, and a bound that can't be.
struct LargestEigenvalue {
  float likely_bound =
      1;                 // Ritz value plus its residual, of some Lanczos steps from a random start
  float sure_bound = 1;  // Gershgorin's, with norms of blocks
};

/// One Lanczos step costs one product. [Zhou, Li 2011] found no case in practice where the likely
/// bound is too low; where it is, r·z shows it.
///
/// [Zhou, Li 2011] Bounding the spectrum of large Hermitian matrices. Linear Algebra and its
/// Applications 435(3).
template <int N>
LargestEigenvalue largest_eigenvalue(const BlockRows<N>& A, ThreadPool& pool);

/// Chebyshev's polynomial of degree `degree` in A as a smoother [Adams et al. 2003; recurrence of
/// Saad 2003, algorithm 12.1], for a matrix with identities on its diagonal: the block-Jacobi
/// scaling is in A. Errors with eigenvalues in [low, high] shrink; up to low + high none grows, so
/// that a sweep before and one after the coarse correction are a positive definite preconditioner.
///
/// [Adams et al. 2003] Adams, Brezina, Hu, Tuminaro. Parallel multigrid smoothing: polynomial
/// versus Gauss-Seidel. Journal of Computational Physics 188. [Saad 2003] Saad. Iterative Methods
/// for Sparse Linear Systems, 2nd ed. SIAM.
struct ChebyshevSmoother {
  int degree = 3;
  float low = 0.05F, high = 1;
};

/// The vectors of one level, padded.
struct LevelVectors {
  std::vector<float> x, r, d, d_next;
};

/// The last piece of rows that each piece of kRowsPerPiece<N> rows is coupled to.
template <int N>
std::vector<int> reach_of_pieces(const BlockRows<N>& A);

/// From r and x = 0: x, and the residual that it leaves in r. With one thread, the products with A
/// that a sweep consists of follow each other through the rows as closely as `reach` allows, while
/// these are in the cache, instead of one product reading all of A after the other.
template <int N>
void smooth_before(const BlockRows<N>& A, const std::vector<int>& reach,
                   const ChebyshevSmoother& smoother, LevelVectors& v, ThreadPool& pool);

/// From x, its residual r and a correction of x in d: x corrected and smoothed. r is used up.
template <int N>
void smooth_after(const BlockRows<N>& A, const std::vector<int>& reach,
                  const ChebyshevSmoother& smoother, LevelVectors& v, ThreadPool& pool);

}  // namespace articular::fem
