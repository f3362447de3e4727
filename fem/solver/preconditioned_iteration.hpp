#pragma once

#include <Eigen/Core>
#include <limits>

#include "fem/solver/linear_solver.hpp"

namespace articular::fem {

/// Vectors of preconditioned_iteration(), kept between solutions.
struct IterationMemory {
  Eigen::VectorXd r, z, p, q;

  void resize(Eigen::Index n) {
    for (Eigen::VectorXd* v : {&r, &z, &p, &q}) v->resize(n);
  }
};

/// Preconditioned conjugate gradients [Saad 2003, algorithm 9.1] for A x = b.
///
/// The residual of the recurrence drifts from b − A x by round-off: where it says that the goal is
/// reached, b − A x is computed, and if it is not below the goal, the iteration starts anew from x.
///
/// @param multiply      multiply(x, y): y = A x
/// @param precondition  precondition(r, z): z = M⁻¹ r
/// @param x             start value on entry, solution on exit
///
/// [Saad 2003] Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. SIAM.
template <class Multiply, class Precondition>
SolveReport preconditioned_iteration(const Multiply& multiply, const Precondition& precondition,
                                     double tolerance, int max_iterations, const Eigen::VectorXd& b,
                                     Eigen::VectorXd& x, IterationMemory& memory) {
  Eigen::VectorXd &r = memory.r, &z = memory.z, &p = memory.p, &q = memory.q;
  SolveReport report;
  const double b_norm = b.norm();
  if (b_norm == 0 || x.size() != b.size()) x.setZero(b.size());
  if (b_norm == 0) return report;

  // From the residual r until its norm is below the goal or the iterations are used up.
  // Returns false where A proves not to be positive definite.
  const auto iterate = [&] {
    precondition(r, z);
    double rz = r.dot(z);
    p = z;
    while (report.iterations < max_iterations) {
      multiply(p, q);
      const double curvature = p.dot(q);
      if (!(curvature > 0)) return false;  // NaN included
      const double alpha = rz / curvature;
      x += alpha * p;
      r -= alpha * q;
      ++report.iterations;
      if (r.norm() <= tolerance * b_norm) return true;
      precondition(r, z);
      const double rz_next = r.dot(z);
      p = z + (rz_next / rz) * p;
      rz = rz_next;
    }
    return true;
  };

  report.relative_residual = std::numeric_limits<double>::infinity();
  while (true) {
    if (x.isZero(0)) {
      r = b;
    } else {
      multiply(x, q);
      r = b - q;
    }
    const double residual = r.norm() / b_norm;
    const bool stagnates = !(residual < 0.5 * report.relative_residual);  // true for NaN
    report.relative_residual = residual;
    report.converged = residual <= tolerance;
    if (report.converged || stagnates || report.iterations >= max_iterations) return report;
    if (!iterate()) {
      report.is_indefinite = true;
      return report;
    }
  }
}

}  // namespace articular::fem
