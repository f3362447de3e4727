#pragma once

#include <array>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::benchmarks {

/// A unit cube of tissue between two plates that hold its ends z = 0 and z = 1, drawn apart by 30 %
/// in five steps of equal length, each of which ends in equilibrium. Isochoric neo-Hookean law, μ/2
/// (Ī1 − 3) + κ/2 (J − 1)², which CalculiX has as well (E = 1, ν = 0.45):
///
///     ===================  plate, moved by 0.3
///      )               (
///     (                 )   n x n x n cells of six plain linear tetrahedra
///     ===================
class StretchedCube {
 public:
  static constexpr double kE = 1, kNu = 0.45, kStretch = 0.3;
  static constexpr int kSteps = 5;

  struct Settings {
    /// Of a step: |r| of the free nodes, relative to |f| of the nodes on a plate.
    double residual = 1e-4;
    /// Of a correction: the smallest number of Newton iterations (1e-2 takes one more, or two).
    double linear_residual = 2e-3;
  };

  struct Report {
    std::array<double, kSteps> reaction{};  // of the plate at z = 1, at the end of each step
    double assembly = 0, set_up = 0, solution = 0, total = 0;  // [s] of processor time
    int newton_iterations = 0, linear_iterations = 0, cut_steps = 0;
  };

  explicit StretchedCube(int cells);

  /// All steps, by Newton's method with a multigrid solver.
  /// @throws std::runtime_error where it does not converge
  Report stretch(const Settings& settings);

  static fem::TetMesh make_mesh(int cells);
  static double shear_modulus();
  static double bulk_modulus();

 private:
  void predict(int step);
  void update_force();
  double residual() const;
  double plate_force() const;
  void iterate(fem::LinearSolver& solver, Report& report);
  void linear_solution(fem::LinearSolver& solver, Report& report);
  void search_along_line(Report& report);
  void move(const Positions& from, double part);

  fem::TetMesh mesh_;
  std::vector<int> block_of_node_;  // -1: held by a plate
  fem::Elasticity elasticity_;
  fem::BlockMatrix K_;  // of the free nodes
  fem::StiffnessSlots slots_;
  std::vector<Positions> reached_;  // at the ends of the steps, from rest
  Positions x_, f_, x_free_;
  Eigen::VectorXd b_, dx_;
};

}  // namespace articular::benchmarks
