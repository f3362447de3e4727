#include "fem/element/smoothed_elasticity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "fem/material/any_material.hpp"
#include "fem/material/von_mises.hpp"
#include "fem/solver/linear_solver.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/newton.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

namespace articular::fem::smoothed_elasticity_test {

constexpr double kE = 2e4;            // [Pa] soft tissue
constexpr double kIdentity = 1e-12;   // [-] relative, round-off
constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences
const Vec3 kSize(0.02, 0.01, 0.005);  // [m]

AnyMaterial neo_hookean(double nu, double E = kE) {
  return isochoric_neo_hookean<VolumeChange>(E, nu);
}

/// One material of each kind, halves of a mesh cut at half its height, ν 0.45.
SmoothedElasticity layered(const TetMesh& mesh) {
  std::vector<int> material;
  for (const auto& tet : mesh.tets.colwise()) {
    double z = 0;
    for (const int a : tet) z += mesh.X(2, a) / 4;
    material.push_back(z > mesh.X.row(2).maxCoeff() / 2 ? 1 : 0);
  }
  const double mu = kE / 2.9, kappa = kE / 0.3;
  return {mesh.X,
          mesh.tets,
          {MooneyRivlin<LogVolumeChange>(mu / 3, mu / 6, kappa),
           MooneyRivlin<VolumeChange>(mu / 20, 0, kappa / 10)},
          material};
}

Positions internal_force(const SmoothedElasticity& elasticity, const Positions& x) {
  Positions f = Positions::Zero(3, x.cols());
  elasticity.add_internal_force(x, f);
  return f;
}

/// K + G A⁻¹ Gᵀ
Eigen::MatrixXd dense_stiffness(const SmoothedElasticity& elasticity, const Positions& x,
                                Tangent tangent = Tangent::Consistent, double activation = 0) {
  Eigen::VectorXd p;
  elasticity.pressure(x, p);
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(x, p, tangent, 1, K, activation);
  PressureGradient G = elasticity.make_pressure_gradient();
  elasticity.set_pressure_gradient(x, G);
  const PressureTerm term{.G = &G, .pressure = &elasticity.nodal_pressure()};
  PressureOperator pressure;
  pressure.set({&term, 1});
  Eigen::MatrixXd result = dense(K);
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    Eigen::VectorXd column = result.col(j);
    pressure.add_product(Eigen::VectorXd::Unit(result.cols(), j), column);
    result.col(j) = column;
  }
  return result;
}

Positions shaken(const TetMesh& mesh, double amplitude) {
  const double cell = (mesh.X.col(mesh.tets(1, 0)) - mesh.X.col(mesh.tets(0, 0))).norm();
  return mesh.X + amplitude * cell * Random().matrix<Positions>(3, mesh.X.cols());
}

bool on_boundary(const Vec3& X) { return X.cwiseMin(kSize - X).minCoeff() < 1e-9; }

// A uniform deformation has a uniform mean over every edge and a uniform pressure κΘ: the stress is
// that of the material, and no inner node feels a force.
TEST(SmoothedElasticity, PatchTestUniformStressInAnyMesh) {
  const TetMesh mesh = box_mesh({3, 4, 3}, kSize, 0.15);
  Mat3 F;
  F << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.1, 0.1, 1.2;
  const Positions x = (F * mesh.X).colwise() + Vec3(0.3, -0.2, 0.1);
  for (const double nu : {0.3, 0.49, 0.4999}) {
    const auto material = isochoric_neo_hookean<VolumeChange>(kE, nu);
    const SmoothedElasticity elasticity(mesh.X, mesh.tets, material);
    const Positions f = internal_force(elasticity, x);
    const Mat3 P = material.first_piola(F), sigma = P * F.transpose() / F.determinant();
    const double face_force = P.norm() * kSize.squaredNorm();
    int inner = 0;
    for (Eigen::Index a = 0; a < mesh.X.cols(); ++a) {
      if (on_boundary(mesh.X.col(a))) continue;
      ++inner;
      EXPECT_LT(f.col(a).norm(), kIdentity * face_force);
    }
    EXPECT_EQ(inner, 2 * 3 * 2);
    const Eigen::MatrixXd stress = elasticity.cauchy_stress(x);
    const Eigen::Vector<double, 6> expected(sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1),
                                            sigma(1, 2), sigma(0, 2));
    for (const auto& stress_e : stress.colwise()) {
      EXPECT_LT((stress_e - expected).norm(), 1e-11 * expected.norm());
    }
    const double psi = material.energy_density(F), J = F.determinant();
    EXPECT_NEAR(elasticity.energy(x), kSize.prod() * psi, 1e-11 * kSize.prod() * psi);
    EXPECT_LT((elasticity.strain_energy_density(x).array() - psi).abs().maxCoeff(), 1e-11 * psi);
    EXPECT_LT((elasticity.volume_ratio(x).array() - J).abs().maxCoeff(), kIdentity);
    const Mat3 deviator = sigma - sigma.trace() / 3 * Mat3::Identity();
    const double mises = std::sqrt(1.5) * deviator.norm();
    EXPECT_LT((von_mises(elasticity.cauchy_stress(x)).array() - mises).abs().maxCoeff(),
              1e-11 * sigma.norm());
  }
}

