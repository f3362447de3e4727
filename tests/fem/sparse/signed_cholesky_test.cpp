#include "fem/sparse/signed_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
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

void expect_solves_for_ones(const SignedCholesky<double>& factor, const SymmetricMatrix& A) {
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(A.size());
  Eigen::VectorXd x = b;
  factor.solve(x);
  expect_solution(A, x, b);
}

TEST(SignedCholesky, AgreesWithADenseSolution) {
  for (const double share_negative : {0.0, 0.3, 1.0}) {
    const QuasiDefinite problem(8, share_negative);
    const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(problem.A.size(), 1);
    SignedCholesky<double> factor;
    factor.analyze(problem.A, problem.signs);
    ASSERT_EQ(factor.factorize(problem.A), Pivots::Right);
    Eigen::VectorXd x = b;
    factor.solve(x);
    const Eigen::VectorXd expected = problem.dense().lu().solve(b);
    EXPECT_LT((x - expected).norm(), 1e-13 * expected.norm()) << share_negative;
    expect_solution(problem.A, x, b);
  }
}

TEST(SignedCholesky, FollowsNewValuesOfOnePattern) {
  QuasiDefinite problem(6, 0.3);
  SignedCholesky<double> factor;
  factor.analyze(problem.A, problem.signs);
  for (const double scale : {1.0, 1e-9, 3.0}) {
    QuasiDefinite scaled = problem;
    for (double& value : scaled.A.value) value *= scale;
    ASSERT_EQ(factor.factorize(scaled.A), Pivots::Right);
    expect_solves_for_ones(factor, scaled.A);
  }
}

// The memory of the factor before serves: none of its entries may stay.
template <class Real>
void expect_new_patterns_are_followed(double error) {
  SignedCholesky<Real> factor;
  for (const int n : {6, 8, 5, 7, 9}) {
    const QuasiDefinite problem(n, 0.3);
    factor.analyze(problem.A, problem.signs);
    ASSERT_EQ(factor.factorize(problem.A), Pivots::Right);
    const Eigen::VectorXd x = Random().matrix<Eigen::VectorXd>(problem.A.size(), 1);
    Eigen::VectorXd y;
    problem.A.multiply(x, y);
    factor.solve(y);
    EXPECT_LT((y - x).norm(), error * x.norm()) << n;
  }
}

TEST(SignedCholesky, FollowsNewPatterns) {
  expect_new_patterns_are_followed<float>(1e-5);
  expect_new_patterns_are_followed<double>(1e-13);
}

// Large enough that what lies above the subtrees is done in pieces, and subtrees differ in depth.
TEST(SignedCholesky, HasTheSameBitsWithAnyNumberOfThreads) {
  for (const double share_negative : {0.0, 0.3}) {
    const QuasiDefinite problem(18, share_negative);
    const Eigen::VectorXd b = Random().matrix<Eigen::VectorXd>(problem.A.size(), 1);
    Eigen::VectorXd first;
    for (const int num_threads : {1, 2, 5}) {
      SignedCholesky<double> factor(std::make_shared<ThreadPool>(num_threads), 0);
      factor.analyze(problem.A, problem.signs);
      for (int again = 0; again < 2; ++again) {
        ASSERT_EQ(factor.factorize(problem.A), Pivots::Right);
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
  SignedCholesky<double> factor;
  factor.analyze(problem.A, problem.signs, group);
  ASSERT_EQ(factor.factorize(problem.A), Pivots::Right);
  expect_solves_for_ones(factor, problem.A);
}

TEST(SignedCholesky, ReportsAWrongSignAndValuesThatAreNotNumbers) {
  const QuasiDefinite problem(6, 0.3);
  SignedCholesky<double> factor;
  std::vector<int> wrong = problem.signs;
  wrong[100] = -wrong[100];
  factor.analyze(problem.A, wrong);
  EXPECT_EQ(factor.factorize(problem.A), Pivots::Wrong);
  factor.analyze(problem.A, problem.signs);
  QuasiDefinite poisoned = problem;
  poisoned.A.value[200] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(factor.factorize(poisoned.A), Pivots::Wrong);
  EXPECT_EQ(factor.factorize(problem.A), Pivots::Right);
}

TEST(SignedCholesky, SolvesInSinglePrecisionWhateverTheUnits) {
  const QuasiDefinite problem(8, 0.3);
  const Eigen::VectorXd x = Random().matrix<Eigen::VectorXd>(problem.A.size(), 1);
  Eigen::VectorXd b;
  problem.A.multiply(x, b);
  for (const double unit : {1e-30, 1.0, 1e30}) {  // of every third unknown
    QuasiDefinite scaled = problem;
    const auto scale = [&](int i) { return i % 3 == 0 ? unit : 1.0; };
    for (int j = 0; j < scaled.A.size(); ++j)
      for (int k = scaled.A.begin[j]; k < scaled.A.begin[j + 1]; ++k)
        scaled.A.value[k] *= scale(j) * scale(scaled.A.row[k]);
    SignedCholesky<float> factor;
    factor.analyze(scaled.A, problem.signs);
    ASSERT_EQ(factor.factorize(scaled.A), Pivots::Right);
    Eigen::VectorXd y = b;
    for (int i = 0; i < y.size(); ++i) y[i] *= 1e-50 * scale(i);
    factor.solve(y);
    for (int i = 0; i < y.size(); ++i) y[i] *= 1e50 * scale(i);
    EXPECT_LT((y - x).norm(), 1e-5 * x.norm()) << unit;
  }
}

/// The stiffness of a chain of springs, free but for one of stiffness k to the ground.
SymmetricMatrix chain(int n, double k) {
  const auto spring = [](int j) { return 1 + 0.3 * std::sin(j); };  // from j to j + 1
  SymmetricMatrix A;
  for (int j = 0; j < n; ++j) {
    if (j > 0) {
      A.row.push_back(j - 1);
      A.value.push_back(-spring(j - 1));
    }
    A.row.push_back(j);
    A.value.push_back((j == 0 ? k : spring(j - 1)) + (j == n - 1 ? 0 : spring(j)));
    A.end_column();
  }
  return A;
}

// What is left for the last pivot, in any order, is k or less.
TEST(SignedCholesky, SaysWhereSinglePrecisionDoesNotTellTheSign) {
  constexpr int n = 50;
  const std::vector<int> signs(n, 1);
  const auto verdict = [&]<class Real>(SignedCholesky<Real> factor, double k) {
    const SymmetricMatrix A = chain(n, k);
    factor.analyze(A, signs);
    return factor.factorize(A);
  };
  for (const double k : {1e-8, -1e-8}) {
    EXPECT_EQ(verdict(SignedCholesky<float>(), k), Pivots::Unclear) << k;
    EXPECT_EQ(verdict(SignedCholesky<double>(), k), k > 0 ? Pivots::Right : Pivots::Wrong) << k;
  }
  EXPECT_EQ(verdict(SignedCholesky<float>(), 0.1), Pivots::Right);
  EXPECT_EQ(verdict(SignedCholesky<float>(), -0.1), Pivots::Wrong);
}

}  // namespace articular::fem::signed_cholesky_test
