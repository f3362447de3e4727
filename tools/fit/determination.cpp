#include "tools/fit/determination.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace articular::tools {
namespace {

/// Below this part of the largest singular value a direction is not determined.
constexpr double kNotDetermined = 1e-8;

/// Misfits larger than the spreads say that these, or the model, are wrong: chi^2 per degree of
/// freedom widens what is told [Birge 1932, Phys Rev 40:207]. Never less than 1.
double birge_scale(const Eigen::VectorXd& misfits, Eigen::Index unknowns) {
  const Eigen::Index freedoms = misfits.size() - unknowns;
  if (freedoms <= 0) return 1;
  return std::max(1.0, std::sqrt(misfits.squaredNorm() / static_cast<double>(freedoms)));
}

}  // namespace

Determination determine(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& spreads,
                        const Eigen::VectorXd& misfits) {
  const Eigen::Index n = jacobian.cols(), m = jacobian.rows();
  Determination result;
  const Eigen::VectorXd units =
      spreads.unaryExpr([](double spread) { return std::isfinite(spread) ? spread : 1.0; });
  const Eigen::MatrixXd scaled = jacobian * units.asDiagonal();
  result.singular_values = Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues();
  result.determined = static_cast<int>((result.singular_values.array() > 1).count());

  Eigen::MatrixXd all(m + n, n);
  all.topRows(m) = scaled;
  all.bottomRows(n).setZero();
  for (Eigen::Index i = 0; i < n; ++i) all(m + i, i) = std::isfinite(spreads[i]) ? 1 : 0;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(all, Eigen::ComputeThinV);
  const Eigen::VectorXd& singular = svd.singularValues();
  const double least = kNotDetermined * singular[0];
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd unknown =
      Eigen::VectorXd::Zero(n);  // part of each that lies where nothing is said
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto v = svd.matrixV().col(k);
    if (singular[k] > least)
      covariance += v * v.transpose() / (singular[k] * singular[k]);
    else
      unknown += v.cwiseAbs2();
  }
  result.scale = birge_scale(misfits, n);
  const double infinite = std::numeric_limits<double>::infinity();
  result.widths.resize(n);
  result.from_data.resize(n);
  result.correlation = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool is_known = unknown[i] < kNotDetermined;
    result.widths[i] = is_known ? result.scale * units[i] * std::sqrt(covariance(i, i)) : infinite;
    result.from_data[i] = !is_known                   ? 0
                          : std::isfinite(spreads[i]) ? std::max(0.0, 1 - covariance(i, i))
                                                      : 1;
    for (Eigen::Index j = 0; j < i; ++j) {
      const bool both = is_known && std::isfinite(result.widths[j]);
      result.correlation(i, j) = result.correlation(j, i) =
          both ? covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j)) : 0;
    }
  }
  return result;
}

}  // namespace articular::tools
