#pragma once

#include <array>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::benchmarks {

/// Processor time of the parts of one step [ms].
struct BeamTimes {
  double assembly = 0;  // right-hand side, internal force and matrix
  double prepare = 0;   // of the solver
  double solve = 0;
  double total() const { return assembly + prepare + solve; }
};

/// A cantilever of corotated tetrahedra under its own weight: 1 x 0.2 x 0.2 m, clamped at x = 0,
/// E = 1 MPa, ν = 0.45, 1000 kg/m³, lumped mass. Implicit Euler with one linear solve a step:
///
///   (M + h² K) δv = h (f_ext − f_int) − h² K v,   v += δv,   x += h v,   h = 0.01 s
///
/// Clamped nodes are no unknowns: the stiffness goes straight to the matrix of the others.
class Beam {
 public:
  static constexpr double kE = 1e6, kNu = 0.45;  // [Pa], [-]

  explicit Beam(const std::array<int, 3>& cells);

  void rest();  // back to the start
  /// @throws std::runtime_error where the solver fails
  BeamTimes step(fem::LinearSolver& solver);

  int num_tets() const { return elasticity_.num_elements(); }
  int num_unknowns() const { return 3 * A_.num_blocks(); }
  const fem::Elasticity& elasticity() const { return elasticity_; }
  const Positions& X() const { return mesh_.X; }
  const Positions& x() const { return x_; }
  const fem::BlockMatrix& matrix() const { return A_; }  // of the last step
  double tip_displacement() const;                       // mean over the end section, in y [m]
  int iterations() const { return iterations_; }         // of all steps since rest
  /// Elasticity with the slots of the matrix, not the matrix itself [bytes].
  double bytes_of_elasticity() const { return bytes_of_elasticity_; }

 private:
  void assemble();

  fem::TetMesh mesh_;
  std::vector<int> block_of_node_;  // -1: clamped
  fem::BlockMatrix A_;
  double bytes_before_;
  fem::Elasticity elasticity_;
  fem::StiffnessSlots slots_;
  double bytes_of_elasticity_;
  Positions x_, x_free_, f_int_;            // x_free_: of the blocks of the matrix
  Eigen::VectorXd v_, dv_, b_, Av_, mass_;  // of the unknowns; mass [kg] one a node
  int iterations_ = 0;
};

}  // namespace articular::benchmarks
