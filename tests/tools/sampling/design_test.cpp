#include "tools/sampling/design.hpp"

#include <gtest/gtest.h>

#include <set>

namespace articular::tools::design_test {

constexpr Design kAll[] = {Design::LatinHypercube, Design::Sobol, Design::Random};

TEST(Design, TheSeedDecidesOnThePoints) {
  for (const Design design : kAll) {
    EXPECT_EQ(unit_points(design, 3, 20, 7), unit_points(design, 3, 20, 7));
    EXPECT_NE(unit_points(design, 3, 20, 7), unit_points(design, 3, 20, 8));
  }
}

// The numbers themselves: another compiler or machine must give the same population.
TEST(Design, ThePointsAreTheSameEverywhere) {
  const Eigen::MatrixXd latin = unit_points(Design::LatinHypercube, 2, 4, 1);
  const Eigen::MatrixXd sobol = unit_points(Design::Sobol, 2, 4, 1);
  EXPECT_NEAR(latin(0, 0), 0.25525605710418175, 1e-15);
  EXPECT_NEAR(latin(1, 3), 0.055408418498349085, 1e-15);
  EXPECT_NEAR(sobol(0, 0), 0.63387664401253274, 1e-15);
  EXPECT_NEAR(sobol(1, 3), 0.51140703636619733, 1e-15);
}

TEST(Design, OneOfTheLatinPointsLiesInEachPartOfEachAxis) {
  const Eigen::MatrixXd points = unit_points(Design::LatinHypercube, 4, 50, 3);
  for (int d = 0; d < 4; ++d) {
    std::set<int> parts;
    for (int i = 0; i < 50; ++i) parts.insert(static_cast<int>(points(d, i) * 50));
    EXPECT_EQ(parts.size(), 50u);
  }
}

/// The mean of the product of 3 x_i²: its integral is 1.
double mean_of_products(const Eigen::MatrixXd& points) {
  return (3 * points.array().square()).colwise().prod().mean();
}

// Of 1024 random points the error is 0.1: the variance of a product is (9/5)^4 - 1.
TEST(Design, SobolsSequenceFillsTheCubeEvenly) {
  for (const std::uint64_t seed : {1, 2, 3})
    EXPECT_NEAR(mean_of_products(unit_points(Design::Sobol, 4, 1024, seed)), 1, 0.035);
}

TEST(Design, ACopulaCorrelatesAndKeepsEachDistribution) {
  Eigen::Matrix2d correlation;
  correlation << 1, 0.6, 0.6, 1;
  const std::vector<Distribution> distributions = {{Distribution::Kind::Normal, 10, 2},
                                                   {Distribution::Kind::Normal, -5, 1}};
  const Eigen::MatrixXd values =
      values_at(unit_points(Design::Sobol, 2, 4096, 1), distributions, correlation);
  const Eigen::VectorXd mean = values.rowwise().mean();
  const Eigen::MatrixXd away = values.colwise() - mean;
  const Eigen::MatrixXd covariance = away * away.transpose() / 4096;
  EXPECT_NEAR(mean[0], 10, 0.02);
  EXPECT_NEAR(mean[1], -5, 0.02);
  EXPECT_NEAR(covariance(0, 0), 4, 0.05);
  EXPECT_NEAR(covariance(1, 1), 1, 0.02);
  EXPECT_NEAR(covariance(0, 1) / 2, 0.6, 0.01);
}

// a with b and b with c go together closely, a with c against each other: there is no such thing.
TEST(Design, ImpossibleCorrelationsAreNoticed) {
  Eigen::Matrix3d correlation;
  correlation << 1, 0.9, -0.9, 0.9, 1, 0.9, -0.9, 0.9, 1;
  EXPECT_FALSE(is_positive_definite(correlation));
  EXPECT_FALSE(is_positive_definite(Eigen::Matrix2d::Ones()));
  EXPECT_TRUE(is_positive_definite(Eigen::Matrix3d::Identity()));
}

TEST(Design, SaltellisPointsDifferFromAInOneNumberOfB) {
  const Eigen::MatrixXd points = saltelli_points(3, 5, 1);
  ASSERT_EQ(points.cols(), 25);
  for (int row = 0; row < 5; ++row)
    for (int d = 0; d < 3; ++d) {
      Eigen::VectorXd expected = points.col(5 * row);
      expected[d] = points(d, 5 * row + 1);
      EXPECT_EQ(points.col(5 * row + 2 + d), expected);
    }
}

}  // namespace articular::tools::design_test
