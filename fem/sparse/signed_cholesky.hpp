#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

namespace articular::fem {

/// A symmetric matrix of numbers: the upper half in compressed columns, rows ascending in each.
struct SymmetricMatrix {
  std::vector<int> begin;  // size() + 1
  std::vector<int> row;    // ≤ its column
  std::vector<double> value;

  int size() const { return static_cast<int>(begin.size()) - 1; }
  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
};

/// L S Lᵀ of a sparse symmetric matrix, S = diag(±1) with signs known before. Such a factorization
/// exists in every order of the unknowns where the matrix is quasi-definite [Vanderbei 1995], that
/// is [K G; Gᵀ −A] with positive definite K and A: pivots need no search, and the fill-reducing
/// order and the dense blocks (BLAS) of a Cholesky factorization serve. With all signs + it is one.
///
/// [Vanderbei 1995] Vanderbei. Symmetric quasidefinite matrices. SIAM J. Optim. 5:100.
class SignedCholesky {
 public:
  SignedCholesky();
  ~SignedCholesky();
  SignedCholesky(SignedCholesky&&) noexcept;
  SignedCholesky& operator=(SignedCholesky&&) noexcept;

  /// Orders the unknowns and finds the pattern of L.
  /// @param signs  +1 or −1, one an unknown
  void analyze(const SymmetricMatrix& A, std::span<const int> signs);
  /// For values in the pattern of analyze().
  /// @return false where a pivot has the wrong sign or is not finite: not quasi-definite
  [[nodiscard]] bool factorize(const SymmetricMatrix& A);
  /// x ← A⁻¹ x
  void solve(Eigen::VectorXd& x) const;
  /// Entries of L, those of its dense blocks included.
  std::size_t num_nonzeros() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace articular::fem
