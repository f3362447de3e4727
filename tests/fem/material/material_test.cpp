#include "fem/material/material.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/base/cofactor.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/corotated.hpp"
#include "fem/material/linear.hpp"
#include "fem/material/neo_hookean.hpp"
#include "fem/material/point_law.hpp"
#include "tests/fem/support/basic_laws.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

namespace articular::fem::material_test {

constexpr double kE = 2e4;            // [Pa] soft tissue
constexpr double kNu = 0.4;           // [-]
constexpr double kIdentity = 1e-12;   // [-] relative, a few roundings
constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences

/// Deformation gradients from small to large strain, a third of them inverted, all with
/// σ1 + σ2 > 0.2, so that polar rotations are smooth at the width of a difference step.
std::vector<Mat3> deformation_gradients() {
  Random random;
  std::vector<Mat3> result;
  for (const Vec3& sigma : {Vec3(1.01, 1, 0.98), Vec3(1.5, 1.2, 0.4), Vec3(0.9, 0.6, 0.3),
                            Vec3(3, 0.5, 0.2), Vec3(1.2, 1, -0.4), Vec3(0.8, 0.7, -0.1)}) {
    for (int k = 0; k < 4; ++k) {
      result.emplace_back(random.rotation() * sigma.asDiagonal() * random.rotation());
    }
  }
  return result;
}

class HyperelasticTest : public testing::TestWithParam<BasicLaw> {
 protected:
  static Mat9 tangent_at_rest(double nu) {
    const AnyMaterial other = GetParam().make(kE, nu);
    return PointLaw(other, {}, 0, 0).tangent(Mat3::Identity(), Tangent::Consistent);
  }
  double energy_density(const Mat3& F) const { return law_.energy_density(F); }
  Mat3 first_piola(const Mat3& F) const { return law_.first_piola(F); }
  Mat9 tangent(const Mat3& F) const { return law_.tangent(F, Tangent::Consistent); }

 private:
  AnyMaterial material_ = GetParam().make(kE, kNu);
  PointLaw law_{material_, {}, 0, 0};
};
INSTANTIATE_TEST_SUITE_P(All, HyperelasticTest, testing::ValuesIn(basic_laws()), name_of_law);

/// Those that hold for finite rotations.
class ObjectiveTest : public HyperelasticTest {};
INSTANTIATE_TEST_SUITE_P(All, ObjectiveTest, testing::ValuesIn(objective_laws()), name_of_law);

TEST_P(HyperelasticTest, RestStateHasNoEnergyAndNoStress) {
  EXPECT_LE(std::abs(energy_density(Mat3::Identity())), kIdentity * kE);
  EXPECT_LE(first_piola(Mat3::Identity()).norm(), kIdentity * kE);
}

TEST_P(HyperelasticTest, FirstPiolaIsTheDerivativeOfTheEnergy) {
  const auto energy = [this](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, energy_density(Mat3(v.reshaped(3, 3))));
  };
  for (const Mat3& F : deformation_gradients()) {
    const Eigen::RowVectorXd P = first_piola(F).reshaped().transpose();
    EXPECT_LT(derivative_error(energy, F.reshaped(), P, 1), kDerivative) << F;
  }
}

TEST_P(HyperelasticTest, TangentIsTheDerivativeOfTheFirstPiola) {
  const auto stress = [this](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return first_piola(Mat3(v.reshaped(3, 3))).reshaped();
  };
  for (const Mat3& F : deformation_gradients()) {
    const Mat9 C = tangent(F);
    EXPECT_LT(derivative_error(stress, F.reshaped(), C, 1), kDerivative) << F;
    EXPECT_LT((C - C.transpose()).norm(), kIdentity * C.norm());
  }
}

