#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/sparse/mirrored_matrix.hpp"
#include "fem/sparse/pressure_term.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// S = A + Σ scale G C⁻¹ Gᵀ and what it condenses, with a pressure for each row of each C:
///
///   [A  G      ] [x]   [r]                 r and x: 3 a block [N], [m]
///   [Gᵀ −C/scale] [p] = [q]                q and p: one a pressure, terms one after the other
///
/// Nothing of it is inverted but C where a residual of S itself is asked for.
class MixedSystem {
 public:
  /// Views of `terms` stay. @return false where a value of A is not finite
  [[nodiscard]] bool set(const BlockMatrix& A, std::span<const PressureTerm> terms,
                         ThreadPool& pool);
  int num_blocks() const { return A_.num_rows(); }
  int num_pressures() const { return begin_.back(); }
  std::span<const PressureTerm> terms() const { return terms_; }
  /// The first pressure of term t.
  int begin(std::size_t t) const { return begin_[t]; }

  /// q = Gᵀ x
  void changes_of_volume(const Eigen::VectorXd& x, Eigen::VectorXd& q) const;
  /// r = A x + G p
  void forces(const Eigen::VectorXd& x, const Eigen::VectorXd& p, Eigen::VectorXd& r,
              ThreadPool& pool) const;
  /// q −= C/scale p
  void subtract_compliance(const Eigen::VectorXd& p, Eigen::VectorXd& q) const;
  /// r = b − S x. @return its norm
  double condensed_residual(const Eigen::VectorXd& b, const Eigen::VectorXd& x, Eigen::VectorXd& r,
                            ThreadPool& pool);

 private:
  MirroredMatrix A_;
  std::vector<PressureTerm> terms_;
  std::vector<int> begin_{0};  // of the pressures of each term, and their number
  PressureOperator condensed_;
  mutable Eigen::VectorXd p_, q_;  // of one term
};

}  // namespace articular::fem
