#include "tools/sampling/sobol_indices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/sampling/design.hpp"

namespace articular::tools::sobol_indices_test {

/// f = sin x1 + a sin² x2 + b x3⁴ sin x1, each x uniform in (-pi, pi) [Ishigami, Homma 1990].
constexpr double kA = 7, kB = 0.1;
double ishigami(const Eigen::VectorXd& share) {
  const Eigen::VectorXd x = std::numbers::pi * (2 * share.array() - 1);
  return std::sin(x[0]) + kA * std::pow(std::sin(x[1]), 2) +
         kB * std::pow(x[2], 4) * std::sin(x[0]);
}

template <class Function>
Eigen::MatrixXd values_of(const Function& f, int num_dimensions, int num_rows) {
  const Eigen::MatrixXd points = saltelli_points(num_dimensions, num_rows, 1);
  Eigen::MatrixXd values(num_rows, num_dimensions + 2);
  for (int row = 0; row < num_rows; ++row)
    for (int i = 0; i < num_dimensions + 2; ++i)
      values(row, i) = f(points.col(row * (num_dimensions + 2) + i));
  return values;
}

struct Exact {
  double first[3], total[3];
};
/// V1 = (1 + b pi⁴/5)²/2, V2 = a²/8, V13 = 8 b² pi⁸/225, all other parts are 0.
Exact exact() {
  const double pi4 = std::pow(std::numbers::pi, 4);
  const double V1 = std::pow(1 + kB * pi4 / 5, 2) / 2, V2 = kA * kA / 8;
  const double V13 = 8 * kB * kB * pi4 * pi4 / 225, V = V1 + V2 + V13;
  return {{V1 / V, V2 / V, 0}, {(V1 + V13) / V, V2 / V, V13 / V}};
}

// The third parameter does nothing alone and much together with the first.
TEST(SobolIndices, OfIshigamisFunctionAreThoseOfItsClosedForm) {
  const std::vector<SobolIndex> indices = sobol_indices(values_of(ishigami, 3, 4096), 1);
  ASSERT_EQ(indices.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices[i].first.value, exact().first[i], 0.01) << i;
    EXPECT_NEAR(indices[i].total.value, exact().total[i], 0.01) << i;
  }
}

// 95 % each, of six that belong together: one may miss. From 64 rows they are wide, but not
// useless.
TEST(SobolIndices, IntervalsHoldTheClosedForm) {
  const std::vector<SobolIndex> indices = sobol_indices(values_of(ishigami, 3, 256), 1);
  int held = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto holds = [](const Estimate& e, double x) { return e.low <= x && x <= e.high; };
    held += holds(indices[i].first, exact().first[i]) ? 1 : 0;
    held += holds(indices[i].total, exact().total[i]) ? 1 : 0;
    EXPECT_LT(indices[i].total.high - indices[i].total.low, 0.45) << i;
    EXPECT_GT(indices[i].total.high, indices[i].total.low) << i;
  }
  EXPECT_GE(held, 5);
}

TEST(SobolIndices, RowsWithAMissingValueDoNotCount) {
  Eigen::MatrixXd values = values_of(ishigami, 3, 300);
  const Eigen::MatrixXd whole = values.topRows(298);
  values(298, 0) = values(299, 4) = std::nan("");
  const std::vector<SobolIndex> some = sobol_indices(values, 1), all = sobol_indices(whole, 1);
  EXPECT_EQ(some[1].first.value, all[1].first.value);
  EXPECT_EQ(some[1].first.low, all[1].first.low);
}

TEST(SobolIndices, OfWhatDoesNotVaryThereAreNone) {
  EXPECT_TRUE(sobol_indices(Eigen::MatrixXd::Constant(10, 4, 3.0), 1).empty());
  EXPECT_TRUE(sobol_indices(Eigen::MatrixXd::Random(1, 4), 1).empty());
}

}  // namespace articular::tools::sobol_indices_test
