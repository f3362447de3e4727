#include "fem/base/cofactor.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/fem/support/central_difference.hpp"
#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::cofactor_test {

TEST(Cofactor, IsTheDeterminantTimesTheInverseTransposed) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Mat3 F = Mat3::Identity() + 0.5 * random.matrix3();
    const Mat3 expected = F.determinant() * F.inverse().transpose();
    EXPECT_LT((cofactor(F) - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(Cofactor, IsDefinedForSingularMatrices) {
  EXPECT_EQ(cofactor(Mat3::Zero()), Mat3::Zero());
  EXPECT_EQ(cofactor(Vec3(2, 3, 0).asDiagonal()), Mat3(Vec3(0, 0, 6).asDiagonal()));
}

TEST(Cofactor, DerivativeMatchesDifferences) {
  Random random;
  const Mat3 F = random.matrix3();
  const auto vec_cofactor = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return cofactor(Mat3(v.reshaped(3, 3))).reshaped();
  };
  EXPECT_LT(derivative_error(vec_cofactor, F.reshaped(), cofactor_derivative(F), 1), 1e-8);
}

}  // namespace articular::fem::cofactor_test
