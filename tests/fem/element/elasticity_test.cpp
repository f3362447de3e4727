#include "fem/element/elasticity.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "fem/material/projected_tangent.hpp"
#include "fem/material/von_mises.hpp"
#include "tests/fem/support/basic_laws.hpp"
#include "tests/fem/support/box_mesh.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/fixed_nodes.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

namespace articular::fem::elasticity_test {

constexpr double kE = 2e4;            // [Pa] soft tissue
constexpr double kNu = 0.4;           // [-]
constexpr double kIdentity = 1e-12;   // [-] relative, round-off
constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences
const Vec3 kSize(0.02, 0.01, 0.005);  // [m]

class ElasticityTest : public testing::TestWithParam<BasicLaw> {
 protected:
  static AnyMaterial material_of(double nu) { return GetParam().make(kE, nu); }
  static Elasticity elasticity_of(const TetMesh& mesh, double nu = kNu) {
    return {mesh.X, mesh.tets, material_of(nu)};
  }
};
INSTANTIATE_TEST_SUITE_P(All, ElasticityTest, testing::ValuesIn(basic_laws()), name_of_law);

class ObjectiveElasticityTest : public ElasticityTest {};
INSTANTIATE_TEST_SUITE_P(All, ObjectiveElasticityTest, testing::ValuesIn(objective_laws()),
                         name_of_law);

Positions internal_force(const Elasticity& elasticity, const Positions& x) {
  Positions f = Positions::Zero(3, x.cols());
  elasticity.add_internal_force(x, f);
  return f;
}

BlockMatrix stiffness_matrix(const Elasticity& elasticity, const Positions& x,
                             Tangent tangent = Tangent::Consistent) {
  BlockMatrix K = elasticity.make_matrix();
  elasticity.add_stiffness(x, tangent, 1, K);
  return K;
}

bool on_boundary(const Vec3& X) {
  const Vec3 to_face = X.cwiseMin(kSize - X);
  return to_face.minCoeff() < 1e-9;
}

/// Positions away from rest by up to `amplitude` of a cell: at 1 many elements are inverted.
Positions shaken(const TetMesh& mesh, double amplitude) {
  const double cell = (mesh.X.col(mesh.tets(1, 0)) - mesh.X.col(mesh.tets(0, 0))).norm();
  return mesh.X + amplitude * cell * Random().matrix<Positions>(3, mesh.X.cols());
}

/// Shaken a little and pressed together in all directions.
Positions crushed(const TetMesh& mesh) { return 0.6 * shaken(mesh, 0.1); }

// Linear elements hold an affine displacement exactly, on any mesh: the stress is that of the
// material at this F in every element, and no inner node feels a force.
TEST_P(ElasticityTest, PatchTestUniformStressInAnyMesh) {
  const TetMesh mesh = box_mesh({3, 4, 3}, kSize, 0.15);
  Mat3 F;
  F << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.1, 0.1, 1.2;
  const Positions x = (F * mesh.X).colwise() + Vec3(0.3, -0.2, 0.1);
  for (const double nu : {0.3, 0.499}) {
    const AnyMaterial material = material_of(nu);
    const Elasticity elasticity = elasticity_of(mesh, nu);
    const Positions f = internal_force(elasticity, x);
    const double face_force =
        PointLaw(material, {}, 0, 0).first_piola(F).norm() * kSize.squaredNorm();
    int inner = 0;
    for (Eigen::Index a = 0; a < mesh.X.cols(); ++a) {
      if (on_boundary(mesh.X.col(a))) continue;
      ++inner;
      EXPECT_LT(f.col(a).norm(), kIdentity * face_force);
    }
    EXPECT_EQ(inner, 2 * 3 * 2);
    const Eigen::MatrixXd stress = elasticity.cauchy_stress(x);
    const double scale = stress.norm() / std::sqrt(static_cast<double>(stress.cols()));
    EXPECT_LT((stress.colwise() - stress.col(0)).norm(), 1e-10 * scale);  // 1/(1 − 2ν) roundings
  }
}

// The same with the inner nodes unknown, from the undeformed state. Newton's method converges
// quadratically: eight steps are more than it takes.
TEST_P(ElasticityTest, PatchTestBoundaryDeterminesTheInside) {
  const TetMesh mesh = box_mesh({3, 4, 3}, kSize, 0.15);
  Mat3 F;
  F << 1.05, 0.04, -0.02, 0.03, 0.96, 0.05, -0.01, 0.02, 1.04;
  const Positions expected = F * mesh.X;
  const Elasticity elasticity = elasticity_of(mesh);
  std::vector<bool> fixed;
  for (const auto& X : mesh.X.colwise()) fixed.push_back(on_boundary(X));
  Positions x = mesh.X;
  for (int step = 0; step < 8; ++step) {
    Positions dx = Positions::Zero(3, x.cols());
    for (int a = 0; a < x.cols(); ++a) {
      if (fixed[a]) dx.col(a) = expected.col(a) - x.col(a);
    }
    solve_with_fixed_nodes(stiffness_matrix(elasticity, x), -internal_force(elasticity, x), fixed,
                           dx);
    x += dx;
  }
  EXPECT_LT((x - expected).norm(), kIdentity * expected.norm());
}

// A tissue column between rigid walls, squeezed to the stretch s along z: F = diag(1, 1, s).
// The force on the top face is P₃₃ A, and for each of these materials P₃₃ = (λ + 2μ)(s − 1): the
// aggregate modulus H_A = λ + 2μ, at any strain. Linear elements hold a uniform F exactly,
// so the tolerance is round-off and does not depend on the mesh.
TEST_P(ElasticityTest, ConfinedCompressionGivesTheAggregateModulus) {
  const TetMesh mesh = box_mesh({3, 4, 5}, kSize, 0.15);
  const auto [mu, lambda] = lame_parameters(kE, kNu);
  for (const double s : {0.2, 0.7, 1.3}) {
    const Positions x = Vec3(1, 1, s).asDiagonal() * mesh.X;
    const Positions f = internal_force(elasticity_of(mesh), x);
    double reaction = 0;  // [N]
    for (Eigen::Index a = 0; a < mesh.X.cols(); ++a) {
      if (mesh.X(2, a) > kSize.z() - 1e-9) reaction += f(2, a);
    }
    const double expected = (lambda + 2 * mu) * (s - 1) * kSize.x() * kSize.y();
    EXPECT_NEAR(reaction, expected, kIdentity * std::abs(expected));
  }
}

TEST_P(ElasticityTest, OutputsOfAUniformStateAreThoseOfTheMaterial) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  const AnyMaterial material = material_of(kNu);
  const Elasticity elasticity = elasticity_of(mesh);
  const Mat3 F = Vec3(1, 1, 1.3).asDiagonal();
  const Positions x = F * mesh.X;
  const double volume = kSize.prod(), psi = PointLaw(material, {}, 0, 0).energy_density(F);
  EXPECT_NEAR(elasticity.energy(x), volume * psi, kIdentity * volume * psi);
  EXPECT_LT((elasticity.volume_ratio(x).array() - 1.3).matrix().norm(), 1e-12);
  EXPECT_LT((elasticity.strain_energy_density(x).array() - psi).matrix().norm(), 1e-10 * psi);
  // The cross section keeps its area: along z Cauchy's stress is the nominal one, H_A (s − 1).
  const auto [mu, lambda] = lame_parameters(kE, kNu);
  const double axial = (lambda + 2 * mu) * 0.3;
  const Eigen::MatrixXd stress = elasticity.cauchy_stress(x);
  const Eigen::VectorXd equivalent = von_mises(elasticity.cauchy_stress(x));
  for (Eigen::Index e = 0; e < stress.cols(); ++e) {
    EXPECT_NEAR(stress(2, e), axial, 1e-10 * axial);
    EXPECT_NEAR(stress(0, e), stress(1, e), 1e-10 * axial);
    EXPECT_LT(stress.col(e).tail<3>().norm(), 1e-10 * axial);
    EXPECT_NEAR(equivalent[e], std::abs(stress(2, e) - stress(0, e)), 1e-10 * axial);
  }
}

