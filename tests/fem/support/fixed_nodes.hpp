#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <vector>

#include "fem/base/types.hpp"
#include "fem/solver/linear_solver.hpp"
#include "fem/sparse/block_matrix.hpp"

namespace articular::fem {

/// Solves K u = f for the free nodes, where fixed nodes keep the displacement they have in u: their
/// rows and columns become those of the identity.
inline void solve_with_fixed_nodes(BlockMatrix K, const Positions& f,
                                   const std::vector<bool>& fixed, Positions& u) {
  Positions u_fixed = Positions::Zero(3, u.cols());
  for (int i = 0; i < u.cols(); ++i) {
    if (fixed[i]) u_fixed.col(i) = u.col(i);
  }
  Eigen::VectorXd Ku, solution;
  K.multiply(u_fixed.reshaped(), Ku);
  Positions b = f - Positions(Ku.reshaped(3, u.cols()));
  for (int i = 0; i < u.cols(); ++i) {
    if (fixed[i]) b.col(i) = u.col(i);
    for (int s = K.row_begin()[i]; s < K.row_begin()[i + 1]; ++s) {
      const int j = K.column()[s];
      if (fixed[i] || fixed[j]) K.block(s) = i == j ? Mat3(Mat3::Identity()) : Mat3(Mat3::Zero());
    }
  }
  const auto solver = make_cholesky();
  if (solver->prepare(K) != FactorStatus::Ready) throw std::runtime_error("not positive definite");
  if (!solver->solve(b.reshaped(), solution).converged) throw std::runtime_error("no solution");
  u = solution.reshaped(3, u.cols());
}

}  // namespace articular::fem
