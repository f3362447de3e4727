#include "sim/time/anderson.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace articular::sim::anderson_test {

/// Newton's corrections of v* − v, each component with a share of its own: what a wrong matrix
/// makes of them.
struct Affine {
  Eigen::VectorXd share;  // 1: right, below: slow, above 2: grows from one to the next
  Eigen::VectorXd solution;

  Eigen::VectorXd correction(const Eigen::VectorXd& v) const {
    return share.cwiseProduct(solution - v);
  }
};

Affine affine(std::initializer_list<double> wrong) {
  constexpr int kSize = 40;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Affine map{Eigen::VectorXd::Ones(kSize), Eigen::VectorXd(kSize)};
  for (double& x : map.solution) x = uniform(random);
  int i = 0;
  for (const double share : wrong) map.share[i++] = share;
  return map;
}

/// Iterations until the error is below 1e-8 of the solution; -1: not in 50.
/// @param part  that is taken of the first five corrections
int iterations(const Affine& map, bool accelerate, double part = 1) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(map.solution.size());
  Eigen::VectorXd mass = Eigen::VectorXd::LinSpaced(v.size(), 1, 3);
  Anderson anderson;
  double last = 0;
  for (int k = 0; k < 50; ++k) {
    if ((v - map.solution).norm() < 1e-8 * map.solution.norm()) return k;
    Eigen::VectorXd w = map.correction(v);
    const double residual = (v - map.solution).norm();
    anderson.see(w, mass.cwiseProduct(w), residual > std::exchange(last, residual));
    if (accelerate && anderson.is_slow()) anderson.improve(w);
    const double taken = k < 5 ? part : 1;
    anderson.took(taken, w);
    v += taken * w;
  }
  return -1;
}

TEST(Anderson, EndsWhatIsSlowOrGoesRoundInCircles) {
  EXPECT_EQ(iterations(affine({0.05}), false), -1);
  EXPECT_EQ(iterations(affine({2}), false), -1);
  // An iteration to see each wrong share, and what it takes to notice.
  EXPECT_LE(iterations(affine({0.05}), true), 6);
  EXPECT_LE(iterations(affine({2}), true), 6);
  EXPECT_LE(iterations(affine({0.05, 2, 2.2, 0.3}), true), 12);
}

TEST(Anderson, LeavesFastIterationsAlone) {
  for (const auto& map : {affine({}), affine({0.7, 1.2}), affine({0.6})})
    EXPECT_EQ(iterations(map, true), iterations(map, false));
}

TEST(Anderson, KnowsWhatWasTakenOfACorrection) {
  EXPECT_EQ(iterations(affine({0.1}), false, 0.5), -1);
  const int accelerated = iterations(affine({0.1}), true, 0.5);
  EXPECT_TRUE(accelerated > 5 && accelerated < 12) << accelerated;
}

TEST(Anderson, ForgetsWhereCorrectionsGrow) {
  Anderson anderson;
  const Eigen::VectorXd small = Eigen::VectorXd::Constant(3, 1), large = 11 * small;
  for (int k = 0; k < 4; ++k) {
    anderson.see(small, small, false);
    anderson.took(1, small);
  }
  EXPECT_TRUE(anderson.is_slow());
  anderson.see(large, large, false);
  EXPECT_FALSE(anderson.is_slow());
}

TEST(Anderson, ForgetsWhereWhatItMadeBetterLeadsAstray) {
  for (const bool has_grown : {false, true}) {
    Anderson anderson;
    for (int k = 0; k < 6; ++k) {
      Eigen::VectorXd w = Eigen::Vector3d(1, 2, 3) + 0.1 * k * Eigen::Vector3d(1, -1, 1);
      anderson.see(w, w, k == 5 && has_grown);
      if (k == 4) {
        ASSERT_TRUE(anderson.is_slow());
        anderson.improve(w);
      }
      anderson.took(1, w);
    }
    EXPECT_EQ(anderson.is_slow(), !has_grown);
  }
}

}  // namespace articular::sim::anderson_test
