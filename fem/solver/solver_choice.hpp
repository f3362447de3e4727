#pragma once

#include <memory>

#include "fem/solver/linear_solver.hpp"

namespace articular::fem {

/// What is known of the linear systems of a simulation before the first one.
struct SolverProblem {
  int num_blocks = 0;          // of the matrix
  int num_nodes = 0;           // of these, nodes of tissue: the others are bones, say
  bool in_time = false;        // each system follows from the last, with a mass in it
  bool has_pressure = false;   // terms of a nodal pressure: prepare_with_pressure()
  bool has_contact = false;    // couplings come and go, and with them the pattern
  bool has_friction = false;   // each system is solved for several right sides
  double largest_nu = 0;       // Poisson's ratio [-] of the least compressible tissue
  double elements_a_step = 0;  // in time: how far waves of pressure travel, in elements [-]
  /// How far it is from a force to what holds the tissue, in elements, times how slender the way is
  /// [-]: what iterations without a coarse level grow with. A cube held at a side: cells along it.
  double reach = 10;
  double along = 10;  // the longest side of the tissue, in elements [-]
  /// Twice the volume by the surface, of the thickest tissue, in elements [-]: those across a
  /// layer, a third of those along a cube.
  double thickness = 10;
  bool is_held = true;  // all tissue is tied to what does not move freely
};

enum class SolverKind { Cholesky, SaddlePoint, ConjugateGradients, Multigrid };

struct SolverChoice {
  SolverKind kind = SolverKind::Cholesky;
  int num_kept = 0;         // solutions to start from, see make_projected_start(); 0: none
  const char* reason = "";  // for users
};

/// The solver that is the fastest, or takes at most about a fifth longer, on what `solver_speed
/// choice` measures (fem/RESULTS.md).
SolverChoice choose_solver(const SolverProblem& problem);

/// @param tolerance  on |r| / |b|; a direct solver does without
/// @param pool       of multigrid; the others have one thread
/// @throws std::invalid_argument as the solvers do
std::unique_ptr<LinearSolver> make_linear_solver(
    const SolverChoice& choice, double tolerance, int max_iterations,
    std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1));

}  // namespace articular::fem