// Simple shear strains the linear model only in xy: the order of the components shows.
TEST(Elasticity, CauchyStressIsOrderedXxYyZzXyYzXz) {
  const TetMesh mesh = box_mesh({1, 1, 1}, kSize);
  const Elasticity elasticity(mesh.X, mesh.tets, Linear(kE, kNu));
  const double mu = lame_parameters(kE, kNu).mu;
  const int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    Mat3 F = Mat3::Identity();
    F(i, j) = 0.01;
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
    expected[component[i][j]] = 0.01 * mu;
    const Eigen::MatrixXd stress = elasticity.cauchy_stress(F * mesh.X);
    EXPECT_LT((stress.colwise() - expected).norm(), 1e-10 * mu);
  }
}

TEST_P(ElasticityTest, NetForceVanishesInAnyState) {
  const TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  for (const double amplitude : {0.1, 1.0, 5.0}) {
    const Positions f = internal_force(elasticity_of(mesh), shaken(mesh, amplitude));
    EXPECT_LT(f.rowwise().sum().norm(), 1e-14 * f.cwiseAbs().sum());
  }
}

TEST_P(ObjectiveElasticityTest, NetMomentVanishesInAnyState) {
  const TetMesh mesh = box_mesh({3, 2, 2}, kSize, 0.15);
  for (const double amplitude : {0.1, 1.0, 5.0}) {
    const Positions x = shaken(mesh, amplitude);
    const Positions f = internal_force(elasticity_of(mesh), x);
    Vec3 moment = Vec3::Zero();
    double scale = 0;
    for (Eigen::Index a = 0; a < x.cols(); ++a) {
      moment += Vec3(x.col(a)).cross(Vec3(f.col(a)));
      scale += x.col(a).norm() * f.col(a).norm();
    }
    EXPECT_LT(moment.norm(), 1e-14 * scale);
  }
}

