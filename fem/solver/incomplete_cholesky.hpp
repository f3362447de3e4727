#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/sparse/lower_blocks.hpp"

namespace articular::fem {

/// L D Lᵀ ≈ A with blocks where A has them and nowhere else [Saad 2003, ch. 10.3]: a
/// preconditioner for conjugate gradients, in single precision, which needs a third of the
/// iterations of block Jacobi, each of which takes twice as long.
///
/// A factor of a positive definite A without its fill need not be positive definite. What is
/// factored is A + s blockdiag(A) with the smallest shift s of a geometric row for which it is
/// [Manteuffel 1980]; contact asks for some hundredths. Pivots raised one by one instead make
/// triangular solutions grow without bound.
///
/// [Saad 2003] Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. SIAM.
/// [Manteuffel 1980] Manteuffel. An incomplete factorization technique for positive definite linear
/// systems. Mathematics of Computation 34.
class IncompleteCholesky {
 public:
  /// Begins with the shift that the last matrix took, or the one below it.
  /// @return false where no shift up to 1 will do; then nothing can be solved
  [[nodiscard]] bool factorize(const LowerBlocks& A);
  /// z = (L D Lᵀ)⁻¹ r
  void solve(const Eigen::VectorXd& r, Eigen::VectorXd& z);
  double shift() const;

 private:
  using Mat3f = Eigen::Matrix3f;

  bool factorize(const LowerBlocks& A, double shift);
  void solve_lower();
  void solve_upper();

  std::vector<int> row_begin_, column_;  // as of A
  std::vector<float> below_;             // L below its diagonal of identities: 9 a block, padded
  std::vector<Mat3f> inverse_pivot_;     // D⁻¹
  Eigen::VectorXf work_;
  std::size_t level_ = 0;  // of the shifts
  // While factoring:
  std::vector<Mat3> scaled_, lower_, inverse_;  // L D, L and D⁻¹
  std::vector<int> slot_of_column_;             // of the row at hand; -1: none
};

}  // namespace articular::fem
