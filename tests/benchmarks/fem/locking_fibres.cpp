#include <cmath>
#include <cstdio>
#include <limits>

#include "fem/element/elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "tests/benchmarks/fem/locking_study.hpp"

namespace articular::fem {
namespace {

/// Cook's membrane with fibres at 30 degrees to its axis, along which it is drawn: `ratio` times
/// stiffer than the ground substance is in shear, from the start (a toe region of 0.1 %).
AnyMaterial fibred(double ratio) {
  constexpr double kC4 = 10, kToeEnd = 1.001, kNu = 0.49;
  const double c5 = ratio * kMu, c3 = c5 / (kC4 * std::exp(kC4 * (kToeEnd - 1)));
  const ToeLinearFibre fibre({.c3 = c3, .c4 = kC4, .c5 = c5, .toe_end = kToeEnd});
  return TransverselyIsotropic<VolumeChange>(kMu / 2, 0, fibre,
                                             2 * kMu * (1 + kNu) / (3 * (1 - 2 * kNu)));
}

Formulation formulation_of(const Elasticity& plain) {
  return {
      .energy = [&plain](const Positions& x, const Eigen::VectorXd&) { return plain.energy(x); },
      .add_internal_force = [&plain](const Positions& x,
                                     Positions& f) { plain.add_internal_force(x, f); },
      .make_matrix = [&plain] { return plain.make_matrix(); },
      .add_stiffness = [&plain](const Positions& x, const Eigen::VectorXd&, Tangent tangent,
                                BlockMatrix& K) { plain.add_stiffness(x, tangent, 1, K); },
      .smoothed = nullptr};
}

double displacement(const Formulation& formulation, const LoadedBody& loaded) {
  constexpr int kLoadSteps = 10;
  const auto solver =
      formulation.smoothed != nullptr ? make_saddle_point_solver(1e-8, 1000) : make_cholesky();
  Positions x = loaded.mesh.X;
  LoadedBody part = loaded;
  NewtonReport report;
  for (int step = 1; step <= kLoadSteps; ++step) {
    part.f_ext = static_cast<double>(step) / kLoadSteps * loaded.f_ext;
    report = equilibrate(formulation, part, *solver, x, {.tolerance = 1e-7, .max_iterations = 200});
  }
  if (!report.converged) return std::numeric_limits<double>::quiet_NaN();
  return x(loaded.axis, loaded.probe) - loaded.mesh.X(loaded.axis, loaded.probe);
}

}  // namespace

void print_fibres() {
  std::printf(
      "\n## Stiff fibres: Cook's membrane with fibres at 30 degrees, nu = 0.49, displacement\n\n"
      "| c5 / mu | plain 8 | 16 | 32 | 64 | ES .9 + PP 2: 8 | 16 | 32 | 64 |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  const Vec3 along(std::sqrt(3.0) / 2, 0.5, 0);
  for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) {
    std::printf("| %g", ratio);
    for (const bool smoothed : {false, true}) {
      for (const int n : {8, 16, 32, 64}) {
        const LoadedBody loaded = cook_membrane(n);
        const TetMesh& mesh = loaded.mesh;
        const FibreDirections fibres = along.replicate(1, mesh.tets.cols());
        double u = 0;
        if (smoothed) {
          const SmoothedElasticity elements(mesh.X, mesh.tets, fibred(ratio), {}, fibres);
          u = displacement(formulation_of(elements), loaded);
        } else {
          const Elasticity elements(mesh.X, mesh.tets, fibred(ratio), fibres);
          u = displacement(formulation_of(elements), loaded);
        }
        std::printf(" | %.3f", u);
        std::fflush(stdout);
      }
    }
    std::printf(" |\n");
  }
}

}  // namespace articular::fem