// The same with the inner nodes unknown and far from their place at first.
TEST(SmoothedElasticity, PatchTestBoundaryDeterminesTheInside) {
  Mat3 F;
  F << 1.05, 0.04, -0.02, 0.03, 0.96, 0.05, -0.01, 0.02, 1.04;
  for (const double nu : {0.3, 0.49, 0.4999}) {
    LoadedBody body(box_mesh({3, 4, 3}, kSize, 0.15));
    const Positions expected = F * body.mesh.X;
    const SmoothedElasticity elasticity(body.mesh.X, body.mesh.tets, neo_hookean(nu));
    body.f_ext = internal_force(elasticity, expected);
    const Positions away = F * shaken(body.mesh, 0.1);
    Positions x = expected;
    for (Eigen::Index a = 0; a < x.cols(); ++a) {
      if (on_boundary(body.mesh.X.col(a))) {
        body.fixed.col(a).setConstant(true);
      } else {
        x.col(a) = away.col(a);
      }
    }
    const auto solver = make_saddle_point_solver(1e-12, 200);
    const NewtonReport report =
        equilibrate(formulation_of(elasticity), body, *solver, x, {.tolerance = 1e-11});
    EXPECT_TRUE(report.converged) << nu;
    EXPECT_LT((x - expected).norm(), 1e-11 * expected.norm()) << nu;
  }
}

// Two layers between rigid walls, each with its own stretch along z, so that the axial stress is
// one: piecewise linear, with the kink in a plane of nodes. Domains and pressures that know of the
// materials hold it exactly.
TEST(SmoothedElasticity, PatchTestAcrossAnInterface) {
  const TetMesh mesh = box_mesh({3, 3, 4}, kSize);
  const double mu = kE / 2.9, soft_stretch = 0.9;
  const MooneyRivlin<> soft(mu / 2, 0, 200 * mu), stiff(50 * mu, 0, 20000 * mu);
  const auto axial = [](const MooneyRivlin<>& material, double stretch) {
    return material.first_piola(Vec3(1, 1, stretch).asDiagonal())(2, 2);
  };
  double low = soft_stretch, high = 1;  // bisection for the stretch of the stiff layer
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (axial(stiff, middle) < axial(soft, soft_stretch) ? low : high) = middle;
  }
  std::vector<int> material;
  for (const auto& tet : mesh.tets.colwise()) {
    double z = 0;
    for (const int a : tet) z += mesh.X(2, a) / 4;
    material.push_back(z > kSize.z() / 2 ? 0 : 1);
  }
  const SmoothedElasticity elasticity(mesh.X, mesh.tets, {soft, stiff}, material);
  EXPECT_EQ(elasticity.num_pressures(), mesh.X.cols() + 4 * 4);
  Positions x = mesh.X;
  for (auto position : x.colwise()) {
    const double from_interface = position.z() - kSize.z() / 2;
    position.z() = from_interface * (from_interface > 0 ? soft_stretch : high);
  }
  const Positions f = internal_force(elasticity, x);
  const double face_force = std::abs(axial(soft, soft_stretch)) * kSize.x() * kSize.y();
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    const double Z = mesh.X(2, a);
    if (Z > 1e-9 && Z < kSize.z() - 1e-9) {
      EXPECT_LT(std::abs(f(2, a)), 1e-10 * face_force);
    }
  }
  const Eigen::MatrixXd stress = elasticity.cauchy_stress(x);
  EXPECT_LT((stress.row(2).array() - axial(soft, soft_stretch)).abs().maxCoeff(),
            1e-10 * std::abs(axial(soft, soft_stretch)));
}

