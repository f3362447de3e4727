#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "fem/base/cofactor.hpp"
#include "fem/base/rotation_svd.hpp"
#include "fem/material/von_mises.hpp"
#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/dense.hpp"
#include "tests/fem/support/laws.hpp"
#include "tests/fem/support/random_matrices.hpp"
#include "tests/fem/support/spectrum.hpp"

// Properties that every law has, whatever it says of tissue.
namespace articular::fem::law_properties_test {

constexpr double kIdentity = 1e-12;   // [-] relative, a few roundings
constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences
constexpr double kActivations[] = {0, 0.7};

/// Small to large strain, and fibres slack, in the toe, taut and beyond the reach of their
/// activation; none inverted.
std::vector<Mat3> deformation_gradients() {
  Random random;
  std::vector<Mat3> result;
  for (const Vec3& sigma :
       {Vec3(1.01, 1, 0.98), Vec3(1.5, 1.2, 0.4), Vec3(0.9, 0.6, 0.3), Vec3(3, 0.5, 0.2)}) {
    for (int k = 0; k < 4; ++k)
      result.emplace_back(random.rotation() * sigma.asDiagonal() * random.rotation());
  }
  Mat3 frame;
  frame << kFibre, kAcross, kFibre.cross(kAcross);
  for (const double stretch : {0.35, 0.5, 0.8, 0.95, 1.02, 1.04, 1.1, 1.3, 1.55, 1.9}) {
    Mat3 U = Vec3(stretch, 1.2 / std::sqrt(stretch), 0.85 / std::sqrt(stretch)).asDiagonal();
    U(0, 1) = 0.2;
    U(0, 2) = -0.1;
    U(1, 2) = 0.15;
    result.emplace_back(random.rotation() * frame * U * frame.transpose());
  }
  return result;
}

class LawTest : public testing::TestWithParam<LawExample> {
 protected:
  const LawExample& example = GetParam();

  /// Whether the law has a number there. @param F  not inverted
  bool bears(const Mat3& F) const {
    return rotation_svd(F).sigma[2] > example.promise.least_stretch;
  }
  /// Those of all that it has numbers for.
  std::vector<Mat3> gradients() const {
    std::vector<Mat3> result = deformation_gradients();
    std::erase_if(result, [this](const Mat3& F) { return !bears(F); });
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(All, LawTest, testing::ValuesIn(all_laws()),
                         [](const auto& info) { return info.param.name; });

TEST_P(LawTest, PassiveRestStateHasNoEnergyAndNoStress) {
  const Jet rest = example.law(example.promise.rest, 0);
  EXPECT_LE(std::abs(rest.value), kIdentity * example.scale);
  EXPECT_LE(rest.gradient.norm(), kIdentity * example.scale);
}

TEST_P(LawTest, StressAndTangentAreDerivatives) {
  for (const double activation : kActivations) {
    const auto energy = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, example.law(Mat3(v.reshaped(3, 3)), activation).value);
    };
    const auto first_piola = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
      return example.law(Mat3(v.reshaped(3, 3)), activation).gradient.reshaped();
    };
    for (const Mat3& F : gradients()) {
      const Jet law = example.law(F, activation);
      const Eigen::RowVectorXd P = law.gradient.reshaped().transpose();
      EXPECT_LT(derivative_error(energy, F.reshaped(), P, 1), kDerivative) << F;
      EXPECT_LT(derivative_error(first_piola, F.reshaped(), law.hessian, 1), kDerivative) << F;
      EXPECT_LT((law.hessian - law.hessian.transpose()).norm(), kIdentity * law.hessian.norm());
    }
  }
}

TEST_P(LawTest, DilatationHasItsDerivatives) {
  const auto value = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, example.dilatation(Mat3(v.reshaped(3, 3))).value);
  };
  const auto gradient = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return example.dilatation(Mat3(v.reshaped(3, 3))).gradient.reshaped();
  };
  for (const Mat3& F : gradients()) {
    const Jet theta = example.dilatation(F);
    const Eigen::RowVectorXd g = theta.gradient.reshaped().transpose();
    EXPECT_LT(derivative_error(value, F.reshaped(), g, 1), kDerivative) << F;
    if (theta.hessian.norm() > 0) {
      EXPECT_LT(derivative_error(gradient, F.reshaped(), theta.hessian, 1), kDerivative) << F;
    }
  }
  const Jet rest = example.dilatation(Mat3::Identity());
  EXPECT_EQ(rest.value, 0);
  EXPECT_LT((rest.gradient - Mat3::Identity()).norm(), kIdentity);
}

