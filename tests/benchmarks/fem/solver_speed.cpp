// Linear solvers on a static problem: a cube of plain tetrahedra, six a cell, clamped on one side.
//
//   build/release/bin/solver_speed [statics|nu|threads|pressure|choice] [MOST_CELLS] [RUNS]
//   [SOLVER]
//                                                                          (statics 32 5 all)
// `pressure` has smoothed tetrahedra with a nodal pressure, without and with inertia.
//
// Times are medians of processor time of runs in which the solvers take turns; `threads` prints
// wall time, which means something on an idle machine only.

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "tests/benchmarks/fem/block_minres.hpp"
#include "tests/benchmarks/fem/solver_choice_table.hpp"
#include "tests/benchmarks/support/timing.hpp"
#include "tests/fem/support/clamped_box.hpp"
#include "tests/fem/support/smoothed_box.hpp"

namespace {

using namespace articular;
using namespace articular::fem;
using articular::benchmarks::cpu_seconds;
using articular::benchmarks::median;

constexpr double kTolerance = 1e-8;  // [-] of the residual
constexpr int kMostIterations = 20000;
constexpr int kMostCholeskyCells = 24;  // beyond, minutes and gigabytes
constexpr double kSize = 0.1;           // edge of the cube [m]

double wall_seconds() {
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  return now.count();
}

double peak_megabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct Candidate {
  const char* name;
  std::function<std::unique_ptr<LinearSolver>()> make;
  std::vector<double> set_up, refresh, solve;  // [s]
  int iterations = 0;
};

/// Set-up and solution, each run with a new solver; then with its pattern known.
void run(const ClampedBox& box, double (*clock)(), Candidate& candidate) {
  const auto solver = candidate.make();
  Eigen::VectorXd x;
  double start = clock();
  if (solver->prepare(box.K, box.X) != FactorStatus::Ready) std::exit(EXIT_FAILURE);
  candidate.set_up.push_back(clock() - start);
  start = clock();
  const SolveReport report = solver->solve(box.b, x);
  candidate.solve.push_back(clock() - start);
  if (!report.converged)
    std::printf("%s: no convergence, %g\n", candidate.name, report.relative_residual);
  candidate.iterations = report.iterations;
  start = clock();
  if (solver->prepare(box.K, box.X) != FactorStatus::Ready) std::exit(EXIT_FAILURE);
  candidate.refresh.push_back(clock() - start);
}

double product_seconds(const ClampedBox& box) {
  Eigen::VectorXd y;
  std::vector<double> times;
  for (int k = 0; k < 21; ++k) {
    const double start = cpu_seconds();
    box.K.multiply(box.b, y);
    times.push_back(cpu_seconds() - start);
  }
  return median(times);
}

std::vector<Candidate> candidates(int cells, const std::string& only) {
  std::vector<Candidate> all;
  all.push_back({"block Jacobi",
                 [] { return make_conjugate_gradients(kTolerance, kMostIterations); },
                 {},
                 {},
                 {}});
  all.push_back(
      {"multigrid", [] { return make_multigrid(kTolerance, kMostIterations); }, {}, {}, {}});
  if (cells <= kMostCholeskyCells)
    all.push_back({"Cholesky", [] { return make_cholesky(); }, {}, {}, {}});
  if (only != "all") std::erase_if(all, [&](const Candidate& c) { return c.name != only; });
  return all;
}

ClampedBox cube(int cells, double nu) {
  return clamped_box(box_mesh({cells, cells, cells}, Vec3::Constant(kSize)), nu);
}

void print_row(int cells, double nu, double product, const Candidate& c) {
  std::printf("| %d | %g | %s | %.1f | %.1f | %.1f | %.1f | %d | %.3f | %.0f | %.0f |\n",
              6 * cells * cells * cells, nu, c.name, 1e3 * median(c.set_up),
              1e3 * median(c.refresh), 1e3 * median(c.solve),
              1e3 * (median(c.set_up) + median(c.solve)), c.iterations, 1e3 * product,
              median(c.solve) / product, peak_megabytes());
  std::fflush(stdout);
}

constexpr const char* kHeader =
    "| tets | nu | solver | set-up ms | next prepare ms | solve ms | both ms | iterations | "
    "product ms | products a "
    "solve | peak MB |\n|---|---|---|---|---|---|---|---|---|---|---|\n";

void statics(int most_cells, int runs, const std::string& only) {
  std::printf("%s", kHeader);
  std::vector<double> last;
  int last_cells = 0;
  for (const int cells : {10, 16, 24, 32, 55}) {
    if (cells > most_cells) break;
    const ClampedBox box = cube(cells, 0.45);
    const double product = product_seconds(box);
    std::vector<Candidate> all = candidates(cells, only);
    for (int k = 0; k < runs; ++k) {
      for (Candidate& candidate : all) run(box, cpu_seconds, candidate);
    }
    std::vector<double> now;
    for (const Candidate& candidate : all) {
      print_row(cells, 0.45, product, candidate);
      now.push_back(median(candidate.set_up) + median(candidate.solve));
      if (last_cells == 0 || now.size() > last.size()) continue;
      std::printf(
          "    time grows with tets to the power %.2f\n",
          std::log(now.back() / last[now.size() - 1]) / (3 * std::log(1.0 * cells / last_cells)));
    }
    last = now;
    last_cells = cells;
  }
}

void nu_sweep(int most_cells, int runs, const std::string& only) {
  std::printf("%s", kHeader);
  for (const double nu : {0.45, 0.49, 0.499, 0.4999}) {
    const ClampedBox box = cube(most_cells, nu);
    const double product = product_seconds(box);
    std::vector<Candidate> all = candidates(most_cells, only);
    for (int k = 0; k < runs; ++k) {
      for (Candidate& candidate : all) run(box, cpu_seconds, candidate);
    }
    for (const Candidate& candidate : all) print_row(most_cells, nu, product, candidate);
  }
}

void threads(int most_cells, int runs) {
  std::printf(
      "wall time of\n| tets | solver, threads | set-up ms | next prepare ms | solve ms |\n"
      "|---|---|---|---|---|\n");
  for (const int cells : {16, 24, 32, 55}) {
    if (cells > most_cells) break;
    const ClampedBox box = cube(cells, 0.45);
    std::vector<Candidate> all;
    for (const int n : {1, 2}) {
      const auto pool = std::make_shared<articular::ThreadPool>(n);
      all.push_back({n == 1 ? "multigrid, 1" : "multigrid, 2",
                     [pool] { return make_multigrid(kTolerance, kMostIterations, pool); },
                     {},
                     {},
                     {}});
      if (cells > kMostCholeskyCells) continue;
      all.push_back({n == 1 ? "Cholesky, 1" : "Cholesky, 2",
                     [pool] { return make_cholesky(pool); },
                     {},
                     {},
                     {}});
    }
    for (int k = 0; k < runs; ++k) {
      for (Candidate& candidate : all) run(box, wall_seconds, candidate);
    }
    for (const Candidate& c : all) {
      std::printf("| %d | %s | %.1f | %.1f | %.1f |\n", 6 * cells * cells * cells, c.name,
                  1e3 * median(c.set_up), 1e3 * median(c.refresh), 1e3 * median(c.solve));
    }
  }
}

/// One solver of a cube of smoothed tetrahedra: prints ms of set-up + solve and the iterations.
template <class Prepare, class Solve>
void print_with_pressure(int runs, const Prepare& prepare, const Solve& solve) {
  std::vector<double> set_up, solution;
  SolveReport report;
  for (int k = 0; k < runs; ++k) {
    Eigen::VectorXd x;
    const double start = cpu_seconds();
    auto solver = prepare();
    const double prepared = cpu_seconds();
    report = solve(*solver, x);
    set_up.push_back(prepared - start);
    solution.push_back(cpu_seconds() - prepared);
  }
  std::printf(" %.1f + %.1f (%d%s) |", 1e3 * median(set_up), 1e3 * median(solution),
              report.iterations, report.converged ? "" : ", not converged");
  std::fflush(stdout);
}

void with_pressure(int most_cells, int runs) {
  std::printf(
      "| tets | inertia | nu | GMRES, plain nu 0.3 | GMRES, plain distortion | MINRES, plain nu "
      "0.3 "
      "| block Jacobi | factor |\n|---|---|---|---|---|---|---|---|\n");
  for (const int cells : {8, 15, 24}) {
    if (cells > most_cells) break;
    const TetMesh mesh = box_mesh({cells, cells, cells}, Vec3::Constant(kSize));
    for (const double inertia : {0.0, 100.0}) {
      for (const double nu : {0.3, 0.49, 0.499, 0.4999, 0.49999}) {
        SmoothedBox box = smoothed_box(mesh, nu, inertia);
        SmoothedBox distortion = smoothed_box(mesh, nu, inertia, PlainPart::Distortion);
        const auto row = [&](SmoothedBox& system, std::unique_ptr<LinearSolver> (*make)()) {
          const auto prepare = [&] {
            auto solver = make();
            if (solver->prepare_with_pressure(system.K, system.x, system.part()) !=
                FactorStatus::Ready)
              std::exit(EXIT_FAILURE);
            return solver;
          };
          print_with_pressure(runs, prepare, [&](LinearSolver& solver, Eigen::VectorXd& x) {
            return solver.solve(system.b, x);
          });
        };
        const auto multigrid = [] { return make_multigrid(kTolerance, kMostIterations); };
        std::printf("| %d | %g | %g |", 6 * cells * cells * cells, inertia, nu);
        row(box, multigrid);
        row(distortion, multigrid);
        print_with_pressure(
            runs,
            [&] {
              auto solver = std::make_unique<benchmarks::BlockMinres>();
              if (!solver->prepare(box.K, box.x, box.part())) std::exit(EXIT_FAILURE);
              return solver;
            },
            [&](benchmarks::BlockMinres& solver, Eigen::VectorXd& x) {
              return solver.solve(kTolerance, kMostIterations, box.b, x);
            });
        row(distortion, [] { return make_conjugate_gradients(kTolerance, kMostIterations); });
        if (cells < 24) row(distortion, [] { return make_saddle_point_solver(kTolerance, 500); });
        std::printf("\n");
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "statics";
  const int most_cells = argc > 2 ? std::atoi(argv[2]) : 32,
            runs = argc > 3 ? std::atoi(argv[3]) : 5;
  const std::string only = argc > 4 ? argv[4] : "all";
  if (most_cells < 1 || runs < 1 ||
      (what != "statics" && what != "nu" && what != "threads" && what != "pressure" &&
       what != "choice")) {
    std::fprintf(
        stderr,
        "usage: solver_speed [statics|nu|threads|pressure|choice] [MOST_CELLS] [RUNS] [SOLVER]\n");
    return 2;
  }
  if (what == "statics") statics(most_cells, runs, only);
  if (what == "nu") nu_sweep(most_cells, runs, only);
  if (what == "threads") threads(most_cells, runs);
  if (what == "choice") benchmarks::print_solver_choices(most_cells);
  if (what == "pressure") with_pressure(most_cells, runs);
}
