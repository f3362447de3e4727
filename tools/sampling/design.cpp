#include "tools/sampling/design.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <random>

namespace articular::tools {
namespace {

// Distributions of <random> may differ between libraries; its generators may not.
double unit_number(std::mt19937_64& generator) {
  return (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53;
}

std::vector<int> shuffled(int count, std::mt19937_64& generator) {
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
  for (int i = count - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)],
              order[static_cast<std::size_t>(unit_number(generator) * (i + 1))]);
  return order;
}

Eigen::MatrixXd latin_hypercube(int num_dimensions, int num_points, std::mt19937_64& generator) {
  Eigen::MatrixXd points(num_dimensions, num_points);
  for (int d = 0; d < num_dimensions; ++d) {
    const std::vector<int> order = shuffled(num_points, generator);
    for (int i = 0; i < num_points; ++i)
      points(d, i) = (order[static_cast<std::size_t>(i)] + unit_number(generator)) / num_points;
  }
  return points;
}

Eigen::MatrixXd sobol_sequence(int num_dimensions, int num_points, std::mt19937_64& generator) {
  boost::random::sobol sequence(static_cast<std::size_t>(num_dimensions));
  Eigen::VectorXd shift(num_dimensions);
  for (double& s : shift) s = unit_number(generator);
  Eigen::MatrixXd points(num_dimensions, num_points);
  const double whole = static_cast<double>(boost::random::sobol::max()) + 1;
  for (int i = 0; i < num_points; ++i)
    for (int d = 0; d < num_dimensions; ++d) {
      const double moved = static_cast<double>(sequence()) / whole + shift[d];
      points(d, i) = std::clamp(moved - std::floor(moved), 0x1p-54, 1 - 0x1p-53);
    }
  return points;
}

}  // namespace

Eigen::MatrixXd unit_points(Design design, int num_dimensions, int num_points, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  if (num_dimensions == 0) return Eigen::MatrixXd(0, num_points);
  if (design == Design::LatinHypercube)
    return latin_hypercube(num_dimensions, num_points, generator);
  if (design == Design::Sobol) return sobol_sequence(num_dimensions, num_points, generator);
  Eigen::MatrixXd points(num_dimensions, num_points);
  for (double& p : points.reshaped()) p = unit_number(generator);
  return points;
}

Eigen::MatrixXd values_at(const Eigen::MatrixXd& points,
                          const std::vector<Distribution>& distributions,
                          const Eigen::MatrixXd& correlation) {
  Eigen::MatrixXd shares = points;
  if (!correlation.isIdentity(0)) {
    const Eigen::MatrixXd factor = correlation.llt().matrixL();
    shares = factor * points.unaryExpr(&normal_quantile);
    shares = shares.unaryExpr(&normal_share).eval();
  }
  Eigen::MatrixXd values(points.rows(), points.cols());
  for (Eigen::Index d = 0; d < points.rows(); ++d)
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      values(d, i) = quantile(distributions[static_cast<std::size_t>(d)], shares(d, i));
  return values;
}

bool is_positive_definite(const Eigen::MatrixXd& correlation) {
  if (correlation.size() == 0) return true;
  constexpr double kLeast = 1e-10;  // of a pivot: the rest of a variance of 1
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation);
  return factor.info() == Eigen::Success &&
         factor.matrixLLT().diagonal().array().square().minCoeff() > kLeast;
}

Eigen::MatrixXd saltelli_points(int num_dimensions, int num_rows, std::uint64_t seed) {
  const Eigen::MatrixXd both = unit_points(Design::Sobol, 2 * num_dimensions, num_rows, seed);
  const int width = num_dimensions + 2;
  Eigen::MatrixXd points(num_dimensions, num_rows * width);
  for (int row = 0; row < num_rows; ++row) {
    const Eigen::VectorXd A = both.col(row).head(num_dimensions);
    const Eigen::VectorXd B = both.col(row).tail(num_dimensions);
    points.col(row * width) = A;
    points.col(row * width + 1) = B;
    for (int d = 0; d < num_dimensions; ++d) {
      points.col(row * width + 2 + d) = A;
      points(d, row * width + 2 + d) = B[d];
    }
  }
  return points;
}

}  // namespace articular::tools
