#pragma once

#include <Eigen/Core>
#include <vector>

namespace articular::fem {

/// The space of directions of flexible GMRES [Saad 1993]: among their sums, the one that leaves the
/// smallest residual of a linear system. The matrix need not be symmetric or definite, and the
/// preconditioner may change from step to step. Directions are kept in single precision: what the
/// matrix is multiplied by must be the rounded one.
///
/// [Saad 1993] Saad. A Flexible Inner-Outer Preconditioned GMRES Algorithm. SIAM Journal on
/// Scientific Computing 14(2).
class FlexibleGmres {
 public:
  /// Forgets all directions. @param r  the residual, not zero
  /// @param most  directions
  void start(const Eigen::VectorXd& r, int most);
  int size() const { return static_cast<int>(directions_.size()); }
  bool is_full() const { return size() == most_; }
  /// What the next direction is the preconditioned form of: orthogonal to all before, of norm 1.
  const Eigen::VectorXd& next() const { return basis_.back(); }
  /// @param w  matrix times z; used up
  /// @return the norm of the residual that the best sum leaves; NaN where the matrix is not finite
  double add(const Eigen::VectorXf& z, Eigen::VectorXd& w);
  /// No further direction can lower the residual.
  bool is_exhausted() const { return exhausted_; }
  /// The best sum's first entries, as many as x has, added to x.
  void add_best_to(Eigen::VectorXd& x) const;

 private:
  int most_ = 0;
  bool exhausted_ = false;
  std::vector<Eigen::VectorXd> basis_;
  std::vector<Eigen::VectorXf> directions_;
  Eigen::MatrixXd R_;                  // of the QR decomposition of the Hessenberg matrix
  Eigen::VectorXd cosine_, sine_, g_;  // its rotations, and what they make of the residual
};

}  // namespace articular::fem
