#include "fem/solver/mixed_multigrid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace articular::fem {
namespace {

// Directions that are kept until the iteration starts anew: two vectors of all unknowns each.
constexpr int kMostDirections = 80;
// How much further than the last trial says is needed the estimate falls before the next one.
constexpr double kBetweenTrials = 0.7;

}  // namespace

FactorStatus MixedMultigrid::prepare(const BlockMatrix& A, const Positions& x,
                                     const PressurePart& part, ThreadPool& pool) {
  const BlockMatrix& near = part.plain != nullptr ? *part.plain : A;
  assert(near.num_blocks() == A.num_blocks());
  if (near.pattern_id() != near_pattern_) built_ = false;
  near_pattern_ = near.pattern_id();
  if (!system_.set(A, part.terms, pool) || !preconditioner_.set_matrix(near, pool)) {
    return FactorStatus::NotPositiveDefinite;
  }
  preconditioner_.set_pressures(system_);
  const bool same_nodes = x.cols() == x_.cols();
  x_ = x;
  if (!built_ || age_.is_too_old() || !same_nodes) {
    if (!build(pool)) return FactorStatus::NotPositiveDefinite;
  } else {
    preconditioner_.turn(x_, pool);
    is_current_ = false;
  }
  return FactorStatus::Ready;
}

bool MixedMultigrid::build(ThreadPool& pool) {
  built_ = is_current_ = preconditioner_.build(x_, pool);
  sure_bounds_ = false;
  age_.restart();
  return built_;
}

void MixedMultigrid::repair(Outcome outcome, ThreadPool& pool) {
  repaired_ = true;
  if (outcome == Outcome::TooOld || !is_current_) {
    if (!build(pool)) use_cycle_ = false;
  } else if (!sure_bounds_) {
    preconditioner_.use_sure_bounds();
    sure_bounds_ = true;
  } else {
    use_cycle_ = false;
  }
}

SolveReport MixedMultigrid::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, ThreadPool& pool) {
  const SolveReport report = iterate_and_repair(b, x, pool);
  if (!report.converged) built_ = false;  // a preconditioner that failed is not kept
  return report;
}

SolveReport MixedMultigrid::iterate_and_repair(const Eigen::VectorXd& b, Eigen::VectorXd& x,
                                               ThreadPool& pool) {
  SolveReport report;
  const double b_norm = b.norm();
  if (b_norm == 0 || x.size() != b.size()) x.setZero(b.size());
  if (b_norm == 0) return report;

  use_cycle_ = true;
  repaired_ = false;
  report.relative_residual = system_.condensed_residual(b, x, r_, pool) / b_norm;
  while (true) {
    report.converged = report.relative_residual <= tolerance_;
    if (report.converged || report.iterations >= max_iterations_) return report;
    repaired_ = false;
    const double before = report.relative_residual;
    const Outcome outcome = iterate(tolerance_ * b_norm, b, x, report, pool);
    if (outcome == Outcome::Indefinite) return report;
    // NaN included. A space that did not help is not helped by another one.
    const bool stagnates = !(report.relative_residual < 0.9 * before);
    if (outcome != Outcome::Ended) {
      ++report.repairs;
      repair(outcome, pool);
    } else if (stagnates) {
      report.converged = report.relative_residual <= tolerance_;
      return report;
    }
  }
}

/// From the residual r_ of x to that of the best sum of the directions found.
MixedMultigrid::Outcome MixedMultigrid::iterate(double goal, const Eigen::VectorXd& b,
                                                Eigen::VectorXd& x, SolveReport& report,
                                                ThreadPool& pool) {
  const Eigen::Index n = r_.size();
  const double first_norm = r_.norm(), b_norm = b.norm();
  const int first = report.iterations;
  const bool is_old = use_cycle_ && !is_current_;
  const int patience =
      is_old && !age_.is_new() ? age_.patience(first_norm / goal) : max_iterations_;
  extended_.setZero(n + system_.num_pressures());
  extended_.head(n) = r_;
  gmres_.start(extended_, std::min(kMostDirections, max_iterations_ - first));
  Outcome outcome = Outcome::Ended;
  double target = goal;
  while (true) {
    next_r_ = gmres_.next().head(n);
    next_q_ =
        gmres_.next().tail(system_.num_pressures()).cwiseQuotient(preconditioner_.row_scale());
    const double rz = preconditioner_.displacements(next_r_, use_cycle_, z_u_, pool);
    if (!(rz > 0)) {
      outcome = Outcome::Unfit;  // NaN included
      break;
    }
    u_ = z_u_.cast<double>();
    system_.changes_of_volume(u_, q_x_);
    preconditioner_.pressures(next_q_, q_x_, z_p_);
    p_ = z_p_.cast<double>();
    w_.resize(extended_.size());
    system_.forces(u_, p_, trial_, pool);
    w_.head(n) = trial_;
    system_.subtract_compliance(p_, q_x_);
    w_.tail(q_x_.size()) = q_x_.cwiseProduct(preconditioner_.row_scale());
    const double estimate = gmres_.add(z_u_, w_);
    ++report.iterations;
    const bool must_end = gmres_.is_full() || gmres_.is_exhausted() || !std::isfinite(estimate);
    // To fill the space of directions costs more than to build anew.
    const bool too_old = report.iterations - first >= patience || (is_old && must_end);
    if (estimate > target && !must_end && !too_old) continue;
    trial_ = x;
    gmres_.add_best_to(trial_);
    const double norm = system_.condensed_residual(b, trial_, next_r_, pool);
    if (norm > goal && !must_end && !too_old) {
      target = kBetweenTrials * estimate * std::min(1.0, goal / norm);
      continue;
    }
    // d·S d of the step d, as S d is the change of the residual. NaN included.
    if (!((trial_ - x).dot(r_ - next_r_) > 0)) return Outcome::Indefinite;
    if (norm > goal && too_old) outcome = Outcome::TooOld;
    if (norm < first_norm) {
      x = trial_;
      r_ = next_r_;
      report.relative_residual = norm / b_norm;
    }
    if (use_cycle_ && norm > 0 && norm <= goal) {
      age_.add(report.iterations - first, first_norm / norm);
    }
    return outcome;
  }
  return outcome;
}

}  // namespace articular::fem