TEST_P(LawTest, EnergyIsInvariantAndStressTurnsWithARotation) {
  if (!example.promise.objective) GTEST_SKIP() << "for small rotations only";
  Random random;
  for (const Mat3& F : gradients()) {
    const Mat3 Q = random.rotation();
    const Jet law = example.law(F, 0.7), turned = example.law(Q * F, 0.7);
    EXPECT_NEAR(turned.value, law.value, kIdentity * (example.scale + std::abs(law.value)));
    EXPECT_LT((turned.gradient - Q * law.gradient).norm(),
              1e-11 * (example.scale + law.gradient.norm()));
  }
}

// The reference may be turned too: about the fibres, or at will where there are none, and the
// fibres may be turned round.
TEST_P(LawTest, ReferenceMayBeTurnedAboutTheFibres) {
  if (!example.promise.objective) GTEST_SKIP() << "for small rotations only";
  Random random;
  const Mat3 half_turn = Eigen::AngleAxisd(std::numbers::pi, kAcross).toRotationMatrix();
  for (const Mat3& F : gradients()) {
    const Mat3 about = Eigen::AngleAxisd(random.uniform(-3, 3), kFibre).toRotationMatrix();
    std::vector<Mat3> rotations{about, half_turn};
    if (!example.fibred) rotations.push_back(random.rotation());
    const Jet law = example.law(F, 0.7);
    for (const Mat3& Q : rotations) {
      const Jet turned = example.law(F * Q, 0.7);
      EXPECT_NEAR(turned.value, law.value, kIdentity * (example.scale + std::abs(law.value)));
      EXPECT_LT((turned.gradient - law.gradient * Q).norm(),
                1e-11 * (example.scale + law.gradient.norm()));
    }
  }
}

TEST_P(LawTest, FibresAndActivationMakeADifferenceWhereThereAreAny) {
  const Mat3 F = Mat3::Identity() + 0.2 * kFibre * kFibre.transpose();
  const Mat3 Q = Eigen::AngleAxisd(1, kAcross).toRotationMatrix();
  const double passive = example.law(F, 0).value;
  const double turned = example.law(Q * F * Q.transpose(), 0).value;
  EXPECT_EQ(std::abs(turned - passive) > 1e-3 * passive, example.fibred);
  EXPECT_EQ(std::abs(example.law(F, 0.7).value - passive) > 1e-3 * passive, example.fibred);
}

TEST_P(LawTest, PassiveEnergyIsNowhereNegative) {
  Random random;
  int large = 0;
  for (int k = 0; k < 2000; ++k) {
    const Mat3 F = Mat3::Identity() + random.uniform(0, 2) * random.matrix3();
    if (F.determinant() < 1e-3 || !bears(F)) continue;
    EXPECT_GE(example.law(F, 0).value, -kIdentity * example.scale) << F;
    ++large;
  }
  EXPECT_GT(large, example.promise.least_stretch > 0 ? 100 : 500);
}

TEST_P(LawTest, DistortionAndDilatationAddUpToTheLaw) {
  const double kappa = example.bulk_modulus;
  for (const Mat3& F : gradients()) {
    const Jet law = example.law(F, 0.7), theta = example.dilatation(F);
    const Vec9 of_theta = theta.gradient.reshaped();
    Jet sum = example.distortion(F, 0.7);
    sum.value += 0.5 * kappa * theta.value * theta.value;
    sum.gradient += kappa * theta.value * theta.gradient;
    sum.hessian += kappa * (theta.value * theta.hessian + of_theta * of_theta.transpose());
    EXPECT_NEAR(law.value, sum.value, kIdentity * (kappa + std::abs(law.value)));
    EXPECT_LT((law.gradient - sum.gradient).norm(), kIdentity * (kappa + law.gradient.norm()));
    EXPECT_LT((law.hessian - sum.hessian).norm(), kIdentity * (kappa + law.hessian.norm()));
  }
}

