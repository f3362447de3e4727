#include "fem/mooney_rivlin.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "tests/fem/central_difference.hpp"
#include "tests/fem/random_matrices.hpp"

namespace articular::fem {
namespace {

constexpr double kDerivative = 1e-8;  // [-] relative, best of a sweep of central differences

std::vector<Mat3> deformation_gradients() {
  Random random;
  std::vector<Mat3> result;
  for (const Vec3& sigma :
       {Vec3(1.01, 1, 0.98), Vec3(1.5, 1.2, 0.4), Vec3(0.9, 0.6, 0.3), Vec3(3, 0.5, 0.2)}) {
    for (int k = 0; k < 4; ++k)
      result.emplace_back(random.rotation() * sigma.asDiagonal() * random.rotation());
  }
  return result;
}

template <class Material>
class MooneyRivlinTest : public testing::Test {
 protected:
  Material material{3e3, 1e3, 2e4};
};
using Materials = testing::Types<MooneyRivlin<VolumeChange>, MooneyRivlin<LogVolumeChange>>;
TYPED_TEST_SUITE(MooneyRivlinTest, Materials);

TYPED_TEST(MooneyRivlinTest, StressAndTangentAreDerivatives) {
  const auto& material = this->material;
  const auto energy = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, material.energy_density(Mat3(v.reshaped(3, 3))));
  };
  const auto first_piola = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return material.first_piola(Mat3(v.reshaped(3, 3))).reshaped();
  };
  for (const Mat3& F : deformation_gradients()) {
    const Eigen::RowVectorXd P = material.first_piola(F).reshaped().transpose();
    EXPECT_LT(derivative_error(energy, F.reshaped(), P, 1), kDerivative) << F;
    EXPECT_LT(derivative_error(first_piola, F.reshaped(), material.tangent(F), 1), kDerivative);
  }
}

// The distortion does not feel a change of volume.
TYPED_TEST(MooneyRivlinTest, DistortionIsThatOfTheShapeAlone) {
  for (const Mat3& F : deformation_gradients()) {
    const double energy = this->material.distortion().energy_density(F);
    EXPECT_NEAR(this->material.distortion().energy_density(1.7 * F), energy, 1e-11 * energy);
    EXPECT_NEAR(this->material.distortion().first_piola(F).cwiseProduct(F).sum(), 0,
                1e-11 * energy);
  }
}

}  // namespace
}  // namespace articular::fem
