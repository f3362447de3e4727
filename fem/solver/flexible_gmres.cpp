#include "fem/solver/flexible_gmres.hpp"

#include <cassert>
#include <cmath>

namespace articular::fem {
namespace {

// A new direction of which less than this is left by the others is orthogonalized twice.
constexpr double kCancelled = 0.5;  // [-]

/// w −= Σ (w·v_i) v_i, coefficients added to h.
void orthogonalize(const std::vector<Eigen::VectorXd>& basis, Eigen::VectorXd& w, double* h) {
  for (std::size_t i = 0; i < basis.size(); ++i) {
    const double part = w.dot(basis[i]);
    w -= part * basis[i];
    h[i] += part;
  }
}

}  // namespace

void FlexibleGmres::start(const Eigen::VectorXd& r, int most) {
  most_ = most;
  exhausted_ = false;
  basis_.clear();
  directions_.clear();
  R_.setZero(most + 1, most);
  cosine_.setZero(most);
  sine_.setZero(most);
  g_.setZero(most + 1);
  g_[0] = r.norm();
  basis_.emplace_back(r / g_[0]);
}

double FlexibleGmres::add(const Eigen::VectorXf& z, Eigen::VectorXd& w) {
  assert(!is_full());
  const int k = size();
  directions_.push_back(z);
  double* h = R_.col(k).data();
  const double before = w.norm();
  orthogonalize(basis_, w, h);
  if (w.norm() < kCancelled * before) orthogonalize(basis_, w, h);
  h[k + 1] = w.norm();
  exhausted_ = !(h[k + 1] > 1e-14 * before);
  basis_.emplace_back(w);
  if (!exhausted_) basis_.back() /= h[k + 1];
  for (int i = 0; i < k; ++i) {
    const double upper = cosine_[i] * h[i] + sine_[i] * h[i + 1];
    h[i + 1] = cosine_[i] * h[i + 1] - sine_[i] * h[i];
    h[i] = upper;
  }
  const double length = std::hypot(h[k], h[k + 1]);
  cosine_[k] = h[k] / length;
  sine_[k] = h[k + 1] / length;
  h[k] = length;
  h[k + 1] = 0;
  g_[k + 1] = -sine_[k] * g_[k];
  g_[k] *= cosine_[k];
  return std::abs(g_[k + 1]);
}

void FlexibleGmres::add_best_to(Eigen::VectorXd& x) const {
  const int k = size();
  const Eigen::VectorXd y = R_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g_.head(k));
  for (int i = 0; i < k; ++i) {
    x += y[i] * directions_[static_cast<std::size_t>(i)].head(x.size()).cast<double>();
  }
}

}  // namespace articular::fem
