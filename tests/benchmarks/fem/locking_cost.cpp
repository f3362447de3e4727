#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <vector>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/benchmarks/fem/locking_study.hpp"

namespace articular::fem {
namespace {

constexpr int kRounds = 7;
constexpr double kTolerance = 1e-6;  // [-] of the linear residual

/// Median CPU time [ms] of each of these, over rounds in which they take turns.
std::vector<double> milliseconds(const std::vector<std::function<void()>>& parts) {
  std::vector<std::vector<double>> times(parts.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::clock_t start = std::clock();
      parts[k]();
      times[k].push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& of_part : times) {
    std::nth_element(of_part.begin(), of_part.begin() + kRounds / 2, of_part.end());
    medians.push_back(of_part[kRounds / 2]);
  }
  return medians;
}

/// A solver and how it did.
struct Solution {
  std::unique_ptr<LinearSolver> solver;
  int iterations = 0;

  void solve(const Eigen::VectorXd& b) {
    Eigen::VectorXd u;
    const SolveReport report = solver->solve(b, u);
    iterations = report.converged ? report.iterations : -1;
  }
};

/// Plain tetrahedra at a state.
struct Plain {
  Elasticity elasticity;
  BlockMatrix K = elasticity.make_matrix();
  Solution direct{make_cholesky()}, cg{make_conjugate_gradients(kTolerance, 9000)};

  void assemble(const Positions& x) {
    K.set_zero();
    elasticity.add_stiffness(x, Tangent::Consistent, 1, K);
  }
};

/// Smoothed ones.
struct Smoothed {
  SmoothedElasticity elasticity;
  BlockMatrix K = elasticity.make_matrix(), plain = elasticity.make_plain_matrix();
  PressureGradient G = elasticity.make_pressure_gradient();
  Eigen::VectorXd p{};
  Solution direct{make_saddle_point_solver(kTolerance, 500)},
      cg{make_conjugate_gradients(kTolerance, 9000)};

  void assemble(const Positions& x) {
    K.set_zero();
    elasticity.pressure(x, p);
    elasticity.add_stiffness(x, p, Tangent::Consistent, 1, K);
    elasticity.set_pressure_gradient(x, G);
  }
  void assemble_plain(const Positions& x) {
    plain.set_zero();
    elasticity.add_plain_stiffness(x, Tangent::Consistent, 1, plain);
  }
  void prepare(LinearSolver& solver) const {
    const PressureTerm term{.G = &G, .pressure = &elasticity.nodal_pressure()};
    (void)solver.prepare_with_pressure(K, {.terms = {&term, 1}, .plain = &plain});
  }
};

/// Times of one formulation [ms].
struct Cost {
  double force, assembly, direct_prepare, direct_solve, cg_prepare, cg_solve;

  double direct_sum() const { return assembly + direct_prepare + direct_solve; }
  double cg_sum() const { return assembly + cg_prepare + cg_solve; }
};

void print_row(double nu, const char* name, const Cost& cost, const Solution& direct,
               const Solution& cg) {
  std::printf("| %g | %s | %.1f | %.1f | %.0f | %.0f | %d | %.0f | %.0f | %d | %.0f |\n", nu, name,
              cost.force, cost.assembly, cost.direct_prepare, cost.direct_solve, direct.iterations,
              cost.direct_sum(), cost.cg_prepare + cost.cg_solve, cg.iterations, cost.cg_sum());
}

/// Of one law, at a state 0.03 % of a cell away from rest, so that no term vanishes.
void print_cost(const LoadedBody& block, double nu, const AnyMaterial& material) {
  const Positions x = block.mesh.X + 2e-5 * Positions::Random(3, block.mesh.X.cols());
  const Eigen::VectorXd b = block.fixed.select(0.0, block.f_ext).reshaped();
  Positions f = Positions::Zero(3, x.cols());
  Plain plain{Elasticity(block.mesh.X, block.mesh.tets, material)};
  Smoothed smoothed{SmoothedElasticity(block.mesh.X, block.mesh.tets, material)};
  const std::vector<double> assembly = milliseconds(
      {[&] { plain.elasticity.add_internal_force(x, f); },
       [&] { smoothed.elasticity.add_internal_force(x, f); }, [&] { plain.assemble(x); },
       [&] { smoothed.assemble(x); }, [&] { smoothed.assemble_plain(x); }});
  fix_components(block.fixed, kMu, plain.K);
  fix_components(block.fixed, kMu, smoothed.K);
  fix_components(block.fixed, kMu, smoothed.plain);
  fix_components(block.fixed, smoothed.G);
  // Each pattern is analysed once, before.
  const auto prepare_plain = [&](LinearSolver& solver) { (void)solver.prepare(plain.K); };
  prepare_plain(*plain.direct.solver);
  prepare_plain(*plain.cg.solver);
  smoothed.prepare(*smoothed.direct.solver);
  smoothed.prepare(*smoothed.cg.solver);
  const std::vector<double> solution = milliseconds(
      {[&] { prepare_plain(*plain.direct.solver); }, [&] { plain.direct.solve(b); },
       [&] { smoothed.prepare(*smoothed.direct.solver); }, [&] { smoothed.direct.solve(b); },
       [&] { prepare_plain(*plain.cg.solver); }, [&] { plain.cg.solve(b); },
       [&] { smoothed.prepare(*smoothed.cg.solver); }, [&] { smoothed.cg.solve(b); }});
  const Cost of_plain{assembly[0], assembly[2], solution[0], solution[1], solution[4], solution[5]};
  // The direct solver factors a matrix of the plain pattern.
  const Cost of_smoothed{assembly[1], assembly[3], solution[2] + assembly[4],
                         solution[3], solution[6], solution[7]};
  print_row(nu, "plain", of_plain, plain.direct, plain.cg);
  print_row(nu, "ES + PP", of_smoothed, smoothed.direct, smoothed.cg);
  std::printf("| | ratio | %.1f | %.1f | | | | **%.1f** | | | **%.1f** |\n",
              of_smoothed.force / of_plain.force, of_smoothed.assembly / of_plain.assembly,
              of_smoothed.direct_sum() / of_plain.direct_sum(),
              of_smoothed.cg_sum() / of_plain.cg_sum());
  std::fflush(stdout);
}

}  // namespace

void print_cost() {
  const LoadedBody block = block_compression(15);
  const auto print_table = [&](const char* law, const auto& material) {
    std::printf(
        "\n## Cost of one Newton iteration, block of 20,250 tetrahedra, %s, linear residual 1e-6 "
        "[ms of CPU time, one thread]\n\n"
        "| ν | | internal force | assembly | direct: prepare | solve | iterations | sum "
        "| CG: solve | iterations | sum |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        law);
    for (const double nu : {0.3, 0.49, 0.499}) print_cost(block, nu, material(nu));
  };
  print_table("neo-Hookean law (vector kernels on both sides)",
              [](double nu) { return AnyMaterial(NeoHookean(2 * kMu * (1 + nu), nu)); });
  print_table("isochoric neo-Hookean law (plain tetrahedra one by one)",
              [](double nu) { return AnyMaterial(study_material(nu)); });
}

}  // namespace articular::fem