// Derivatives only agree with each other; that the moduli are those asked for is shown here, with
// Hooke's law solved for the strain, which knows no Lamé constants:
//   a stress σ along axis i alone strains by σ/E along it and −νσ/E across;
//   a shear stress τ alone strains by ε = (1 + ν) τ/E.
TEST_P(HyperelasticTest, SmallStrainLimitIsHookesLaw) {
  for (const double nu : {-0.3, 0.0, 0.3, 0.49}) {
    const Mat9 C = tangent_at_rest(nu);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      Mat3 strain = -nu / kE * Mat3::Identity(), stress = Mat3::Zero();
      strain(i, i) = 1 / kE;
      stress(i, i) = 1;
      EXPECT_LT((C * strain.reshaped() - stress.reshaped()).norm(), kIdentity) << nu;
      strain.setZero();
      stress.setZero();
      strain(i, j) = strain(j, i) = (1 + nu) / kE;
      stress(i, j) = stress(j, i) = 1;
      EXPECT_LT((C * strain.reshaped() - stress.reshaped()).norm(), kIdentity) << nu;
    }
  }
}

TEST_P(HyperelasticTest, SmallRotationsMakeNoStress) {
  const Mat9 C = tangent(Mat3::Identity());
  for (int k = 0; k < 3; ++k) {
    const Mat3 spin = cross_matrix(Vec3::Unit(k));
    EXPECT_LT((C * spin.reshaped()).norm(), kIdentity * C.norm());
  }
}

TEST_P(ObjectiveTest, EnergyIsInvariantAndStressTurnsWithARotation) {
  Random random;
  for (const Mat3& F : deformation_gradients()) {
    const Mat3 Q = random.rotation();
    const double psi = energy_density(F);
    const Mat3 P = first_piola(F);
    EXPECT_NEAR(energy_density(Q * F), psi, kIdentity * kE * (1 + psi / kE));
    EXPECT_LT((first_piola(Q * F) - Q * P).norm(), kIdentity * (kE + P.norm()));
    // Isotropy: the reference may be turned, too.
    EXPECT_NEAR(energy_density(F * Q), psi, kIdentity * kE * (1 + psi / kE));
    EXPECT_LT((first_piola(F * Q) - P * Q).norm(), kIdentity * (kE + P.norm()));
  }
}

TEST_P(HyperelasticTest, DegenerateDeformationsGiveFiniteValues) {
  const Vec3 a(1, 2, -1), b(0.5, -1, 2);
  for (const Mat3& F :
       {Mat3(Mat3::Zero()), Mat3(-Mat3::Identity()), Mat3(Vec3(1, 1, -1).asDiagonal()),
        Mat3(Vec3(1, 0, 0).asDiagonal()), Mat3(Vec3(1, 1, 0).asDiagonal()), Mat3(a * b.transpose()),
        Mat3(1e6 * Mat3::Identity())}) {
    EXPECT_TRUE(std::isfinite(energy_density(F))) << F;
    EXPECT_TRUE(first_piola(F).allFinite()) << F;
    EXPECT_TRUE(tangent(F).allFinite()) << F;
  }
}

// An element pushed through itself along z, F = diag(1, 1, s) with s from −0.9 to 1: the energy
// must fall all the way back to s = 1, in any orientation.
TEST_P(ObjectiveTest, InvertedElementIsPushedBack) {
  Random random;
  const Mat3 Q = random.rotation(), S = random.rotation();
  for (int tenths = -9; tenths <= 9; ++tenths) {
    const double s = tenths / 10.0;
    const Mat3 F = Q * Vec3(1, 1, s).asDiagonal() * S;
    const Mat3 way_back = Q * Vec3(0, 0, 1).asDiagonal() * S;
    const double slope = first_piola(F).cwiseProduct(way_back).sum();  // [Pa]
    EXPECT_LT(slope, -0.01 * kE) << s;
  }
}

TEST(Linear, CauchyStressIsTheOneStressOfTheTheory) {
  const Linear material(kE, kNu);
  const Mat3 F = Random().matrix3();
  EXPECT_EQ(material.cauchy_stress(F), material.first_piola(F));
  EXPECT_LT((material.cauchy_stress(F) - material.cauchy_stress(F).transpose()).norm(),
            kIdentity * kE);
}

