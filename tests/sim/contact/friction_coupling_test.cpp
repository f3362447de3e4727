#include "sim/contact/friction_coupling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <vector>

#include "tests/sim/support/scene.hpp"

namespace articular::sim::friction_coupling_test {

TEST(FrictionCoupling, IsSolvedForByAFewSolutionsOfTheSymmetricMatrix) {
  constexpr int kBlocks = 12, kSheets = 8;
  Random random(6);
  const Eigen::MatrixXd R = random.vector(9 * kBlocks * kBlocks).reshaped(3 * kBlocks, 3 * kBlocks);
  const Eigen::MatrixXd A = R * R.transpose() + Eigen::MatrixXd::Identity(3 * kBlocks, 3 * kBlocks);
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  Eigen::MatrixXd all = A;
  FrictionCoupling coupling;
  for (int a = 0; a < kSheets; ++a) {
    Eigen::MatrixXd s = Eigen::MatrixXd::Zero(3 * kBlocks, 1), g = s;
    std::vector<FrictionCoupling::Entry> entries;
    for (int k = 0; k < 3; ++k) {
      const int block = (a + 4 * k) % kBlocks;
      entries.push_back({block, 0.3 * random.vec3(), random.vec3()});
      s.middleRows<3>(3 * block) = entries.back().drag;
      g.middleRows<3>(3 * block) = entries.back().pressure;
    }
    coupling.add_group(entries);
    all += s * g.transpose();
  }
  int solutions = 0;
  const auto solve = [&](Eigen::VectorXd& r, Eigen::VectorXd& w) {
    ++solutions;
    w = factor.solve(r);
    return true;
  };
  const Eigen::VectorXd b = random.vector(3 * kBlocks);
  Eigen::VectorXd w = factor.solve(b);
  const Eigen::VectorXd expected = all.partialPivLu().solve(b);
  EXPECT_GT((w - expected).norm(), 0.01 * expected.norm());
  ASSERT_TRUE(solve_with_friction(coupling, solve, b, w));
  EXPECT_LT((w - expected).norm(), 2e-3 * expected.norm());
  EXPECT_LE(solutions, kSheets + 1);

  const auto fails = [](Eigen::VectorXd&, Eigen::VectorXd&) { return false; };
  EXPECT_FALSE(solve_with_friction(coupling, fails, b, w));
}

}  // namespace articular::sim::friction_coupling_test
