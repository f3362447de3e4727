#include "fem/solver/solver_choice.hpp"

#include <algorithm>
#include <utility>

namespace articular::fem {
namespace {

// Below, in blocks, a factorization costs less than anything else.
constexpr int kFewBlocks = 60;
// Plain tetrahedra lock from about here on, and multigrid with them: up to so many blocks it is
// better to factor.
constexpr double kLocked = 0.4985, kVeryLocked = 0.49985;
constexpr int kMostFactored = 2'000, kMostFactoredVeryLocked = 10'000;
// Compressible tissue in small steps: below so many blocks block Jacobi is as good as multigrid,
// and cheaper. A nodal pressure, which it converges with at any rate, shifts that.
constexpr double kCompressible = 0.4;
constexpr int kFewForMultigrid = 300, kFewWithPressure = 250, kFewCompressible = 6'000;
// So few blocks are soon factored: those of a slender or flat body, and of nearly incompressible
// tissue in contact.
constexpr int kFewAndFar = 500;
constexpr int kStartFrom = 5;  // solutions

// With contact the pattern changes again and again, and multigrid is set up anew each time. A
// factorization then costs less up to so many blocks; beyond, so do conjugate gradients, whose
// iterations grow with the way of waves in a step. They start from earlier solutions: at rest one
// step is like the other, whatever the pattern. Where steps are so long that mass says little,
// or there is none, contact may take multigrid a hundred iterations (the knee at 1000 N), and a
// factorization never does.
constexpr int kMostFactoredInContact = 2'500, kMostFactoredAtRest = 6'000;
// Factors of layers of so few elements between bones that move, as in a knee, grow with n^1.4 only
// (sim/RESULTS.md, one large knee). An iteration of Newton takes a third of the time with them that
// it takes with multigrid at 11,000 blocks, and as long at 34,000.
constexpr double kThin = 6;
constexpr int kMostFactoredThin = 40'000;
// Tissue that contact holds all over takes block Jacobi some hundred iterations, but for that of
// higher Poisson's ratios. Along it they grow with the elements, as do the columns of a factor,
// each of which costs the square of the blocks across: from such ratios on iterations cost less.
// Pressures make factors several times as large.
constexpr double kWide = 100, kWideWithPressure = 20;
constexpr double kShortWay = 40;

// Block Jacobi passes on what happens by one element in an iteration. From so many elements on
// everything else is several times as fast, and up to so few nothing is faster at any size below
// such a Poisson's ratio. Between them the size decides; with contact, what is tied to something
// fixed and not far from it is still block Jacobi's, but for friction, which asks for several
// solutions with each matrix. In steps in which waves get no farther than kStep it is block
// Jacobi's whatever holds it.
constexpr double kFar = 25, kNear = 6, kNearOfMany = 9, kStep = 3, kNearlyIncompressible = 0.47;
// Nearly incompressible tissue in contact takes block Jacobi several times as many iterations,
// unless mass helps: in steps in which waves get no farther than kStepOfMass.
constexpr double kNearInContact = 8, kStepOfMass = 100;
constexpr int kManyNear = 1'000;

/// How far that is: in a step no farther than waves travel.
double way(const SolverProblem& problem) {
  return problem.in_time ? std::min(problem.reach, problem.elements_a_step) : problem.reach;
}

/// Of tissue that is tied to what stands or is driven, and to no bone that moves by itself.
bool is_held(const SolverProblem& problem) {
  return problem.is_held && problem.num_nodes == problem.num_blocks;
}

/// Square of the blocks across it by the elements along it.
double wideness(const SolverProblem& problem) {
  const double across = problem.num_blocks / problem.along;
  return across * across / problem.along;
}

bool is_held_within(double elements, const SolverProblem& problem) {
  return is_held(problem) && way(problem) < elements;
}

bool is_nearly_incompressible(const SolverProblem& problem) {
  return problem.largest_nu >= kNearlyIncompressible;
}

/// That factors of it, with contact, cost more than iterations.
bool is_wide(const SolverProblem& problem) {
  if (!is_nearly_incompressible(problem)) {
    return wideness(problem) > (problem.has_pressure ? kWideWithPressure : kWide);
  }
  return problem.has_pressure && problem.reach > kFar && wideness(problem) > kWide;  // a plate
}

/// Elements up to which what holds it is near enough for iterations with contact.
double near_in_contact(const SolverProblem& problem) {
  const bool mass_helps = problem.in_time && problem.elements_a_step < kStepOfMass;
  if (mass_helps || !is_nearly_incompressible(problem)) return kFar;
  return !problem.in_time && problem.num_blocks < kFewAndFar ? 0 : kNearInContact;
}

int most_factored_in_contact(const SolverProblem& problem, bool short_steps) {
  if (short_steps) return kMostFactoredInContact;
  const bool is_thin = !problem.in_time && !is_held(problem) && problem.thickness <= kThin;
  return is_thin ? kMostFactoredThin : kMostFactoredAtRest;
}

SolverChoice choose_with_contact(const SolverProblem& problem) {
  if (!problem.has_friction && is_held_within(near_in_contact(problem), problem)) {
    return {
        SolverKind::ConjugateGradients, 0,
        "contact changes the matrix, and what holds the tissue is near: nothing needs to be set "
        "up"};
  }
  if (!problem.has_friction && is_held(problem) && is_wide(problem) &&
      problem.num_blocks <= kMostFactoredAtRest) {
    return {SolverKind::ConjugateGradients, 0,
            "contact changes the matrix and holds the tissue all over: nothing needs to be set up"};
  }
  const bool short_steps = problem.in_time && problem.elements_a_step < kShortWay;
  if (problem.num_blocks <= most_factored_in_contact(problem, short_steps)) {
    return {problem.has_pressure ? SolverKind::SaddlePoint : SolverKind::Cholesky, 0,
            problem.num_blocks <= kMostFactoredAtRest
                ? "contact changes the matrix, and so few unknowns are soon factored"
                : "contact changes the matrix, and thin tissue is soon factored"};
  }
  if (short_steps) {
    return {SolverKind::ConjugateGradients, kStartFrom,
            "contact changes the matrix, and steps are short: little needs to be set up"};
  }
  return {SolverKind::Multigrid, 0, "multigrid: iterations do not depend on the size"};
}

bool is_for_block_jacobi(const SolverProblem& problem) {
  if (way(problem) > kFar) return false;
  if (problem.in_time && way(problem) < kStep) return true;
  const bool is_large = problem.has_pressure && problem.num_blocks >= kManyNear;
  const double near = is_large ? kNearOfMany : kNear;
  if (!is_nearly_incompressible(problem) && problem.reach < near && is_held_within(near, problem)) {
    return true;
  }
  if (!problem.has_pressure) {
    return problem.largest_nu < kCompressible && problem.num_blocks < kFewForMultigrid;
  }
  if (!problem.in_time) {
    return problem.largest_nu < kCompressible && problem.num_blocks < kFewForMultigrid;
  }
  return problem.num_blocks <
         (problem.largest_nu < kCompressible ? kFewCompressible : kFewWithPressure);
}

bool is_for_factors(const SolverProblem& problem) {
  const int most = problem.largest_nu >= kVeryLocked ? kMostFactoredVeryLocked : kMostFactored;
  return problem.largest_nu >= kLocked && problem.num_blocks <= most;
}

}  // namespace

SolverChoice choose_solver(const SolverProblem& problem) {
  const int kept = problem.in_time ? kStartFrom : 0;
  if (problem.num_blocks <= kFewBlocks && !problem.has_pressure) {
    return {SolverKind::Cholesky, 0, "few unknowns: a factorization costs next to nothing"};
  }
  if (problem.has_contact) return choose_with_contact(problem);
  if (2 * problem.num_nodes < problem.num_blocks) {
    return {SolverKind::ConjugateGradients, kept,
            "most unknowns are no nodes of tissue, and multigrid coarsens those"};
  }
  if (is_for_block_jacobi(problem)) {
    return {SolverKind::ConjugateGradients, kept,
            "too few unknowns, or too short ways, for what a cycle of multigrid costs"};
  }
  if (problem.num_blocks < kFewAndFar && way(problem) > kFar) {
    return {problem.has_pressure ? SolverKind::SaddlePoint : SolverKind::Cholesky, 0,
            "a slender or flat body of few unknowns is soon factored"};
  }
  if (problem.has_pressure) {
    return {SolverKind::Multigrid, kept,
            "multigrid: iterations depend neither on the size nor on the bulk modulus"};
  }
  if (is_for_factors(problem)) {
    return {SolverKind::Cholesky, 0,
            "plain tetrahedra lock that near to nu = 0.5, and so do iterations"};
  }
  return {SolverKind::Multigrid, kept, "multigrid: iterations do not depend on the size"};
}

std::unique_ptr<LinearSolver> make_linear_solver(const SolverChoice& choice, double tolerance,
                                                 int max_iterations,
                                                 std::shared_ptr<ThreadPool> pool) {
  std::unique_ptr<LinearSolver> solver;
  switch (choice.kind) {
    case SolverKind::Cholesky:
      return make_cholesky(std::move(pool));
    case SolverKind::SaddlePoint:
      solver = make_saddle_point_solver(tolerance, max_iterations, std::move(pool));
      break;
    case SolverKind::ConjugateGradients:
      solver = make_conjugate_gradients(tolerance, max_iterations, std::move(pool));
      break;
    case SolverKind::Multigrid:
      solver = make_multigrid(tolerance, max_iterations, std::move(pool));
      break;
  }
  if (choice.num_kept == 0) return solver;
  return make_projected_start(std::move(solver), choice.num_kept);
}

}  // namespace articular::fem