TEST_P(ElasticityTest, InternalForceIsTheDerivativeOfTheEnergy) {
  const TetMesh mesh = box_mesh({2, 1, 1}, kSize);
  const Elasticity elasticity = elasticity_of(mesh);
  const Positions x = shaken(mesh, 0.2);
  const auto energy = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, elasticity.energy(v.reshaped(3, x.cols())));
  };
  const Eigen::RowVectorXd f = internal_force(elasticity, x).reshaped().transpose();
  EXPECT_LT(derivative_error(energy, x.reshaped(), f, kSize.z()), kDerivative);
}

TEST_P(ElasticityTest, StiffnessIsTheDerivativeOfTheInternalForce) {
  const TetMesh mesh = box_mesh({2, 1, 1}, kSize);
  const Elasticity elasticity = elasticity_of(mesh);
  const Positions x = shaken(mesh, 0.2);
  const auto force = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return internal_force(elasticity, v.reshaped(3, x.cols())).reshaped();
  };
  const Eigen::MatrixXd K = dense(stiffness_matrix(elasticity, x));
  EXPECT_LT(derivative_error(force, x.reshaped(), K, kSize.z()), kDerivative);
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
}

TEST_P(ElasticityTest, StiffnessIsAddedWithItsScale) {
  const TetMesh mesh = box_mesh({2, 1, 1}, kSize);
  const Elasticity elasticity = elasticity_of(mesh);
  const Positions x = shaken(mesh, 0.2);
  BlockMatrix K = stiffness_matrix(elasticity, x);
  const Eigen::MatrixXd once = dense(K);
  elasticity.add_stiffness(x, Tangent::Consistent, -0.25, K);
  EXPECT_LT((dense(K) - 0.75 * once).norm(), 1e-14 * once.norm());
}

// At rest only rigid motions are free: six zero modes, and all others are stiff.
TEST_P(ElasticityTest, StiffnessAtRestHasSixZeroModes) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  for (const Tangent tangent : {Tangent::Consistent, Tangent::Projected}) {
    const Eigen::MatrixXd K = dense(stiffness_matrix(elasticity_of(mesh), mesh.X, tangent));
    const Eigen::VectorXd values = eigenvalues(K);
    const double largest = values.tail<1>()[0];
    EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), kIdentity * largest);
    EXPECT_GT(values[6], 1e-4 * largest);
  }
}

double lowest_relative_eigenvalue(const BlockMatrix& K) {
  const Eigen::VectorXd values = eigenvalues(dense(K));
  return values[0] / values.tail<1>()[0];
}