TEST(SmoothedElasticity, InternalForceIsTheDerivativeOfTheEnergy) {
  const TetMesh mesh = box_mesh({2, 1, 2}, kSize);
  const SmoothedElasticity elasticity = layered(mesh);
  const Positions x = shaken(mesh, 0.08);
  const auto energy = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, elasticity.energy(v.reshaped(3, x.cols())));
  };
  const Eigen::RowVectorXd f = internal_force(elasticity, x).reshaped().transpose();
  EXPECT_LT(derivative_error(energy, x.reshaped(), f, 0.1 * kSize.z()), kDerivative);
  EXPECT_NEAR(elasticity.energy(x),
              elasticity.strain_energy_density(x).dot(Eigen::Map<const Eigen::VectorXd>(
                  elasticity.rest_volume().data(), mesh.tets.cols())),
              kIdentity * elasticity.energy(x));
}

TEST(SmoothedElasticity, StiffnessIsTheDerivativeOfTheInternalForce) {
  const TetMesh mesh = box_mesh({2, 1, 2}, kSize);
  const SmoothedElasticity elasticity = layered(mesh);
  const Positions x = shaken(mesh, 0.08);
  const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return internal_force(elasticity, v.reshaped(3, x.cols())).reshaped();
  };
  const Eigen::MatrixXd K = dense_stiffness(elasticity, x);
  EXPECT_LT(derivative_error(force, x.reshaped(), K, 0.1 * kSize.z()), kDerivative);
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
}

TEST(SmoothedElasticity, PredictedPressureIsThePressureToFirstOrder) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize);
  const SmoothedElasticity elasticity = layered(mesh);
  const Positions x = shaken(mesh, 0.05), direction = shaken(mesh, 1) - mesh.X;
  PressureGradient G = elasticity.make_pressure_gradient();
  elasticity.set_pressure_gradient(x, G);
  const auto error = [&](double step) {
    Eigen::VectorXd predicted, p;
    elasticity.predicted_pressure(x, G, step * direction, predicted);
    elasticity.pressure(x + step * direction, p);
    return (p - predicted).norm();
  };
  EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2, 0.02);
}

// Deep inside the range of what a projected tangent is for.
TEST(SmoothedElasticity, ProjectedTangentIsPositiveSemidefinite) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize);
  const SmoothedElasticity elasticity(mesh.X, mesh.tets, neo_hookean(0.45));
  const Positions x = 0.7 * shaken(mesh, 0.08);
  const auto lowest = [&](Tangent tangent) {
    const Eigen::VectorXd values = eigenvalues(dense_stiffness(elasticity, x, tangent));
    return values[0] / values.tail<1>()[0];
  };
  EXPECT_LT(lowest(Tangent::Consistent), -1e-3);
  EXPECT_GT(lowest(Tangent::Projected), -1e-13);
}

TEST(SmoothedElasticity, StiffnessAtRestHasSixZeroModes) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  for (const double nu : {0.3, 0.49, 0.4999}) {
    const SmoothedElasticity elasticity(mesh.X, mesh.tets, neo_hookean(nu));
    const Eigen::MatrixXd K = dense_stiffness(elasticity, mesh.X);
    const Eigen::VectorXd values = eigenvalues(K);
    EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), kIdentity * values.tail<1>()[0]);
    EXPECT_GT(values[6], 0.01 * lame_parameters(kE, nu).mu * kSize.z());  // the largest grow with κ
  }
}

TEST(SmoothedElasticity, EnergyIsInvariantAndForceTurnsWithARigidMotion) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  const SmoothedElasticity elasticity = layered(mesh);
  const Positions x = shaken(mesh, 0.05);
  const Mat3 R = Random().rotation();
  const Positions moved = (R * x).colwise() + Vec3(0.01, -0.03, 0.02);
  const Positions f = internal_force(elasticity, x), f_moved = internal_force(elasticity, moved);
  EXPECT_NEAR(elasticity.energy(moved), elasticity.energy(x), 1e-11 * elasticity.energy(x));
  EXPECT_LT((f_moved - R * f).norm(), 1e-11 * f.norm());
  Eigen::VectorXd p, p_moved;
  elasticity.pressure(x, p);
  elasticity.pressure(moved, p_moved);
  EXPECT_LT((p - p_moved).norm(), 1e-11 * p.norm());
}

