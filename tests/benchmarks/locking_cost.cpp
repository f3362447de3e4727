#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "fem/rest_shape.hpp"
#include "fem/tetrahedron.hpp"
#include "tests/benchmarks/locking_study.hpp"

namespace articular::fem {
namespace {

/// Median CPU time [ms] of five calls.
template <class Function>
double milliseconds(const Function& function) {
  std::vector<double> times;
  for (int k = 0; k < 5; ++k) {
    const std::clock_t start = std::clock();
    function();
    times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(times.begin(), times.begin() + 2, times.end());
  return times[2];
}

/// Plain tetrahedra with the kernels of tetrahedron.hpp.
class PlainTetrahedra {
 public:
  PlainTetrahedra(const TetMesh& mesh, const MooneyRivlin<>& material)
      : tets_(mesh.tets), material_(material), num_nodes_(static_cast<int>(mesh.X.cols())) {
    const BlockMatrix K = make_matrix();
    for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
      volume_.push_back(checked_volume(mesh.X, tets_, e));
      inverse_edges_.push_back(edge_matrix(gather(mesh.X, tets_, e)).inverse());
      for (const int b : tets_.col(e)) {
        for (const int a : tets_.col(e)) slots_.push_back(K.slot(a, b));
      }
    }
  }

  BlockMatrix make_matrix() const {
    std::vector<int> offsets;
    for (int e = 0; e <= static_cast<int>(tets_.cols()); ++e) offsets.push_back(4 * e);
    return {num_nodes_, {tets_.data(), static_cast<std::size_t>(tets_.size())}, offsets};
  }

  void add_internal_force(const Positions& x, Positions& f) const {
    for (std::size_t e = 0; e < volume_.size(); ++e) {
      const auto element = static_cast<Eigen::Index>(e);
      const Mat3 F = deformation_gradient(gather(x, tets_, element), inverse_edges_[e]);
      const Mat34 f_e =
          nodal_force(material_.first_piola(F), shape_gradients(inverse_edges_[e]), volume_[e]);
      for (int a = 0; a < 4; ++a) f.col(tets_(a, element)) += f_e.col(a);
    }
  }

  void add_stiffness(const Positions& x, BlockMatrix& K) const {
    const int* slot = slots_.data();
    for (std::size_t e = 0; e < volume_.size(); ++e) {
      const Mat3 F =
          deformation_gradient(gather(x, tets_, static_cast<Eigen::Index>(e)), inverse_edges_[e]);
      const Mat12 K_e =
          stiffness(material_.tangent(F), shape_gradients(inverse_edges_[e]), volume_[e]);
      for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 4; ++a) K.block(*slot++) += K_e.block<3, 3>(3 * a, 3 * b);
      }
    }
  }

 private:
  Tetrahedra tets_;
  MooneyRivlin<> material_;
  int num_nodes_;
  std::vector<double> volume_;
  std::vector<Mat3> inverse_edges_;
  std::vector<int> slots_;
};

struct Times {
  double prepare, solve;  // [ms]
  int iterations;
};

template <class Prepare>
Times times_of(LinearSolver& solver, const Prepare& prepare, const Eigen::VectorXd& b) {
  if (prepare(solver) != FactorStatus::Ready) return {0, 0, -1};
  Times times{};
  times.prepare = milliseconds([&] { (void)prepare(solver); });
  times.solve = milliseconds([&] {
    Eigen::VectorXd u;
    const SolveReport report = solver.solve(b, u);
    times.iterations = report.converged ? report.iterations : -1;
  });
  return times;
}

}  // namespace

// Both with one material, at a state 0.03 % of a cell away from rest, so that no term vanishes.
void print_cost() {
  constexpr double kTolerance = 1e-6;  // [-] of the linear residual
  std::printf(
      "\n## Cost of one Newton iteration, block of 20,250 tetrahedra, linear residual 1e-6 "
      "[ms of CPU time, one thread]\n\n"
      "| ν | | internal force | assembly | direct: prepare | solve | iterations | sum "
      "| CG: solve | iterations | sum |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const LoadedBody block = block_compression(15);
  const Positions x = block.mesh.X + 2e-5 * Positions::Random(3, block.mesh.X.cols());
  Positions f = Positions::Zero(3, x.cols());
  const Eigen::VectorXd b = block.fixed.select(0.0, block.f_ext).reshaped();
  for (const double nu : {0.3, 0.49, 0.499}) {
    const auto material = study_material(nu);
    const PlainTetrahedra plain(block.mesh, material);
    BlockMatrix Q = plain.make_matrix();
    const double plain_force = milliseconds([&] { plain.add_internal_force(x, f); });
    const double plain_assembly = milliseconds([&] {
      Q.set_zero();
      plain.add_stiffness(x, Q);
    });
    fix_components(block.fixed, kMu, Q);
    const auto prepare_plain = [&](LinearSolver& solver) { return solver.prepare(Q); };
    const Times plain_direct = times_of(*make_cholesky(), prepare_plain, b);
    const Times plain_cg = times_of(*make_conjugate_gradients(kTolerance, 9000), prepare_plain, b);

    const SmoothedElasticity smoothed(block.mesh.X, block.mesh.tets, material);
    BlockMatrix K = smoothed.make_matrix(), P = smoothed.make_plain_matrix();
    PressureGradient G = smoothed.make_pressure_gradient();
    Eigen::VectorXd p;
    const double force = milliseconds([&] { smoothed.add_internal_force(x, f); });
    const double assembly = milliseconds([&] {
      K.set_zero();
      smoothed.pressure(x, p);
      smoothed.add_stiffness(x, p, Tangent::Consistent, 1, K);
      smoothed.set_pressure_gradient(x, G);
    });
    const double assembly_of_plain = milliseconds([&] {
      P.set_zero();
      smoothed.add_plain_stiffness(x, Tangent::Consistent, 1, P);
    });
    fix_components(block.fixed, kMu, K);
    fix_components(block.fixed, kMu, P);
    fix_components(block.fixed, G);
    const PressureTerm term{.G = &G, .pressure = &smoothed.nodal_pressure()};
    const auto prepare = [&](LinearSolver& solver) {
      return solver.prepare_with_pressure(K, {.terms = {&term, 1}, .plain = &P});
    };
    const Times direct = times_of(*make_saddle_point_solver(kTolerance, 500), prepare, b);
    const Times cg = times_of(*make_conjugate_gradients(kTolerance, 9000), prepare, b);

    const auto row = [&](const char* name, double of_force, double of_assembly,
                         double of_direct_assembly, const Times& d, const Times& c) {
      const double sum_direct = of_assembly + of_direct_assembly + d.prepare + d.solve,
                   sum_cg = of_assembly + c.prepare + c.solve;
      std::printf("| %g | %s | %.1f | %.1f | %.0f | %.0f | %d | %.0f | %.0f | %d | %.0f |\n", nu,
                  name, of_force, of_assembly, d.prepare + of_direct_assembly, d.solve,
                  d.iterations, sum_direct, c.prepare + c.solve, c.iterations, sum_cg);
      return std::pair{sum_direct, sum_cg};
    };
    const auto [plain_sum, plain_sum_cg] =
        row("plain", plain_force, plain_assembly, 0, plain_direct, plain_cg);
    const auto [sum, sum_cg] = row("ES + PP", force, assembly, assembly_of_plain, direct, cg);
    std::printf("| | ratio | %.1f | %.1f | | | | **%.1f** | | | **%.1f** |\n", force / plain_force,
                assembly / plain_assembly, sum / plain_sum, sum_cg / plain_sum_cg);
    std::fflush(stdout);
  }
}

}  // namespace articular::fem
