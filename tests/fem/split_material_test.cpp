#include "fem/split_material.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fem/corotated.hpp"
#include "fem/linear.hpp"
#include "fem/mooney_rivlin.hpp"
#include "fem/neo_hookean.hpp"
#include "tests/fem/central_difference.hpp"
#include "tests/fem/random_matrices.hpp"

namespace articular::fem {
namespace {

constexpr double kE = 2e4, kNu = 0.4;  // [Pa], [-]
constexpr double kIdentity = 1e-12;    // [-] relative, a few roundings
constexpr double kDerivative = 1e-8;   // [-] relative, best of a sweep of central differences

std::vector<Mat3> deformation_gradients() {
  Random random;
  std::vector<Mat3> result{Mat3::Identity()};
  for (const Vec3& sigma :
       {Vec3(1.01, 1, 0.98), Vec3(1.5, 1.2, 0.4), Vec3(0.9, 0.6, 0.3), Vec3(3, 0.5, 0.2)}) {
    for (int k = 0; k < 4; ++k)
      result.emplace_back(random.rotation() * sigma.asDiagonal() * random.rotation());
  }
  return result;
}

Linear make(Linear*) { return {kE, kNu}; }
Corotated make(Corotated*) { return {kE, kNu}; }
NeoHookean make(NeoHookean*) { return {kE, kNu}; }
template <class Theta>
MooneyRivlin<Theta> make(MooneyRivlin<Theta>*) {
  return {3e3, 1e3, 2e4};
}

template <class Material>
class SplitTest : public testing::Test {
 protected:
  Material material = make(static_cast<Material*>(nullptr));
};
using Materials = testing::Types<Linear, Corotated, NeoHookean, MooneyRivlin<VolumeChange>,
                                 MooneyRivlin<LogVolumeChange>>;
TYPED_TEST_SUITE(SplitTest, Materials);

TYPED_TEST(SplitTest, DistortionAndDilatationAddUpToTheLaw) {
  using Theta = typename TypeParam::Dilatation;
  const double kappa = this->material.bulk_modulus();
  const auto distortion = this->material.distortion();
  for (const Mat3& F : deformation_gradients()) {
    const double theta = Theta::value(F);
    const Vec9 g = Theta::gradient(F).reshaped();
    const double energy = distortion.energy_density(F) + 0.5 * kappa * theta * theta;
    const Mat3 P = distortion.first_piola(F) + kappa * theta * Theta::gradient(F);
    const Mat9 C = distortion.tangent(F) + kappa * (g * g.transpose() + theta * Theta::hessian(F));
    EXPECT_NEAR(this->material.energy_density(F), energy, kIdentity * (kappa + energy));
    EXPECT_LT((this->material.first_piola(F) - P).norm(), kIdentity * (kappa + P.norm()));
    EXPECT_LT((this->material.tangent(F) - C).norm(), kIdentity * C.norm());
  }
}

// At rest all resistance to a change of volume is the bulk modulus, and all resistance to shear is
// in the distortion.
TYPED_TEST(SplitTest, SmallStrainModuliAreThoseOfTheParts) {
  const double kappa = this->material.bulk_modulus(), mu = this->material.shear_modulus();
  const auto distortion = this->material.distortion();
  const Mat9 C = this->material.tangent(Mat3::Identity());
  const Mat9 C_d = distortion.tangent(Mat3::Identity());
  const Vec9 volume = Mat3::Identity().reshaped();
  EXPECT_LT((C * volume - 3 * kappa * volume).norm(), kIdentity * kappa);
  EXPECT_LT((C_d * volume).norm(), kIdentity * kappa);
  Mat3 shear = Mat3::Zero();
  shear(0, 1) = shear(1, 0) = 0.5;
  EXPECT_LT((C * shear.reshaped() - 2 * mu * shear.reshaped()).norm(), kIdentity * mu);
  EXPECT_LT((C_d * shear.reshaped() - 2 * mu * shear.reshaped()).norm(), kIdentity * mu);
}

template <class Measure>
class DilatationTest : public testing::Test {};
using Measures = testing::Types<VolumeChange, LogVolumeChange, StretchDilatation, SmallDilatation>;
TYPED_TEST_SUITE(DilatationTest, Measures);

TYPED_TEST(DilatationTest, GradientAndHessianAreDerivatives) {
  const auto value = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, TypeParam::value(Mat3(v.reshaped(3, 3))));
  };
  const auto gradient = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return TypeParam::gradient(Mat3(v.reshaped(3, 3))).reshaped();
  };
  for (const Mat3& F : deformation_gradients()) {
    const Eigen::RowVectorXd g = TypeParam::gradient(F).reshaped().transpose();
    const Mat9 H = TypeParam::hessian(F);
    EXPECT_LT(derivative_error(value, F.reshaped(), g, 1), kDerivative) << F;
    if (H.norm() > 0) {
      EXPECT_LT(derivative_error(gradient, F.reshaped(), H, 1), kDerivative);
    }
  }
}

TYPED_TEST(DilatationTest, SmallStrainLimitIsTheTraceOfTheStrain) {
  EXPECT_EQ(TypeParam::value(Mat3::Identity()), 0);
  EXPECT_LT((TypeParam::gradient(Mat3::Identity()) - Mat3::Identity()).norm(), kIdentity);
}

}  // namespace
}  // namespace articular::fem