TEST(SmoothedElasticity, NetForceAndNetMomentVanish) {
  const TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  for (const double amplitude : {0.01, 0.08}) {
    const Positions x = shaken(mesh, amplitude), f = internal_force(layered(mesh), x);
    Vec3 moment = Vec3::Zero();
    double scale = 0;
    for (Eigen::Index a = 0; a < x.cols(); ++a) {
      moment += Vec3(x.col(a)).cross(Vec3(f.col(a)));
      scale += x.col(a).norm() * f.col(a).norm();
    }
    EXPECT_LT(f.rowwise().sum().norm(), 1e-14 * f.cwiseAbs().sum());
    EXPECT_LT(moment.norm(), 1e-14 * scale);
  }
}

// Lengths in mm, or in units that make elements of 1e-14 m³: energy goes with the third power of
// length, force with the second, and the pressure stays.
TEST(SmoothedElasticity, DoesNotDependOnTheUnitOfLength) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  const Positions x = shaken(mesh, 0.05);
  const SmoothedElasticity elasticity = layered(mesh);
  Eigen::VectorXd p, p_scaled;
  elasticity.pressure(x, p);
  for (const double unit : {1e3, 1e-2}) {
    const SmoothedElasticity scaled = layered({unit * mesh.X, mesh.tets});
    EXPECT_LT(unit > 1 ? 0 : scaled.rest_volume()[0], 1e-13);
    EXPECT_NEAR(scaled.energy(unit * x) / std::pow(unit, 3), elasticity.energy(x),
                kIdentity * elasticity.energy(x));
    const Positions f = internal_force(elasticity, x);
    const Positions f_scaled = internal_force(scaled, unit * x);
    EXPECT_LT((f_scaled / (unit * unit) - f).norm(), kIdentity * f.norm());
    scaled.pressure(unit * x, p_scaled);
    EXPECT_LT((p_scaled - p).norm(), kIdentity * p.norm());
  }
}

// One step of Newton's method in a deformed state: both solvers against a dense solution, with a
// scale as a time step puts it, and a preconditioner of the same or of the smaller pattern.
TEST(SmoothedElasticity, LinearSolversAddThePressureByItsFactors) {
  const TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  const SmoothedElasticity elasticity = layered(mesh);
  const Positions x = shaken(mesh, 0.03);
  const double scale = 0.3;
  Eigen::VectorXd p;
  elasticity.pressure(x, p);
  BlockMatrix K = elasticity.make_matrix(), plain = elasticity.make_plain_matrix();
  elasticity.add_stiffness(x, p, Tangent::Projected, scale, K);
  elasticity.add_plain_stiffness(x, Tangent::Projected, scale, plain);
  const double shift = 0.1 * K.block(0)(0, 0);
  for (int i = 0; i < K.num_blocks(); ++i) {
    K.block(K.slot(i, i)) += shift * Mat3::Identity();
    plain.block(plain.slot(i, i)) += shift * Mat3::Identity();
  }
  PressureGradient G = elasticity.make_pressure_gradient();
  elasticity.set_pressure_gradient(x, G);
  const Eigen::MatrixXd expected = scale * dense_stiffness(elasticity, x, Tangent::Projected) +
                                   shift * Eigen::MatrixXd::Identity(3 * x.cols(), 3 * x.cols());
  const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(3 * x.cols(), 1);
  const Eigen::VectorXd solution = expected.llt().solve(b);
  const PressureTerm term{.G = &G, .pressure = &elasticity.nodal_pressure(), .scale = scale};
  const auto check = [&](LinearSolver& solver, const BlockMatrix* preconditioner) {
    const PressurePart part{.terms = {&term, 1}, .plain = preconditioner};
    ASSERT_EQ(solver.prepare_with_pressure(K, part), FactorStatus::Ready);
    Eigen::VectorXd u;
    const SolveReport report = solver.solve(b, u);
    EXPECT_TRUE(report.converged);
    EXPECT_LT((u - solution).norm(), 1e-8 * solution.norm());  // residual 1e-11, condition 1e3
    EXPECT_NEAR(report.relative_residual, (b - expected * u).norm() / b.norm(), 1e-13);
  };
  check(*make_conjugate_gradients(1e-11, 1000), nullptr);
  check(*make_saddle_point_solver(1e-11, 100), nullptr);
  check(*make_saddle_point_solver(1e-11, 100), &plain);
  EXPECT_THROW((void)make_cholesky()->prepare_with_pressure(K, {}), std::logic_error);
}

