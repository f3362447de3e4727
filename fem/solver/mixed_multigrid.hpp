#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "fem/solver/flexible_gmres.hpp"
#include "fem/solver/linear_solver.hpp"
#include "fem/solver/mixed_preconditioner.hpp"
#include "fem/solver/mixed_system.hpp"
#include "fem/solver/preconditioner_reuse.hpp"
#include "parallel/thread_pool.hpp"

namespace articular::fem {

/// What make_multigrid() does with the terms of a nodal pressure: flexible GMRES on the mixed
/// system, where pressures are unknowns and no bulk modulus makes rows steep, until the residual of
/// the condensed one is below the tolerance. What starts and ends is that residual: pressures are
/// those of the displacements, and only their corrections are unknowns of the iteration.
class MixedMultigrid {
 public:
  MixedMultigrid(double tolerance, int max_iterations)
      : tolerance_(tolerance), max_iterations_(max_iterations) {}

  [[nodiscard]] FactorStatus prepare(const BlockMatrix& A, const Positions& x,
                                     const PressurePart& part, ThreadPool& pool);
  [[nodiscard]] SolveReport solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, ThreadPool& pool);

 private:
  enum class Outcome {
    Ended,       // the space is full, the goal near, or the iterations are used up
    Indefinite,  // S is not positive definite
    Unfit,       // the preconditioner is not positive definite
    TooOld       // it takes so long that a new one pays
  };

  bool build(ThreadPool& pool);
  void repair(Outcome outcome, ThreadPool& pool);
  SolveReport iterate_and_repair(const Eigen::VectorXd& b, Eigen::VectorXd& x, ThreadPool& pool);
  Outcome iterate(double goal, const Eigen::VectorXd& b, Eigen::VectorXd& x, SolveReport& report,
                  ThreadPool& pool);

  double tolerance_;
  int max_iterations_;
  MixedSystem system_;
  MixedPreconditioner preconditioner_;
  FlexibleGmres gmres_;
  PreconditionerReuse age_;
  std::uint64_t near_pattern_ = 0;
  Positions x_;  // of the nodes, as of the last prepare()
  bool built_ = false;
  bool is_current_ = false;   // the preconditioner is that of the values
  bool sure_bounds_ = false;  // its eigenvalues are bounded by norms
  bool use_cycle_ = true;     // in this solve
  bool repaired_ = false;     // just now
  Eigen::VectorXd r_, extended_, next_r_, next_q_, q_x_, u_, p_, w_, trial_;
  Eigen::VectorXf z_u_, z_p_;
};

}  // namespace articular::fem
