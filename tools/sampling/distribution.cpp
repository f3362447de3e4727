#include "tools/sampling/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace articular::tools {
namespace {

using Kind = Distribution::Kind;

// Shares nearer to 0 or 1 have no quantile that double precision can tell.
constexpr double kLeastShare = 1e-15;

/// Mean and standard deviation of the logarithm: of X = exp(m + s Z) the mean is exp(m + s²/2), and
/// the variance (exp(s²) - 1) times the square of that.
struct Logarithm {
  double mean, sd;
};
Logarithm logarithm(const Distribution& d) {
  const double s2 = std::log1p(d.sd * d.sd / (d.mean * d.mean));
  return {std::log(d.mean) - s2 / 2, std::sqrt(s2)};
}

/// The share of the whole distribution below x.
double share_below(const Distribution& d, double x) {
  if (d.kind == Kind::Normal) return normal_share((x - d.mean) / d.sd);
  if (x <= 0) return 0;
  const Logarithm l = logarithm(d);
  return normal_share((std::log(x) - l.mean) / l.sd);
}

double whole_quantile(const Distribution& d, double p) {
  const double z = normal_quantile(p);
  if (d.kind == Kind::Normal) return d.mean + d.sd * z;
  const Logarithm l = logarithm(d);
  return std::exp(l.mean + l.sd * z);
}

}  // namespace

double normal_quantile(double p) {
  return boost::math::quantile(boost::math::normal(), std::clamp(p, kLeastShare, 1 - kLeastShare));
}

double normal_share(double z) {
  return std::isinf(z) ? (z > 0 ? 1 : 0) : boost::math::cdf(boost::math::normal(), z);
}

double kept_share(const Distribution& d) {
  if (d.kind == Kind::Uniform) return 1;
  return share_below(d, d.highest) - share_below(d, d.lowest);
}

double quantile(const Distribution& d, double p) {
  if (d.kind == Kind::Uniform) return d.lowest + p * (d.highest - d.lowest);
  const double low = share_below(d, d.lowest);
  return std::clamp(whole_quantile(d, low + p * kept_share(d)), d.lowest, d.highest);
}

}  // namespace articular::tools