TEST_P(LawTest, DistortionIsThatOfTheShapeAlone) {
  if (!example.promise.shape_only) GTEST_SKIP() << "the distortion depends on the volume";
  for (const Mat3& F : gradients()) {
    const Jet d = example.distortion(F, 0.7);
    EXPECT_NEAR(example.distortion(1.7 * F, 0.7).value, d.value, 1e-11 * std::abs(d.value));
    EXPECT_NEAR(d.gradient.cwiseProduct(F).sum(), 0, 1e-11 * d.gradient.norm() * F.norm());
  }
}

// Hooke's law: at rest all resistance to a change of volume is the bulk modulus, and every shear
// meets the shear modulus, both for the law and for its distortion. Slack fibres do not matter.
TEST_P(LawTest, SmallStrainLimitIsHookesLaw) {
  const double kappa = example.bulk_modulus, mu = example.shear_modulus;
  const Mat3& rest = example.promise.rest;
  const Mat9 C = with_prestretch(example.law(rest, 0).hessian, rest);  // by strain from there
  const Mat9 C_d = with_prestretch(example.distortion(rest, 0).hessian, rest);
  const double round_off = 1e-11 * C.norm();
  const Vec9 volume = Mat3::Identity().reshaped();
  EXPECT_LT((C * volume - 3 * kappa * volume).norm(), round_off);
  EXPECT_LT((C_d * volume).norm(), round_off);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT((C * cross_matrix(Vec3::Unit(k)).reshaped()).norm(), round_off);
  if (!example.promise.one_shear_modulus) return;
  Random random;
  for (int k = 0; k < 10; ++k) {
    const Mat3 A = random.matrix3(), strain = 0.5 * (A + A.transpose());
    const Mat3 shear = strain - strain.trace() / 3 * Mat3::Identity();
    EXPECT_LT((C * shear.reshaped() - 2 * mu * shear.reshaped()).norm(), round_off);
    EXPECT_LT((C_d * shear.reshaped() - 2 * mu * shear.reshaped()).norm(), round_off);
  }
}

/// One tetrahedron with its edges along the axes, so that ∂N/∂X of its last nodes are unit vectors.
Positions unit_tetrahedron() {
  Positions X(3, 4);
  X << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  return X;
}
Elasticity one_element(const LawExample& example) {
  return {unit_tetrahedron(), Tetrahedra(Eigen::Vector4i(0, 1, 2, 3)), example.material,
          FibreDirections(kFibre)};
}

double lowest_relative_eigenvalue(const Eigen::MatrixXd& K) {
  const Eigen::VectorXd values = eigenvalues(K);
  return values[0] / values.tail<1>()[0];
}

TEST_P(LawTest, ProjectedTangentIsPositiveSemidefinite) {
  const Elasticity element = one_element(example);
  int indefinite = 0;
  for (const Mat3& F : gradients()) {
    const Positions x = F * unit_tetrahedron();
    BlockMatrix consistent = element.make_matrix(), projected = element.make_matrix();
    element.add_stiffness(x, Tangent::Consistent, 1, consistent, 0.7);
    element.add_stiffness(x, Tangent::Projected, 1, projected, 0.7);
    EXPECT_GT(lowest_relative_eigenvalue(dense(projected)), -kIdentity);
    if (lowest_relative_eigenvalue(dense(consistent)) < -1e-6) ++indefinite;
  }
  if (example.promise.objective) {
    EXPECT_GT(indefinite, 3);
  }
}

// Nor is it softer, as long as the volume is kept: there, the parts of a fibre that are left out
// cancel.
TEST_P(LawTest, ProjectedTangentIsNowhereSofterAtConstantVolume) {
  const Elasticity element = one_element(example);
  Random random;
  for (const Mat3& F : gradients()) {
    const Positions x = F * unit_tetrahedron();
    BlockMatrix consistent = element.make_matrix(), projected = element.make_matrix();
    element.add_stiffness(x, Tangent::Consistent, 1, consistent, 0.7);
    element.add_stiffness(x, Tangent::Projected, 1, projected, 0.7);
    const Eigen::MatrixXd difference = dense(projected) - dense(consistent);
    const Vec9 by_volume = Vec9(F.inverse().transpose().reshaped()).normalized();
    for (int k = 0; k < 20; ++k) {
      Vec9 change = random.matrix<Vec9>(9, 1);
      change -= by_volume.dot(change) * by_volume;
      Eigen::VectorXd u = Eigen::VectorXd::Zero(12);
      u.tail<9>() = change;  // unit vectors are the gradients of these nodes
      EXPECT_GT(u.dot(difference * u), -1e-12 * dense(consistent).norm() * u.squaredNorm()) << F;
    }
  }
}