// A muscle between two fixed ends, whose fibres differ in direction from element to element.
class UnevenMuscle {
 public:
  explicit UnevenMuscle(double active_bulk)
      : mesh_(box_mesh({4, 2, 2}, kSize, 0.1)),
        x_(mesh_.X),
        elasticity_(mesh_.X, mesh_.tets,
                    BlemkerMuscle<LogVolumeChange>(MuscleFibre({.max_stress = 3e5}), kGround),
                    {.active_bulk = active_bulk}, uneven_fibres(mesh_.tets.cols())) {
    for (int a = 0; a < x_.cols(); ++a) {
      if (mesh_.X(0, a) > 1e-9 && mesh_.X(0, a) < kSize.x() - 1e-9)
        for (int i = 0; i < 3; ++i) free_.push_back(3 * a + i);
    }
  }

  /// To equilibrium at full activation, by way of lower ones.
  void contract() {
    for (const double activation : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
      for (int iteration = 0; iteration < 20; ++iteration) {
        const Eigen::VectorXd r = internal_force(activation).reshaped()(free_);
        if (r.norm() < 1e-10) break;
        ASSERT_LT(iteration, 19) << "at activation " << activation << " " << r.norm() << " N";
        const Eigen::MatrixXd K =
            dense_stiffness(elasticity_, x_, Tangent::Consistent, activation)(free_, free_);
        x_.reshaped()(free_) -= K.partialPivLu().solve(r);
      }
    }
  }
  /// Of the volumes of elements, by those at rest.
  double spread_of_volumes() const {
    const Eigen::ArrayXd change = elasticity_.volume_ratio(x_).array() - 1;
    return std::sqrt(change.square().mean());
  }
  /// What an end pulls with [N].
  double pull() const {
    const Positions f = internal_force(1);
    double force = 0;
    for (int a = 0; a < f.cols(); ++a) force += mesh_.X(0, a) < 1e-9 ? -f(0, a) : 0;
    return force;
  }

 private:
  static FibreDirections uneven_fibres(Eigen::Index count) {
    Random random;
    FibreDirections fibres = 0.3 * random.matrix<FibreDirections>(3, count);
    fibres.row(0).array() += 1;
    return fibres;
  }
  Positions internal_force(double activation) const {
    Positions f = Positions::Zero(3, x_.cols());
    elasticity_.add_internal_force(x_, f, activation);
    return f;
  }

  static constexpr BlemkerMuscle<LogVolumeChange>::Constants kGround = {
      .G1 = 5e3, .G2 = 5e3, .c10 = 1e4, .kappa = 1e7};
  TetMesh mesh_;
  Positions x_;
  SmoothedElasticity elasticity_;
  std::vector<int> free_;
};

// Where only a nodal pressure knows their volume, they grow and shrink by turns.
TEST(SmoothedElasticity, ElementsOfActiveMuscleKeepTheirVolume) {
  UnevenMuscle without(0), with(Smoothing{}.active_bulk);
  without.contract();
  with.contract();
  EXPECT_GT(without.spread_of_volumes(), 0.05);
  EXPECT_LT(with.spread_of_volumes(), 0.5 * without.spread_of_volumes());
  EXPECT_NEAR(with.pull(), without.pull(), 0.03 * without.pull());
}

TEST(SmoothedElasticity, RefusesBadInput) {
  const TetMesh mesh = box_mesh({1, 1, 1}, kSize);
  const std::vector<AnyMaterial> one{neo_hookean(0.4)};
  const auto make = [&](const std::vector<int>& material, const Smoothing& smoothing) {
    return SmoothedElasticity(mesh.X, mesh.tets, one, material, smoothing);
  };
  const std::vector<int> zeros(6, 0);
  EXPECT_NO_THROW(make(zeros, {}));
  EXPECT_THROW(make(zeros, {.plain_share = 1.1}), std::invalid_argument);
  EXPECT_THROW(make(zeros, {.active_bulk = -1}), std::invalid_argument);
  EXPECT_THROW(make(zeros, {.tau = 0}), std::invalid_argument);
  EXPECT_THROW(make({0, 0, 0}, {}), std::invalid_argument);
  EXPECT_THROW(make({0, 0, 0, 0, 0, 1}, {}), std::invalid_argument);
  TetMesh inverted = mesh;
  inverted.tets.col(2).head<2>().reverseInPlace();
  EXPECT_THROW(SmoothedElasticity(inverted.X, inverted.tets, one[0]), std::invalid_argument);
}

}  // namespace articular::fem::smoothed_elasticity_test