TEST_P(ElasticityTest, ProjectedStiffnessIsPositiveSemidefinite) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  const Elasticity elasticity = elasticity_of(mesh);
  for (const Positions& x : {crushed(mesh), shaken(mesh, 0.1), shaken(mesh, 1), shaken(mesh, 5)}) {
    EXPECT_GT(lowest_relative_eigenvalue(stiffness_matrix(elasticity, x, Tangent::Projected)),
              -kIdentity);
  }
}

TEST_P(ObjectiveElasticityTest, ConsistentStiffnessIsIndefiniteWhereCrushed) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  EXPECT_LT(lowest_relative_eigenvalue(stiffness_matrix(elasticity_of(mesh), crushed(mesh))),
            -1e-3);
}

TEST_P(ElasticityTest, ProjectionLeavesTheRestStateAlone) {
  const TetMesh mesh = box_mesh({2, 2, 2}, kSize, 0.15);
  const Elasticity elasticity = elasticity_of(mesh);
  const Eigen::MatrixXd K = dense(stiffness_matrix(elasticity, mesh.X));
  const Eigen::MatrixXd projected = dense(stiffness_matrix(elasticity, mesh.X, Tangent::Projected));
  EXPECT_LT((projected - K).norm(), kIdentity * K.norm());
}

TEST_P(ElasticityTest, SameBitsEveryTime) {
  const TetMesh mesh = box_mesh({3, 3, 3}, kSize, 0.15);
  const Positions x = shaken(mesh, 0.5);
  const Elasticity first = elasticity_of(mesh), second = elasticity_of(mesh);
  EXPECT_EQ(internal_force(first, x), internal_force(second, x));
  EXPECT_EQ(dense(stiffness_matrix(first, x)), dense(stiffness_matrix(second, x)));
}

std::string refusal(const Positions& X, const Tetrahedra& tets) {
  try {
    const Elasticity elasticity(X, tets, NeoHookean(kE, kNu));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Elasticity, RefusesBadElementsAndNamesThem) {
  const TetMesh mesh = box_mesh({1, 1, 1}, Vec3(1, 1, 1));
  const Eigen::Vector4i nodes = mesh.tets.col(4);
  EXPECT_EQ(refusal(mesh.X, mesh.tets), "");

  Tetrahedra tets = mesh.tets;
  tets.col(4) << nodes[1], nodes[0], nodes[2], nodes[3];
  const std::string inverted = refusal(mesh.X, tets);
  const std::string name =
      (std::stringstream() << "tetrahedron 4 (nodes " << tets.col(4).transpose()).str();
  EXPECT_EQ(inverted.find(name), 0U) << inverted;
  EXPECT_NE(inverted.find("inverted"), std::string::npos) << inverted;
  EXPECT_NE(inverted.find("-0.1666"), std::string::npos) << inverted;

  tets.col(4) << nodes[0], nodes[1], nodes[2], nodes[2];
  EXPECT_NE(refusal(mesh.X, tets).find("flat"), std::string::npos);

  for (const int bad : {-1, 8}) {
    tets.col(4) << nodes[0], nodes[1], nodes[2], bad;
    EXPECT_NE(refusal(mesh.X, tets).find("out of range"), std::string::npos);
  }

  Positions X = mesh.X;
  X(0, nodes[3]) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(X, mesh.tets), "");
  EXPECT_NE(refusal(1e-3 * Vec3(1, 1, 0).asDiagonal() * mesh.X, mesh.tets).find("tetrahedron 0"),
            std::string::npos);
}

// The threshold is relative: a micrometre mesh passes, a flattened one does not at any size.
TEST(Elasticity, FlatnessDoesNotDependOnTheSize) {
  const TetMesh mesh = box_mesh({1, 1, 1}, Vec3(1, 1, 1));
  for (const double size : {1e-6, 1.0, 1e3}) {
    EXPECT_EQ(refusal(size * mesh.X, mesh.tets), "");
    EXPECT_EQ(refusal(size * Vec3(1, 1, 1e-9).asDiagonal() * mesh.X, mesh.tets), "");
    EXPECT_NE(refusal(size * Vec3(1, 1, 1e-13).asDiagonal() * mesh.X, mesh.tets), "");
  }
}

}  // namespace articular::fem::elasticity_test
