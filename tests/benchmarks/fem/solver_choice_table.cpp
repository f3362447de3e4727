#include "tests/benchmarks/fem/solver_choice_table.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

#include "fem/solver/solver_choice.hpp"
#include "tests/benchmarks/support/timing.hpp"
#include "tests/fem/support/smoothed_box.hpp"

namespace articular::benchmarks {
namespace {

using namespace articular::fem;

constexpr double kStatics = 1e-8, kInTime = 1e-5;  // [-] residuals
constexpr int kMostIterations = 5000;
constexpr int kSteps = 12;
// ρ L²/(h² μ) of a cube of 0.1 m, 1000 kg/m³, μ = 10 kPa, in steps of 5 ms.
constexpr double kInertia = 40;
constexpr int kMostFactoredCells = 15;

/// (m + K) dv = f − K (u + v) − ... of a body that starts to move under its weight, in units of the
/// step: u and v in metres, m the mass over the square of the step.
class Motion {
 public:
  Motion(SmoothedBox& box, bool smoothed, const Eigen::VectorXd& mass)
      : box_(box), smoothed_(smoothed), mass_(mass) {
    u_ = v_ = Eigen::VectorXd::Zero(box.b.size());
    if (smoothed) pressure_.set(box.part().terms);
  }
  const BlockMatrix& matrix() const { return smoothed_ ? box_.K : box_.plain; }
  FactorStatus prepare(LinearSolver& solver) {
    return smoothed_ ? solver.prepare_with_pressure(matrix(), box_.x, box_.part())
                     : solver.prepare(matrix(), box_.x);
  }
  /// b − K (u + v), K without the mass.
  Eigen::VectorXd right_side() {
    const Eigen::VectorXd w = u_ + v_;
    Eigen::VectorXd y;
    matrix().multiply(w, y);
    if (smoothed_) pressure_.add_product(w, y);
    return box_.b - y + mass_.cwiseProduct(w);
  }
  void advance(const Eigen::VectorXd& dv) {
    v_ += dv;
    u_ += v_;
  }

 private:
  SmoothedBox& box_;
  bool smoothed_;
  Eigen::VectorXd mass_, u_, v_;
  PressureOperator pressure_;
};

/// ms of one solution, or of a step without the first. Infinite without convergence.
double milliseconds(SmoothedBox& box, bool smoothed, bool in_time, const Eigen::VectorXd& mass,
                    const SolverChoice& choice) {
  const auto solver = make_linear_solver(choice, in_time ? kInTime : kStatics, kMostIterations);
  Motion motion(box, smoothed, mass);
  std::vector<double> times;
  Eigen::VectorXd dv;
  for (int k = 0; k < (in_time ? kSteps : 1); ++k) {
    const Eigen::VectorXd b = motion.right_side();
    const double start = cpu_seconds();
    if (motion.prepare(*solver) != FactorStatus::Ready || !solver->solve(b, dv).converged) {
      return std::numeric_limits<double>::infinity();
    }
    if (k > 0 || !in_time) times.push_back(1e3 * (cpu_seconds() - start));
    motion.advance(dv);
  }
  return median(times);
}

double best_of(int runs, SmoothedBox& box, bool smoothed, bool in_time, const Eigen::VectorXd& mass,
               const SolverChoice& choice) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < runs; ++k) {
    best = std::min(best, milliseconds(box, smoothed, in_time, mass, choice));
  }
  return best;
}

void print_row(int cells, bool smoothed, bool in_time, double nu) {
  const TetMesh mesh = box_mesh({cells, cells, cells}, Vec3::Constant(0.1));
  const double inertia = in_time ? kInertia : 0;
  SmoothedBox box = smoothed_box(mesh, nu, inertia);
  if (!smoothed) {
    box.plain = plain_box(mesh, nu, inertia);
  }
  const Eigen::VectorXd mass =
      inertia * lame_parameters(kModulusOfBox, nu).mu / 0.01 *
      lumped_mass(mesh.X, mesh.tets, 1).replicate(1, 3).transpose().reshaped();
  const int num_nodes = static_cast<int>(mesh.X.cols());
  const SolverChoice chosen = choose_solver({.num_blocks = num_nodes,
                                             .num_nodes = num_nodes,
                                             .in_time = in_time,
                                             .has_pressure = smoothed,
                                             .largest_nu = nu});
  std::vector<SolverChoice> all{{SolverKind::ConjugateGradients, in_time ? 5 : 0, ""},
                                {SolverKind::Multigrid, in_time ? 5 : 0, ""}};
  // Of smoothed tetrahedra and in time a factorization takes several times as long at any size.
  if (cells <= kMostFactoredCells && !(smoothed && in_time)) {
    all.push_back({smoothed ? SolverKind::SaddlePoint : SolverKind::Cholesky, 0, ""});
  }
  std::printf("| %d | %s | %s | %g |", 6 * cells * cells * cells, smoothed ? "smoothed" : "plain",
              in_time ? "in time" : "statics", nu);
  double best = std::numeric_limits<double>::infinity(), of_choice = best;
  for (const SolverChoice& choice : all) {
    const double time = best_of(cells < 12 ? 3 : 1, box, smoothed, in_time, mass, choice);
    best = std::min(best, time);
    if (choice.kind == chosen.kind) of_choice = time;
    std::printf(" %.3g%s |", time, choice.kind == chosen.kind ? "*" : "");
  }
  if (all.size() < 3) std::printf(" |");
  std::printf(" %.2f |\n", of_choice / best);
  std::fflush(stdout);
}

}  // namespace

void print_solver_choices(int most_cells) {
  std::printf(
      "* chosen; ms of a solution, or of a step after the first\n| tets | elements | problem | nu "
      "| block Jacobi | multigrid | factor | chosen / best |\n|---|---|---|---|---|---|---|---|\n");
  for (const int cells : {5, 9, 15, 26}) {
    if (cells > most_cells) break;
    for (const bool smoothed : {false, true}) {
      for (const bool in_time : {true, false}) {
        for (const double nu : {0.3, 0.45, 0.49, 0.499}) print_row(cells, smoothed, in_time, nu);
      }
    }
  }
}

}  // namespace articular::benchmarks