// A mesh hands through the law of its element, with its activation.
TEST_P(LawTest, ElementHasTheEnergyAndStressOfTheLaw) {
  const Elasticity element = one_element(example);
  const Mat3 F = gradients().back();
  const Positions x = F * unit_tetrahedron();
  for (const double activation : kActivations) {
    const Jet law = example.law(F, activation);
    EXPECT_NEAR(element.energy(x, activation), law.value / 6, kIdentity * std::abs(law.value));
    EXPECT_NEAR(element.strain_energy_density(x, activation)[0], law.value,
                kIdentity * std::abs(law.value));
    Positions f = Positions::Zero(3, 4);
    element.add_internal_force(x, f, activation);
    EXPECT_LT((f.rightCols<3>() - law.gradient / 6).norm(), kIdentity * law.gradient.norm());
    if (!example.promise.objective) continue;
    const Mat3 sigma = law.gradient * F.transpose() / F.determinant();
    const Eigen::MatrixXd stress = element.cauchy_stress(x, activation);
    EXPECT_NEAR(stress(1), sigma(1, 1), kIdentity * sigma.norm());
    EXPECT_NEAR(stress(5), sigma(0, 2), kIdentity * sigma.norm());
    EXPECT_NEAR(von_mises(element.cauchy_stress(x, activation))[0],
                std::sqrt(1.5) * (sigma - sigma.trace() / 3 * Mat3::Identity()).norm(),
                kIdentity * sigma.norm());
  }
  EXPECT_NEAR(element.fibre_stretch(x)[0],
              (F * kFibre).norm() / (example.promise.rest * kFibre).norm(), kIdentity);
}

// Laws for J > 0 give no number where an element is inverted, so that a solver that asks notices,
// and its projection comes to an end there.
TEST_P(LawTest, InvertedElementHasAnEnergyOrNoNumber) {
  const Elasticity element = one_element(example);
  const Positions x = Vec3(1.1, 0.9, -0.8).asDiagonal() * unit_tetrahedron();
  EXPECT_EQ(std::isnan(element.energy(x)), !example.promise.inverted);
  BlockMatrix K = element.make_matrix();
  element.add_stiffness(x, Tangent::Projected, 1, K);
  EXPECT_EQ(dense(K).allFinite(), example.promise.inverted);
}

// Twice to ten times the length: no tissue bears it, but a trial step of a solver may ask for it.
TEST_P(LawTest, LargeStretchesGiveNumbers) {
  for (const double stretch : {2.0, 3.0, 10.0}) {
    const Jet law = example.law(Mat3::Identity() + (stretch - 1) * kFibre * kFibre.transpose(), 1);
    EXPECT_TRUE(std::isfinite(law.value)) << stretch;
    EXPECT_TRUE(law.gradient.allFinite()) << stretch;
    EXPECT_TRUE(law.hessian.allFinite()) << stretch;
  }
}

// At the border a law that ends there has numbers on the one side and none on the other, of energy,
// stress and stiffness, in any direction; and so has its mirror image.
TEST(LawEnds, AtItsLeastStretch) {
  Random random;
  int laws = 0;
  for (const LawExample& example : all_laws()) {
    if (example.promise.least_stretch == 0) continue;
    ++laws;
    for (const double times : {1 - 1e-6, 1 + 1e-6}) {
      const double least = times * example.promise.least_stretch;
      for (const Vec3& sigma : {Vec3(1.2, 1, least), Vec3(least, 1.5, least), Vec3(1, least, 1)}) {
        const Mat3 F = random.rotation() * sigma.asDiagonal() * random.rotation();
        for (const Jet& jet : {example.law(F, 0), example.distortion(F, 0)}) {
          EXPECT_EQ(std::isfinite(jet.value), times > 1);
          EXPECT_EQ(jet.gradient.allFinite(), times > 1);
          EXPECT_EQ(jet.hessian.allFinite(), times > 1);
        }
        EXPECT_TRUE(std::isnan(example.law(-F, 0).value));
      }
    }
  }
  EXPECT_GT(laws, 0);
}

}  // namespace articular::fem::law_properties_test
