#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fem/solver/linear_solver.hpp"
#include "fem/solver/mixed_preconditioner.hpp"
#include "fem/solver/mixed_system.hpp"

namespace articular::benchmarks {

/// What multigrid with a nodal pressure is compared with: MINRES [Paige, Saunders 1975; Elman,
/// Silvester, Wathen 2014, algorithm 4.1] on the mixed system, with the same multigrid cycle and
/// the same diagonal for the pressures, but block diagonal, as MINRES asks for.
///
/// [Paige, Saunders 1975] Solution of Sparse Indefinite Systems of Linear Equations. SIAM Journal
/// on Numerical Analysis 12. [Elman, Silvester, Wathen 2014] Finite Elements and Fast Iterative
/// Solvers, 2nd ed. Oxford.
class BlockMinres {
 public:
  [[nodiscard]] bool prepare(const fem::BlockMatrix& A, const Positions& x,
                             const fem::PressurePart& part) {
    if (!system_.set(A, part.terms, pool_) || !preconditioner_.set_matrix(*part.plain, pool_)) {
      return false;
    }
    preconditioner_.set_pressures(system_);
    return preconditioner_.build(x, pool_);
  }

  fem::SolveReport solve(double tolerance, int max_iterations, const Eigen::VectorXd& b,
                         Eigen::VectorXd& x) {
    n_ = b.size();
    const Eigen::Index size = n_ + system_.num_pressures();
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(size), v = solution, v_before = solution,
                    w = solution, w_before = solution, q, z, residual;
    v.head(n_) = b;
    precondition(v, z);
    double gamma = std::sqrt(z.dot(v)), gamma_before = 1, eta = gamma;
    double s = 0, s_before = 0, c = 1, c_before = 1;
    double target = tolerance * gamma;
    fem::SolveReport report;
    report.converged = false;
    while (report.iterations < max_iterations && !report.converged) {
      z /= gamma;
      multiply(z, q);
      const double delta = q.dot(z);
      const Eigen::VectorXd v_next = q - (delta / gamma) * v - (gamma / gamma_before) * v_before;
      v_before = v;
      v = v_next;
      const Eigen::VectorXd direction = z;
      precondition(v, z);
      const double gamma_next = std::sqrt(z.dot(v));
      const double a0 = c * delta - c_before * s * gamma, a1 = std::hypot(a0, gamma_next),
                   a2 = s * delta + c_before * c * gamma, a3 = s_before * gamma;
      c_before = c;
      s_before = s;
      c = a0 / a1;
      s = gamma_next / a1;
      const Eigen::VectorXd w_next = (direction - a3 * w_before - a2 * w) / a1;
      w_before = w;
      w = w_next;
      solution += c * eta * w;
      eta *= -s;
      gamma_before = gamma;
      gamma = gamma_next;
      ++report.iterations;
      if (std::abs(eta) > target && report.iterations < max_iterations) continue;
      x = solution.head(n_);
      report.relative_residual = system_.condensed_residual(b, x, residual, pool_) / b.norm();
      report.converged = report.relative_residual <= tolerance;
      target = 0.7 * std::abs(eta) * std::min(1.0, tolerance / report.relative_residual);
    }
    return report;
  }

 private:
  void multiply(const Eigen::VectorXd& z, Eigen::VectorXd& y) {
    y.resize(z.size());
    u_ = z.head(n_);
    p_ = z.tail(z.size() - n_);
    system_.forces(u_, p_, f_, pool_);
    system_.changes_of_volume(u_, q_);
    system_.subtract_compliance(p_, q_);
    y << f_, q_;
  }

  void precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
    z.resize(r.size());
    u_ = r.head(n_);
    q_ = -r.tail(r.size() - n_);
    preconditioner_.displacements(u_, true, z_u_, pool_);
    preconditioner_.pressures(q_, Eigen::VectorXd::Zero(q_.size()), z_p_);
    z << z_u_.cast<double>(), z_p_.cast<double>();
  }

  ThreadPool pool_{1};
  fem::MixedSystem system_;
  fem::MixedPreconditioner preconditioner_;
  Eigen::Index n_ = 0;
  Eigen::VectorXd u_, p_, f_, q_;
  Eigen::VectorXf z_u_, z_p_;
};

}  // namespace articular::benchmarks