TEST(Corotated, ProjectedTangentIsTheNearestPositiveSemidefiniteOne) {
  const Corotated material(kE, kNu);
  int indefinite = 0;
  for (const Mat3& F : deformation_gradients()) {
    const Mat9 C = material.tangent(F);
    const Mat9 expected = positive_part(C);
    EXPECT_LT((material.projected_tangent(F) - expected).norm(), kIdentity * C.norm());
    indefinite += eigenvalues(C)[0] < -1e-6 * C.norm() ? 1 : 0;
  }
  EXPECT_GT(indefinite, 5);
}

// Uniaxial tension of an incompressible neo-Hookean solid: P = μ (s − 1/s²). With ν short of 0.5
// the side stretch t follows from P₂₂ = 0, that is s t² = α − μ/(λ s), and P deviates by O(μ/λ) =
// O(1 − 2ν).
TEST(NeoHookean, UniaxialTensionNearIncompressibilityFollowsTheClosedForm) {
  const double nu = 0.5 - 1e-7;
  const NeoHookean material(kE, nu);
  const auto [mu, lambda] = lame_parameters(kE, nu);
  for (const double s : {0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 2.0}) {
    const double shifted = lambda + mu, t2 = (1 + mu / shifted - mu / (shifted * s)) / s;
    const Mat3 P = material.first_piola(Vec3(s, std::sqrt(t2), std::sqrt(t2)).asDiagonal());
    EXPECT_NEAR(P(1, 1), 0, 1e-8 * mu);  // λ/μ = 5e6 roundings
    EXPECT_NEAR(P(0, 0), mu * (s - 1 / (s * s)), 1e-5 * mu) << s;
  }
}

// The known price of leaving out the barrier: under F = s I the slope of the energy is
// tr P = 3 λ s (1 − s)(1 − 2ν − s − s² − s³), with the shifted λ = μ/(1 − 2ν).
TEST(NeoHookean, UniformlyCrushedElementReturnsOnlyFromAboveTheSecondMinimum) {
  for (const double nu : {0.0, 0.3, 0.45}) {
    const NeoHookean material(kE, nu);
    const double mu = lame_parameters(kE, nu).mu, lambda = mu / (1 - 2 * nu);
    for (const double s : {0.05, 0.1, 0.3, 0.6, 0.9}) {
      const double expected = 3 * lambda * s * (1 - s) * (1 - 2 * nu - s - s * s - s * s * s);
      EXPECT_NEAR(material.first_piola(s * Mat3::Identity()).trace(), expected, kIdentity * lambda);
    }
  }
}

std::string message_of(double E, double nu) {
  try {
    (void)lame_parameters(E, nu);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LameParameters, AreThoseOfTheTextbook) {
  // μ = E / 2(1 + ν), and the bulk modulus λ + 2μ/3 = E / 3(1 − 2ν).
  for (const double nu : {-0.5, 0.0, 0.25, 0.49}) {
    const auto [mu, lambda] = lame_parameters(kE, nu);
    EXPECT_NEAR(2 * mu * (1 + nu), kE, kIdentity * kE);
    EXPECT_NEAR(3 * (1 - 2 * nu) * (lambda + 2 * mu / 3), kE, kIdentity * kE);
  }
}

TEST(LameParameters, RefuseWhatIsNoElasticSolidAndSayWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of(1e4, 0.3), "");
  for (const double E : {0.0, -3.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(message_of(E, 0.3).find("Young's modulus"), std::string::npos) << E;
  }
  for (const double nu : {-1.0, 0.5, 0.7, nan}) {
    EXPECT_NE(message_of(1e4, nu).find("between -1 and 0.5"), std::string::npos) << nu;
  }
  EXPECT_NE(message_of(-3, 0.3).find("-3 Pa"), std::string::npos);
}

}  // namespace articular::fem::material_test
