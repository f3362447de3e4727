#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>

#include "fem/sparse/symmetric_matrix.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// What the pivots of a factorization say. Wrong: a sign is, so the matrix is not quasi-definite.
/// Unclear: in single precision, a sign may be wrong by round-off alone.
enum class Pivots { Right, Unclear, Wrong };

/// L S Lᵀ of a sparse symmetric matrix, S = diag(±1) with signs known before. Such a factorization
/// exists in every order of the unknowns where the matrix is quasi-definite [Vanderbei 1995], that
/// is [K G; Gᵀ −A] with positive definite K and A: pivots need no search, and the fill-reducing
/// order and the dense blocks (BLAS) of a Cholesky factorization serve. With all signs + it is one.
///
/// Subtrees of the elimination tree are factored and solved side by side, then what lies above them
/// by levels and pieces of columns; the answer has the same bits with any number of threads.
///
/// @tparam Real  of L, float or double. The matrix is scaled first: the numbers of its diagonal
///               become 1/2 to 2, by powers of two. So any units of the unknowns will do.
///
/// [Vanderbei 1995] Vanderbei. Symmetric quasidefinite matrices. SIAM J. Optim. 5:100.
template <class Real>
class SignedCholesky {
 public:
  /// A solution with fewer entries of L is no work for several threads: they wait longer for what
  /// the others wrote than they compute (fem/RESULTS.md).
  static constexpr std::size_t kFewestToShare = 4'000'000;

  /// @param fewest_to_share  entries of L from which on solutions are shared by threads
  explicit SignedCholesky(std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1),
                          std::size_t fewest_to_share = kFewestToShare);
  ~SignedCholesky();
  SignedCholesky(SignedCholesky&&) noexcept;
  SignedCholesky& operator=(SignedCholesky&&) noexcept;

  /// Orders the unknowns and finds the pattern of L.
  /// @param signs  +1 or −1, one an unknown
  /// @param group  see find_supernodes()
  void analyze(const SymmetricMatrix& A, std::span<const int> signs,
               std::span<const int> group = {});
  /// For values in the pattern of analyze(). Solutions want Pivots::Right.
  [[nodiscard]] Pivots factorize(const SymmetricMatrix& A);
  /// x ← A⁻¹ x
  void solve(Eigen::VectorXd& x) const;
  /// Entries of L, those of its dense blocks included.
  std::size_t num_nonzeros() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  std::shared_ptr<ThreadPool> pool_;
  std::size_t fewest_to_share_;
};

extern template class SignedCholesky<float>;
extern template class SignedCholesky<double>;

}  // namespace articular::fem
