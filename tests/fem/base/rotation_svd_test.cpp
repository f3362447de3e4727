#include "fem/base/rotation_svd.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <sstream>
#include <vector>

#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::rotation_svd_test {

constexpr double kIdentity = 1e-13;  // [-] an orthogonal transformation leaves a few roundings

void expect_rotation_svd(const Mat3& F) {
  SCOPED_TRACE((std::stringstream() << "F =\n" << F).str());
  const RotationSvd svd = rotation_svd(F);
  const double scale = F.norm();
  EXPECT_LE((svd.U * svd.sigma.asDiagonal() * svd.V.transpose() - F).norm(), kIdentity * scale);
  for (const Mat3& Q : {svd.U, svd.V}) {
    EXPECT_LE((Q.transpose() * Q - Mat3::Identity()).norm(), kIdentity);
    EXPECT_NEAR(Q.determinant(), 1, kIdentity);
  }
  EXPECT_GE(svd.sigma[0], svd.sigma[1] - kIdentity * scale);
  EXPECT_GE(svd.sigma[1], std::abs(svd.sigma[2]) - kIdentity * scale);
  const Vec3 expected = Eigen::JacobiSVD<Mat3>(F).singularValues();
  EXPECT_LE((svd.sigma.cwiseAbs() - expected).norm(), kIdentity * scale);
}

TEST(RotationSvd, ReproducesRandomMatricesOfBothSigns) {
  Random random;
  int inverted = 0;
  for (int k = 0; k < 200; ++k) {
    const Mat3 F = random.matrix3();
    expect_rotation_svd(F);
    EXPECT_EQ(rotation_svd(F).sigma[2] < 0, F.determinant() < 0);
    inverted += F.determinant() < 0 ? 1 : 0;
  }
  EXPECT_GT(inverted, 60);
  EXPECT_LT(inverted, 140);
}

TEST(RotationSvd, SurvivesDegenerateMatrices) {
  Random random;
  const Vec3 a = random.matrix3().col(0), b = random.matrix3().col(1);
  const Mat3 R = random.rotation();
  const std::vector<Mat3> cases{
      Mat3::Zero(),
      Mat3::Identity(),
      -Mat3::Identity(),
      R,
      1e-9 * R,
      Mat3(Vec3(1, 1, -1).asDiagonal()),
      Mat3(Vec3(0, 2, 0).asDiagonal()),
      Mat3(Vec3(0, 0, 3).asDiagonal()),
      a * b.transpose(),                                    // rank 1
      a * b.transpose() + b * a.transpose(),                // rank 2
      a * b.transpose() + 1e-15 * R,                        // rank 1 up to round-off
      R * Vec3(1, 1, 1e-14).asDiagonal() * R.transpose(),   // flat up to round-off
      R * Vec3(1, 1e-9, 1e-13).asDiagonal() * R,            // graded
      R * Vec3(1e8, 1, 1e-8).asDiagonal() * R.transpose(),  // stretched by far
      R * Vec3(1, 1 + 1e-12, 1 - 1e-12).asDiagonal() * R};  // nearly equal singular values
  for (const Mat3& F : cases) expect_rotation_svd(F);
}

TEST(RotationSvd, PolarRotationOfARotationIsItself) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Mat3 R = random.rotation();
    const RotationSvd svd = rotation_svd(R);
    EXPECT_LT((svd.U * svd.V.transpose() - R).norm(), kIdentity);
  }
}

}  // namespace articular::fem::rotation_svd_test
