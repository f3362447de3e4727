#include "fem/sparse/signed_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "tests/fem/support/random_matrices.hpp"

namespace articular::fem::signed_cholesky_test {

/// A quasi-definite matrix with the graph of an n x n x n grid, signs at random.
struct QuasiDefinite {
  SymmetricMatrix A;
  std::vector<int> signs;

  explicit QuasiDefinite(int n, double share_negative) {
    Random random;
    const int size = n * n * n;
    for (int j = 0; j < size; ++j) {
      signs.push_back(random.uniform(0, 1) < share_negative ? -1 : 1);
    }
    for (int j = 0; j < size; ++j) {
      for (const int distance : {n * n, n, 1}) {
        if (j < distance) continue;
        A.row.push_back(j - distance);
        A.value.push_back(random.uniform(-1, 1));
      }
      A.row.push_back(j);
      A.value.push_back(signs[j] * 7);  // dominates the six neighbours
      A.end_column();
    }
  }

  Eigen::MatrixXd dense() const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(A.size(), A.size());
    for (int j = 0; j < A.size(); ++j) {
      for (int k = A.begin[j]; k < A.begin[j + 1]; ++k) {
        result(A.row[k], j) = result(j, A.row[k]) = A.value[k];
      }
    }
    return result;
  }
};

void expect_solution(const SymmetricMatrix& A, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  Eigen::VectorXd y;
  A.multiply(x, y);
  EXPECT_LT((y - b).norm(), 1e-13 * b.norm());
}

void expect_solves_for_ones(const SignedCholesky& factor, const SymmetricMatrix& A) {
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(A.size());
  Eigen::VectorXd x = b;
  factor.solve(x);
  expect_solution(A, x, b);
}

TEST(SignedCholesky, AgreesWithADenseSolution) {
  for (const double share_negative : {0.0, 0.3, 1.0}) {
    const QuasiDefinite problem(8, share_negative);
    const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(problem.A.size(), 1);
    SignedCholesky factor;
    factor.analyze(problem.A, problem.signs);
    ASSERT_TRUE(factor.factorize(problem.A));
    Eigen::VectorXd x = b;
    factor.solve(x);
    const Eigen::VectorXd expected = problem.dense().lu().solve(b);
    EXPECT_LT((x - expected).norm(), 1e-13 * expected.norm()) << share_negative;
    expect_solution(problem.A, x, b);
  }
}

TEST(SignedCholesky, FollowsNewValuesOfOnePattern) {
  QuasiDefinite problem(6, 0.3);
  SignedCholesky factor;
  factor.analyze(problem.A, problem.signs);
  for (const double scale : {1.0, 1e-9, 3.0}) {
    QuasiDefinite scaled = problem;
    for (double& value : scaled.A.value) value *= scale;
    ASSERT_TRUE(factor.factorize(scaled.A));
    expect_solves_for_ones(factor, scaled.A);
  }
}

// Large enough that what lies above the subtrees is done in pieces, and subtrees differ in depth.
TEST(SignedCholesky, HasTheSameBitsWithAnyNumberOfThreads) {
  for (const double share_negative : {0.0, 0.3}) {
    const QuasiDefinite problem(18, share_negative);
    const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(problem.A.size(), 1);
    Eigen::VectorXd first;
    for (const int num_threads : {1, 2, 5}) {
      SignedCholesky factor(std::make_shared<ThreadPool>(num_threads));
      factor.analyze(problem.A, problem.signs);
      for (int again = 0; again < 2; ++again) {
        ASSERT_TRUE(factor.factorize(problem.A));
        Eigen::VectorXd x = b;
        factor.solve(x);
        if (first.size() == 0) first = x;
        EXPECT_EQ(x, first) << num_threads;
      }
    }
    expect_solution(problem.A, first, b);
  }
}

TEST(SignedCholesky, OrdersGroupsAsOne) {
  const QuasiDefinite problem(9, 0.3);
  std::vector<int> group(static_cast<std::size_t>(problem.A.size()));
  for (int i = 0; i < problem.A.size(); ++i) group[i] = i / 3;
  SignedCholesky factor;
  factor.analyze(problem.A, problem.signs, group);
  ASSERT_TRUE(factor.factorize(problem.A));
  expect_solves_for_ones(factor, problem.A);
}

TEST(SignedCholesky, ReportsAWrongSignAndValuesThatAreNotNumbers) {
  const QuasiDefinite problem(6, 0.3);
  SignedCholesky factor;
  std::vector<int> wrong = problem.signs;
  wrong[100] = -wrong[100];
  factor.analyze(problem.A, wrong);
  EXPECT_FALSE(factor.factorize(problem.A));
  factor.analyze(problem.A, problem.signs);
  QuasiDefinite poisoned = problem;
  poisoned.A.value[200] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factor.factorize(poisoned.A));
  EXPECT_TRUE(factor.factorize(problem.A));
}

}  // namespace articular::fem::signed_cholesky_test
