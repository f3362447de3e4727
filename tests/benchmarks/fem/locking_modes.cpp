#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "fem/element/elasticity.hpp"
#include "tests/benchmarks/fem/locking_study.hpp"
#include "tests/fem/support/dense.hpp"

namespace articular::fem {
namespace {

Eigen::MatrixXd dense_stiffness(const Formulation& formulation, const Positions& X) {
  Eigen::VectorXd p;
  if (formulation.smoothed != nullptr) p.setZero(formulation.smoothed->num_pressures());
  BlockMatrix K = formulation.make_matrix();
  formulation.add_stiffness(X, p, Tangent::Consistent, K);
  Eigen::MatrixXd result = dense(K);
  if (formulation.smoothed == nullptr) return result;
  PressureGradient G = formulation.smoothed->make_pressure_gradient();
  formulation.smoothed->set_pressure_gradient(X, G);
  const PressureTerm term{.G = &G, .pressure = &formulation.smoothed->nodal_pressure()};
  PressureOperator pressure;
  pressure.set({&term, 1});
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    Eigen::VectorXd column = result.col(j);
    pressure.add_product(Eigen::VectorXd::Unit(result.cols(), j), column);
    result.col(j) = column;
  }
  return result;
}

/// Orthonormal translations and rotations.
Eigen::MatrixXd rigid_modes(const Positions& X) {
  Eigen::MatrixXd modes(3 * X.cols(), 6);
  for (int i = 0; i < 3; ++i) {
    Positions translation = Positions::Zero(3, X.cols()), rotation(3, X.cols());
    translation.row(i).setOnes();
    for (Eigen::Index a = 0; a < X.cols(); ++a) {
      rotation.col(a) = Vec3::Unit(i).cross(Vec3(X.col(a)));
    }
    modes.col(i) = translation.reshaped();
    modes.col(3 + i) = rotation.reshaped();
  }
  return Eigen::HouseholderQR<Eigen::MatrixXd>(modes).householderQ() *
         Eigen::MatrixXd::Identity(modes.rows(), 6);
}

struct Modes {
  int num_zero, num_soft;  // soft: energy below a tenth of that of plain tetrahedra
  double softest;          // smallest ratio of energies to those of plain tetrahedra
};

Modes modes_of(const Eigen::MatrixXd& K, const Eigen::MatrixXd& K_plain, const Positions& X) {
  const Eigen::VectorXd own =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  // Rigid modes get the ratio 1.
  const Eigen::MatrixXd R = rigid_modes(X), shift = K_plain.norm() * R * R.transpose();
  const Eigen::VectorXd ratios = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                     K + shift, K_plain + shift, Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  return {.num_zero = static_cast<int>((own.array() < 1e-10 * own.tail<1>()[0]).count()),
          .num_soft = static_cast<int>((ratios.array() < 0.1).count()),
          .softest = ratios[0]};
}

/// The lowest frequency [1/s] of a body with its supports, at rest, with lumped masses of density
/// 1, by inverse iteration.
double lowest_frequency(const Body& body, const LoadedBody& loaded) {
  const Formulation formulation = body.formulation();
  const SmoothedElasticity* smoothed = formulation.smoothed;
  const Positions& X = loaded.mesh.X;
  Eigen::VectorXd p;
  if (smoothed != nullptr) p.setZero(smoothed->num_pressures());
  BlockMatrix K = formulation.make_matrix(), plain;
  PressureGradient G;
  formulation.add_stiffness(X, p, Tangent::Consistent, K);
  fix_components(loaded.fixed, 1, K);
  const auto solver = smoothed != nullptr ? make_saddle_point_solver(1e-8, 1000) : make_cholesky();
  FactorStatus status{};
  PressureTerm term{.G = &G, .pressure = nullptr};
  if (smoothed != nullptr) {
    plain = smoothed->make_plain_matrix();
    smoothed->add_plain_stiffness(X, Tangent::Consistent, 1, plain);
    fix_components(loaded.fixed, 1, plain);
    G = smoothed->make_pressure_gradient();
    smoothed->set_pressure_gradient(X, G);
    fix_components(loaded.fixed, G);
    term.pressure = &smoothed->nodal_pressure();
    status = solver->prepare_with_pressure(K, {.terms = {&term, 1}, .plain = &plain});
  } else {
    status = solver->prepare(K);
  }
  if (status != FactorStatus::Ready) return std::nan("");
  Positions mass = lumped_mass(X, loaded.mesh.tets, 1).transpose().replicate(3, 1);
  mass = loaded.fixed.select(0.0, mass);
  const Eigen::VectorXd M = mass.reshaped();
  Eigen::VectorXd u = loaded.f_ext.reshaped(), b;
  double eigenvalue = 0;
  for (int k = 0; k < 100; ++k) {
    u /= std::sqrt(u.dot(M.cwiseProduct(u)));
    b = M.cwiseProduct(u);
    Eigen::VectorXd next = u;
    if (!solver->solve(b, next).converged) return std::nan("");
    const double previous = eigenvalue;
    eigenvalue = 1 / u.dot(M.cwiseProduct(next));
    u = next;
    if (std::abs(eigenvalue - previous) < 1e-9 * eigenvalue) break;
  }
  return std::sqrt(eigenvalue) / (2 * std::numbers::pi);
}

}  // namespace

void print_modes() {
  std::printf(
      "\n## Modes of a free cube, 4 x 4 x 4 cells, 375 degrees of freedom\n\n"
      "| | zero modes ν .3 | softest / plain | below a tenth of plain | zero modes ν .499 "
      "|\n|---|---|---|---|---|\n");
  const TetMesh cube = box_mesh({4, 4, 4}, Vec3::Ones());
  const auto stiffness = [&](const char* name, double nu) {
    return dense_stiffness(Body(candidate(name), cube, study_material(nu)).formulation(), cube.X);
  };
  const Eigen::MatrixXd plain = stiffness("plain", 0.3);
  for (const char* name : {"plain", "NS", "ES", "ES + PP 1", "ES .95 + PP 1.5", "ES .9 + PP 2"}) {
    const Modes modes = modes_of(stiffness(name, 0.3), plain, cube.X);
    const Modes nearly = modes_of(stiffness(name, 0.499), plain, cube.X);
    std::printf("| %s | %d | %.3f | %d | %d |\n", name, modes.num_zero, modes.softest,
                modes.num_soft, nearly.num_zero);
  }
  std::printf(
      "\n## Lowest frequency with lumped masses [1/s], density 1\n\n"
      "| | beam ν .3: 960 | 7,680 tetrahedra | block ν .3: n = 4 | 8 | 12 | ν .499: 4 | 8 "
      "| 12 |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const char* name : {"plain", "NS", "ES + PP 1", "ES .95 + PP 1.5", "ES .9 + PP 2"}) {
    std::printf("| %s", name);
    for (const int n : {1, 2}) {
      const LoadedBody beam = bent_beam(n, 1);
      std::printf(" | %.5f",
                  lowest_frequency(Body(candidate(name), beam.mesh, study_material(0.3)), beam));
    }
    for (const double nu : {0.3, 0.499}) {
      for (const int n : {4, 8, 12}) {
        const LoadedBody block = block_compression(n);
        std::printf(" | %.4f",
                    lowest_frequency(Body(candidate(name), block.mesh, study_material(nu)), block));
        std::fflush(stdout);
      }
    }
    std::printf(" |\n");
  }
}

}  // namespace articular::fem
